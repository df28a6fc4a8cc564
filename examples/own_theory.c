/* A user-defined theory beside those of the library: the cooling rate of smooth Maxwellian grains,
 * zeta* = (5/12) chi (1 - e^2), chi the contact value.
 * Build: cc own_theory.c -o own_theory $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>
#include <string.h>

static const char *maxwellian(void *context, const gg_facts *facts, double *values)
{
  (void)context;
  if (strcmp(facts->flow, "hcs") != 0) return "describes free cooling";
  if (facts->n_species > 1 || facts->pairs[0].beta != -1) return "describes smooth grains of one species";
  values[0] = 5.0 / 12 * facts->pairs[0].contact_value * (1 - facts->pairs[0].e * facts->pairs[0].e);
  return NULL;
}

int main(void)
{
  static const char *const quantities[] = {"cooling_rate"};
  static const char *const names[] = {"maxwellian", "garzo_dufty1999"};
  static gg_theory_definition mine; /* all zero: no citation, no context */
  gg_error err;
  gg_scene *scene = NULL;
  gg_comparison *theories = NULL;
  mine.name = names[0];
  mine.title = "Cooling of Maxwellian grains";
  mine.n_quantities = 1;
  mine.quantities = quantities;
  mine.evaluate = maxwellian;
  if (gg_scene_parse("{flow: hcs, phi: 0.1, collision: {e: 0.8}}", "scene", &scene, &err) ||
      gg_scene_add_theory(scene, &mine, &err) || gg_theories_evaluate(scene, NULL, NULL, NULL, &theories, &err))
    fprintf(stderr, "%s\n", err.message);
  for (int i = 0; theories && i < 2; i++) {
    double zeta = 0;
    if (gg_comparison_theory_value(theories, names[i], "cooling_rate", &zeta, NULL, &err))
      fprintf(stderr, "%s\n", err.message);
    printf("%-16s zeta* = %.5f\n", names[i], zeta);
  }
  gg_scene_free(scene);
  if (!theories) return 1;
  gg_comparison_free(theories);
  return 0;
}
