#include <stdlib.h>

#include "run/campaign.h"

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

static gg_status report_one(const gg_campaign *c, int k, gg_result *result, gg_error *err)
{
  const gg_replica *first = &c->replicas[0];
  const gg_observable *o = first->observable[k];
  const gg_bins **bins = gg_new_array((size_t)c->n, sizeof *bins, err);
  if (!bins) return GG_FAILED;
  for (int r = 0; r < c->n; r++) bins[r] = &c->replicas[r].bins[k];
  int before = result->curves.n;
  gg_status status = gg_curves_estimate(bins, (size_t)c->n, o->curves, first->self[k], o->name, &result->curves, err);
  if (status == GG_OK && (size_t)c->n * bins[0]->blocks < GG_MIN_BLOCKS)
    gg_result_warn(result, "%s: too short for errors: it was looked at in %zu blocks only, %d are needed", o->name,
                   (size_t)c->n * bins[0]->blocks, GG_MIN_BLOCKS);
  warn_of_short_blocks(result, before, o->name);
  free(bins);
  return status;
}

gg_status gg_campaign_report_curves(const gg_campaign *c, gg_result *result, gg_error *err)
{
  result->curves = (gg_curves){.model = &result->model};
  for (int i = 0; gg_observables[i]; i++) {
    const gg_observable *o = gg_observables[i];
    const char *why = c->scene.measure & o->flag && o->refuses ? o->refuses(&c->model) : NULL;
    if (why) gg_result_warn(result, "%s is not measured: %s", o->name, why);
  }
  for (int k = 0; k < c->replicas[0].n_observables; k++)
    if (c->replicas[0].observable[k]->bins) GG_TRY(report_one(c, k, result, err));
  return GG_OK;
}
