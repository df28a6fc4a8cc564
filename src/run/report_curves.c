#include <stdlib.h>

#include "run/replicas.h"

#define STRONG 0.6

/* Errors allow for blocks that depend on their neighbours; where they depend strongly the allowance is a guess. */
static void warn_of_short_blocks(gg_result *result, int from, const char *name)
{
  const gg_curve *worst = NULL;
  for (int i = from; i < result->curves.n; i++) {
    const gg_curve *c = &result->curves.curve[i];
    if (c->block_correlation > STRONG && (!worst || c->block_correlation > worst->block_correlation)) worst = c;
  }
  if (worst)
    gg_result_warn(result,
                   "%s: blocks of samples are no longer than a correlation time (neighbours' correlation %.2f, "
                   "%s): its errors are rough; average longer",
                   name, worst->block_correlation, worst->name);
}

static gg_status report_one(const gg_replicas *all, int k, gg_result *result, gg_error *err)
{
  const gg_replica *first = &all->replica[0];
  const gg_observable *o = first->observable[k];
  const gg_bins **bins = gg_new_array((size_t)all->n, sizeof *bins, err);
  if (!bins) return GG_FAILED;
  for (int r = 0; r < all->n; r++) bins[r] = &all->replica[r].bins[k];
  int before = result->curves.n;
  gg_status status = gg_curves_estimate(bins, (size_t)all->n, o->curves, first->self[k], o->name, &result->curves, err);
  if (status == GG_OK && (size_t)all->n * bins[0]->blocks < GG_MIN_BLOCKS)
    gg_result_warn(result, "%s: too short for errors: its samples make %zu blocks only, %d are needed", o->name,
                   (size_t)all->n * bins[0]->blocks, GG_MIN_BLOCKS);
  warn_of_short_blocks(result, before, o->name);
  free(bins);
  return status;
}

gg_status gg_replicas_report_curves(const gg_replicas *all, gg_result *result, gg_error *err)
{
  result->curves = (gg_curves){.model = &result->model};
  for (int i = 0; gg_observables[i]; i++) {
    const gg_observable *o = gg_observables[i];
    const char *why = all->scene.measure & o->flag && o->refuses ? o->refuses(&all->model) : NULL;
    if (why) gg_result_warn(result, "%s is not measured: %s", o->name, why);
  }
  for (int k = 0; k < all->replica[0].n_observables; k++)
    if (all->replica[0].observable[k]->bins) GG_TRY(report_one(all, k, result, err));
  return GG_OK;
}
