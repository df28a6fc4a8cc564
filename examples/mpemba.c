/* The Mpemba effect of rough grains in a cold bath: of two gases the hotter one, whose spins are cold, is the colder
 * one soon. The spins of the other are hot and keep it warm. Build: cc mpemba.c -o mpemba $(pkg-config --cflags --libs
 * graingas) */
#include <graingas.h>
#include <stdio.h>

#define GAS                                                                                                            \
  "flow: hss, engine: dsmc, phi: 0.1, collision: {e: 0.9, beta: 0}, thermostat: bath, "                                \
  "bath: {drag: 0.2, temperature: 0.05}, dsmc: {particles: 60000}"

int main(void)
{
  static const char *const text[] = {"{" GAS ", temperature: 1.2, rotational_temperature: 0.02}",
                                     "{" GAS ", temperature: 1, rotational_temperature: 3}"};
  gg_error err;
  gg_scene *scene[2] = {NULL, NULL};
  gg_simulation *gas[2] = {NULL, NULL};
  gg_simulation_state s[2];
  gg_status status = GG_OK;
  for (int k = 0; k < 2 && status == GG_OK; k++) {
    status = gg_scene_parse(text[k], "scene", &scene[k], &err);
    if (status == GG_OK) status = gg_simulation_new(scene[k], 0, &gas[k], &err);
  }
  if (status == GG_OK) printf("  time  T (hotter)  T (colder)  theta (hotter)  theta (colder)\n");
  for (int i = 0; i < 12 && status == GG_OK; i++) {
    for (int k = 0; k < 2 && status == GG_OK; k++) {
      status = gg_simulation_get_state(gas[k], &s[k], &err);
      if (status == GG_OK) status = gg_simulation_advance(gas[k], 0.2, &err);
    }
    if (status == GG_OK)
      printf("%6.2f %11.4f %11.4f %15.4f %15.4f%s\n", 0.2 * i, s[0].temperature, s[1].temperature,
             s[0].rotational_temperature, s[1].rotational_temperature,
             s[0].temperature < s[1].temperature ? "  crossed" : "");
  }
  if (status != GG_OK) fprintf(stderr, "%s\n", err.message);
  for (int k = 0; k < 2; k++) {
    gg_simulation_free(gas[k]);
    gg_scene_free(scene[k]);
  }
  return status == GG_OK ? 0 : 1;
}
