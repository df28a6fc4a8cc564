/* A user-defined restitution law: slow impacts are nearly elastic, fast ones come to e = 0.7, with the speed of between
 * in units of d gamma. The slower that speed, the cooler the sheared gas.
 * Build: cc own_restitution.c -o own_restitution $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

static double softening(void *context, double g, int one, int two)
{
  double between = *(const double *)context;
  (void)one, (void)two;
  return 1 - 0.3 * g / (g + between);
}

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  double between[] = {1, 10, 100};
  if (gg_scene_parse("{flow: usf, phi: 0.1, particles: 500, run: {collisions: 200}}", "scene", &scene, &err)) return 2;
  for (int k = 0; k < 3; k++) {
    gg_result *result = NULL;
    double T, error;
    if (gg_scene_set_restitution(scene, "softening", softening, &between[k], &err) ||
        gg_run(scene, NULL, &result, &err) || gg_result_get(result, "temperature", &T, &error, &err))
      fprintf(stderr, "%s\n", err.message);
    else
      printf("%g: T = %.4g +- %.2g %s\n", between[k], T, error, gg_result_unit(result, "temperature"));
    gg_result_free(result);
  }
  gg_scene_free(scene);
  return 0;
}
