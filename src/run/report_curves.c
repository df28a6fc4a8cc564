#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
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
    gg_run_result_warn(result,
                       "%s: blocks of samples are no longer than a correlation time (neighbours' correlation %.2f, "
                       "%s): its errors are rough; average longer",
                       name, worst->block_correlation, worst->name);
}

/* Folded curves do not feel on which side of the middle a dense core is. One that keeps to a side is to be seen all the
 * same: by more of the gap than grains alone fluctuate, and for a window of four correlation times or less, when half
 * of the mean square is the mean's. */
#define ASIDE_OF_GAP 0.01
#define ASIDE_SHARE 0.5

static void warn_of_one_side(const gg_slow_modes *w, gg_result *result)
{
  if (!(w->aside_share > ASIDE_SHARE && fabs(w->aside) > ASIDE_OF_GAP * result->model.box[1])) return;
  for (int i = 0; i < result->curves.n; i++) {
    if (!result->curves.curve[i].folded) continue;
    gg_run_result_warn(
        result,
        "profiles are means of the flow and its mirror image, but the flow kept to one side: the centre of "
        "mass was %.2g d from the middle of the gap on average, %.2g d at root mean square",
        w->aside, fabs(w->aside) / sqrt(w->aside_share));
    return;
  }
}

static gg_status report_one(const gg_replicas *all, int k, double memory, gg_result *result, gg_error *err)
{
  const gg_replica *first = &all->replica[0];
  const gg_observable *o = first->observable[k];
  const gg_bins **bins = gg_base_array_new((size_t)all->n, sizeof *bins, err);
  if (!bins) return GG_FAILED;
  for (int r = 0; r < all->n; r++) bins[r] = &all->replica[r].bins[k];
  int before = result->curves.n;
  gg_status status = gg_measure_curves_estimate(bins, (size_t)all->n, o->curves, first->self[k], o->name,
                                                memory / fmax(first->every[k], 1), &result->curves, err);
  if (status == GG_OK && (size_t)all->n * bins[0]->blocks < GG_MIN_BLOCKS)
    gg_run_result_warn(result, "%s: too short for errors: its samples make %zu blocks only, %d are needed", o->name,
                       (size_t)all->n * bins[0]->blocks, GG_MIN_BLOCKS);
  warn_of_short_blocks(result, before, o->name);
  free(bins);
  return status;
}

gg_status gg_run_replicas_report_curves(const gg_replicas *all, gg_result *result, gg_error *err)
{
  result->curves = (gg_curves){.model = &result->model};
  for (int i = 0; gg_measure_observables[i]; i++) {
    const gg_observable *o = gg_measure_observables[i];
    const char *why = all->scene.measure & o->flag && o->refuses ? o->refuses(&all->model) : NULL;
    if (why) gg_run_result_warn(result, "%s is not measured: %s", o->name, why);
  }
  gg_slow_modes slow;
  GG_TRY(gg_run_replicas_slow_modes(all, &slow, err));
  for (int k = 0; k < all->replica[0].n_observables; k++)
    if (all->replica[0].observable[k]->bins) GG_TRY(report_one(all, k, slow.mean_time, result, err));
  warn_of_one_side(&slow, result);
  return GG_OK;
}
