#include "run/run.h"

#include "base/memory.h"
#include "run/replicas.h"

/* Where the replicas stand as a result; it may fall short of what was asked. */
static gg_status report(gg_replicas *all, gg_result **out, gg_error *err)
{
  gg_result *result = gg_base_array_new(1, sizeof *result, err);
  if (!result) return GG_FAILED;
  gg_run_replicas_level(all);
  gg_status status = gg_run_replicas_report(all, result, err);
  if (status != GG_OK) { /* out of memory: half a result is none */
    gg_result_free(result);
    return status;
  }
  *out = result;
  return gg_run_replicas_check_end(all, err);
}

gg_status gg_run_scene(const gg_scene *scene, const gg_archive *resume, int threads, const gg_run_callbacks *callbacks,
                       gg_result **out, gg_error *err)
{
  gg_replicas all;
  *out = NULL;
  bool before = gg_base_memory_begin();
  gg_status status = gg_run_replicas_create(&all, scene, resume, threads, callbacks, err);
  if (status != GG_OK) return gg_base_memory_check(before, status, err);
  status = gg_run_replicas_run(&all, err);
  if (status == GG_OK) status = report(&all, out, err);
  bool cut_short = status == GG_INTERRUPTED || status == GG_BAD_FILE; /* a checkpoint that cannot be written */
  if (cut_short) report(&all, out, NULL);
  if (status == GG_INTERRUPTED && *out) gg_run_result_warn(*out, "interrupted: these are the results so far");
  gg_run_replicas_clear(&all);
  if (!gg_base_memory_end(before) || status != GG_OK) return status;
  gg_result_free(*out); /* it lacks a warning, or worse */
  *out = NULL;
  return gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", gg_run_engine_ops_of(scene->engine)->name);
}
