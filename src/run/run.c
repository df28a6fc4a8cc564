#include "run/run.h"

#include <math.h>
#include <stdlib.h>

#include "run/replicas.h"

gg_status gg_run_scene(const gg_scene *scene, const gg_archive *resume, int threads, const gg_hooks *hooks,
                       gg_result **out, gg_error *err)
{
  gg_replicas all;
  *out = NULL;
  GG_TRY(gg_replicas_create(&all, scene, resume, threads, hooks, err));
  gg_status status = gg_replicas_run(&all, err);
  gg_result *result = NULL;
  if (status == GG_OK) {
    result = gg_new_array(1, sizeof *result, err);
    status = result ? gg_replicas_report(&all, result, err) : GG_FAILED;
    if (result && resume && scene->output.trajectory_every > 0)
      gg_result_warn(result, "the trajectory begins where the run was resumed");
  }
  gg_replicas_clear(&all);
  *out = result;
  return status;
}

gg_status gg_run(const gg_scene *scene, gg_result **result, gg_error *err)
{
  return gg_run_scene(scene, NULL, 1, NULL, result, err);
}

gg_status gg_result_get(const gg_result *result, const char *name, double *mean, double *error, gg_error *err)
{
  gg_quantity q = gg_quantity_find_in(&result->model, name);
  if (q == GG_MOST_QUANTITIES) return gg_fail(err, GG_BAD_INPUT, "there is no quantity called '%s'", name);
  const gg_estimate *e = &result->value[q];
  if (isnan(e->mean)) return gg_fail(err, GG_BAD_INPUT, "'%s' cannot be had here: %s", name, e->reason);
  if (mean) *mean = e->mean;
  if (error) *error = e->error;
  return GG_OK;
}

const char *gg_result_unit(const gg_result *result, const char *name)
{
  gg_quantity q = gg_quantity_find_in(&result->model, name);
  if (q == GG_MOST_QUANTITIES || isnan(result->value[q].mean)) return NULL;
  return gg_quantity_unit(q, &result->model);
}

int gg_result_is_steady(const gg_result *result)
{
  return result->steadiness == GG_STEADY;
}

const char *gg_version(void)
{
  return GG_VERSION;
}
