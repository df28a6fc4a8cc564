/* Read a result file: every mean, the curves, how the run went. Without a file's name it makes one first.
 * Build: cc read.c -o read $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <math.h>
#include <stdio.h>

static gg_status make(const char *path, gg_error *err)
{
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  static gg_run_options options; /* zero: defaults */
  options.size = sizeof options;
  options.output = path;
  gg_status status = gg_scene_parse("{flow: usf, engine: dsmc, phi: 0.1, measure: [rheology, velocity_distributions], "
                                    "run: {collisions: 500}}",
                                    "scene", &scene, err);
  if (status == GG_OK) status = gg_run(scene, &options, &result, err);
  gg_result_free(result);
  gg_scene_free(scene);
  return status;
}

int main(int argc, char **argv)
{
  gg_error err;
  gg_result *result = NULL;
  gg_result_info about;
  gg_measurement m;
  gg_curve_data c;
  char text[40];
  const char *path = argc > 1 ? argv[1] : "read_example.h5";
  if ((argc < 2 && make(path, &err)) || gg_result_read(path, &result, &err) ||
      gg_result_get_info(result, &about, &err)) {
    fprintf(stderr, "%s\n", err.message);
    return err.status;
  }
  printf("%s, %s: %s\n", path, about.engine, about.verdict);
  for (size_t i = 0; gg_result_at(result, i, &m, NULL) == GG_OK; i++) {
    if (isnan(m.mean)) continue;
    gg_format_estimate(m.mean, m.error, text, sizeof text);
    printf("%-24s %16s %s\n", m.name, text, m.unit);
  }
  for (size_t i = 0; gg_result_curve(result, i, &c, NULL) == GG_OK; i++)
    printf("curve %s: %zu points of %s over %s [%s]\n", c.name, c.n, c.y_name, c.x_name, c.x_unit);
  gg_result_free(result);
  return 0;
}
