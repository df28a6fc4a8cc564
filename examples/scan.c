/* How the viscosity of a dilute sheared gas falls with the restitution coefficient, by Monte Carlo, beside a theory.
 * Build: cc scan.c -o scan $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  if (gg_scene_parse("{flow: usf, engine: dsmc, phi: 0}", "scene", &scene, &err)) return err.status;
  const char *values[] = {"0.95", "0.9", "0.8", "0.7"};
  for (int i = 0; i < 4; i++) {
    gg_result *result = NULL;
    gg_comparison *theories = NULL;
    double eta, error, theory;
    if (gg_scene_set(scene, "collision.e", values[i], &err) || gg_run(scene, NULL, &result, &err) ||
        gg_result_get(result, "shear_viscosity", &eta, &error, &err) ||
        gg_theories_evaluate(scene, "grad", NULL, NULL, &theories, &err) ||
        gg_comparison_theory_value(theories, "grad", "shear_viscosity", &theory, NULL, &err))
      fprintf(stderr, "%s\n", err.message);
    else
      printf("e = %s: eta = %.4g +- %.2g %s; Grad: %.4g\n", values[i], eta, error,
             gg_result_unit(result, "shear_viscosity"), theory);
    gg_result_free(result);
    gg_comparison_free(theories);
  }
  gg_scene_free(scene);
  return 0;
}
