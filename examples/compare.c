/* Both engines and every theory on one scene: the means side by side, and how far a theory is from md.
 * Build: cc compare.c -o compare $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

/* One quantity: md, dsmc, their distance in standard errors, and Enskog's equation solved without random numbers. */
static gg_status print_row(const gg_comparison *c, const char *quantity, gg_error *err)
{
  static const char *const engine[] = {"md", "dsmc"};
  char mean[2][40];
  double z, value, deviation;
  int beyond;
  for (int i = 0; i < 2; i++) {
    gg_measurement m;
    if (gg_result_find(gg_comparison_result(c, engine[i]), quantity, &m, err)) return err->status;
    gg_format_estimate(m.mean, m.error, mean[i], sizeof mean[i]);
  }
  if (gg_comparison_agreement(c, quantity, &z, &beyond, err) ||
      gg_comparison_theory_value(c, "enskog_hermite", quantity, &value, &deviation, err))
    return err->status;
  printf("%-24s %14s %14s %+6.1f%s %10.4g %+6.1f%%\n", quantity, mean[0], mean[1], z, beyond ? "!" : " ", value,
         100 * deviation);
  return GG_OK;
}

int main(void)
{
  static const char *const quantities[] = {"temperature", "compressibility_factor", "shear_viscosity", "N1"};
  static gg_run_options options; /* zero: defaults */
  gg_error err;
  gg_scene *scene = NULL;
  gg_comparison *c = NULL;
  gg_remark remark;
  options.size = sizeof options;
  gg_status status = gg_scene_parse("{flow: usf, phi: 0.2, particles: 500, collision: {e: 0.8}, "
                                    "run: {collisions: 400}}",
                                    "scene", &scene, &err);
  if (status == GG_OK) status = gg_compare(scene, &options, &c, &err);
  for (int i = 0; i < 4 && status == GG_OK; i++) status = print_row(c, quantities[i], &err);
  for (size_t i = 0; status == GG_OK && gg_comparison_remark(c, i, &remark, NULL) == GG_OK; i++)
    printf("%s: %s\n", remark.theory ? remark.theory : "md and Enskog's equation", remark.cause);
  if (status != GG_OK) fprintf(stderr, "%s\n", err.message);
  gg_comparison_free(c);
  gg_scene_free(scene);
  return (int)status;
}
