/* Kovacs' experiment on rough grains: cool them until they have the temperature that a warmer bath would keep, and put
 * them into that bath. They do not keep it: the spins are still warm, so the temperature rises and comes back.
 * Build: cc kovacs.c -o kovacs $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

static const char text[] = "{flow: hss, engine: dsmc, phi: 0.1, collision: {e: 0.9, beta: 0}, thermostat: bath, "
                           "bath: {drag: 1, temperature: 0.3}, dsmc: {particles: 60000}}";

/* So many steps of a twentieth of 1/drag; the mean temperature. */
static gg_status follow(gg_simulation *gas, int steps, double *mean, gg_error *err)
{
  gg_simulation_state s;
  *mean = 0;
  for (int i = 0; i < steps; i++) {
    if (gg_simulation_advance(gas, 0.05, err) || gg_simulation_get_state(gas, &s, err)) return GG_FAILED;
    *mean += s.temperature / steps;
  }
  return GG_OK;
}

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  gg_simulation *gas = NULL;
  gg_simulation_state s;
  double steady, ignored;
  int failed = gg_scene_parse(text, "scene", &scene, &err) || gg_simulation_new(scene, 0, &gas, &err);
  /* What the bath of temperature 0.3 keeps; a warm start; a quench. */
  failed = failed || follow(gas, 200, &ignored, &err) || follow(gas, 200, &steady, &err);
  failed = failed || gg_simulation_set(gas, "bath.temperature", "1", &err) || follow(gas, 200, &ignored, &err);
  failed = failed || gg_simulation_set(gas, "bath.temperature", "0.01", &err);
  do failed = failed || gg_simulation_advance(gas, 0.002, &err) || gg_simulation_get_state(gas, &s, &err);
  while (!failed && s.temperature > steady);
  failed = failed || gg_simulation_set(gas, "bath.temperature", "0.3", &err);
  if (!failed) printf("  time  T/T_steady  theta/T\n");
  for (int i = 0; i < 16 && !failed; i++) {
    failed = gg_simulation_get_state(gas, &s, &err);
    printf("%6.2f %11.3f %8.3f\n", 0.25 * i, s.temperature / steady, s.rotational_temperature / s.temperature);
    failed = failed || follow(gas, 5, &ignored, &err);
  }
  if (failed) fprintf(stderr, "%s\n", err.message);
  gg_simulation_free(gas);
  gg_scene_free(scene);
  return failed;
}
