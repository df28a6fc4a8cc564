/* Temperature of a sheared granular gas. Build: cc shear.c -o shear $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  double T, dT;
  if (gg_scene_parse("{flow: usf, phi: 0.1, particles: 500, run: {relative_error: 0.03}}", "scene", &scene, &err) ||
      gg_run(scene, NULL, &result, &err) || gg_result_get(result, "temperature", &T, &dT, &err))
    fprintf(stderr, "%s\n", err.message);
  else
    printf("T = %g +- %g %s\n", T, dT, gg_result_unit(result, "temperature"));
  gg_result_free(result);
  gg_scene_free(scene);
}
