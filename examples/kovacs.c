/* Kovacs' experiment on rough grains in a bath: cool them until their temperature is the one that they would keep in a
 * warmer bath, and put them into that bath. They do not keep it: the spins are still warm, the temperature rises and
 * comes back.
 * Build: cc kovacs.c -o kovacs $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

static const char scene_text[] = "{flow: hss, engine: dsmc, phi: 0.1, collision: {e: 0.9, beta: 0}, thermostat: bath, "
                                 "bath: {drag: 1, temperature: 0.3}, dsmc: {particles: 60000}}";

/* Advance so many steps of a twentieth of 1/drag; the mean temperature. */
static gg_status follow(gg_simulation *gas, int steps, double *mean, gg_error *err)
{
  gg_simulation_state s;
  gg_status status = GG_OK;
  *mean = 0;
  for (int i = 0; i < steps && status == GG_OK; i++) {
    status = gg_simulation_advance(gas, 0.05, err);
    if (status == GG_OK) status = gg_simulation_get_state(gas, &s, err);
    *mean += s.temperature / steps;
  }
  return status;
}

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  gg_simulation *gas = NULL;
  gg_simulation_state s;
  double steady, ignored;
  if (gg_scene_parse(scene_text, "scene", &scene, &err) || gg_simulation_new(scene, 0, &gas, &err)) goto failed;
  /* What the bath of temperature 0.3 keeps; a warm start; a quench. */
  if (follow(gas, 200, &ignored, &err) || follow(gas, 200, &steady, &err) ||
      gg_simulation_set(gas, "bath.temperature", "1", &err) || follow(gas, 200, &ignored, &err) ||
      gg_simulation_set(gas, "bath.temperature", "0.01", &err))
    goto failed;
  do {
    if (gg_simulation_advance(gas, 0.002, &err) || gg_simulation_get_state(gas, &s, &err)) goto failed;
  } while (s.temperature > steady);
  if (gg_simulation_set(gas, "bath.temperature", "0.3", &err)) goto failed;
  printf("  time  T/T_steady  theta/T\n");
  for (int i = 0; i < 16; i++) {
    if (gg_simulation_get_state(gas, &s, &err)) goto failed;
    printf("%6.2f %11.3f %8.3f\n", 0.25 * i, s.temperature / steady, s.rotational_temperature / s.temperature);
    if (follow(gas, 5, &ignored, &err)) goto failed;
  }
  gg_simulation_free(gas);
  gg_scene_free(scene);
  return 0;
failed:
  fprintf(stderr, "%s\n", err.message);
  gg_simulation_free(gas);
  gg_scene_free(scene);
  return 1;
}
