/* Watch a run, and stop it when it is good enough: what it has found so far is the result.
 * Build: cc stop.c -o stop $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

static int progress(void *context, const gg_progress *now)
{
  const double *enough = (const double *)context;
  printf("%s %3.0f %%, %.3g collisions, error %.2g\n", now->phase, 100 * now->fraction, (double)now->collisions,
         now->relative_error);
  return now->relative_error < *enough; /* NaN is not: not known yet, in the warm-up and in short windows */
}

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  gg_measurement m;
  double enough = 0.003;
  static gg_run_options options; /* zero: defaults */
  options.size = sizeof options;
  options.progress = progress;
  options.context = &enough;
  if (gg_scene_parse("{flow: usf, engine: dsmc, phi: 0, run: {relative_error: 0.001}}", "scene", &scene, &err)) {
    fprintf(stderr, "%s\n", err.message);
    return err.status;
  }
  gg_status status = gg_run(scene, &options, &result, &err);
  if (status == GG_INTERRUPTED && gg_result_find(result, "temperature", &m, &err) == GG_OK)
    printf("stopped: T = %g +- %g %s from %llu samples\n", m.mean, m.error, m.unit, (unsigned long long)m.samples);
  else
    fprintf(stderr, "%s\n", err.message);
  gg_result_free(result);
  gg_scene_free(scene);
  return status == GG_INTERRUPTED ? 0 : 1;
}
