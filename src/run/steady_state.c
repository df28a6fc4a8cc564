/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady-state test: may a mean over the window be called that of a steady state? */
#include <math.h>
#include <stdio.h>

#include "common/linear_response.h"
#include "measure/wall_modes.h"
#include "run/relaxation.h"
#include "run/replicas.h"

static void describe_trend(const gg_convergence *c, double window, char *text, size_t size)
{
  const char *name = gg_common_quantity_name(c->trending_quantity);
  if (c->trend_share < 0.3)
    snprintf(text, size,
             "%s has a trend: the first %.0f collisions a grain of the averaging are off what follows by %.1f errors, "
             "and shift its mean by %+.2g %%",
             name, window * c->trend_share, fabs(c->trend_z), -100 * c->trend_relative);
  else
    snprintf(text, size, "%s has a trend: %+.2g %% from the first to the last third of the averaging, %.1f errors",
             name, 100 * c->trend_relative, fabs(c->trend_z));
}

/* Of grains with weak friction spins may lose less energy than velocities do for ever: theta/T grows by decades, and
 * scatters too much for a trend to show. */
static bool spins_run_away(const gg_result *r, double *ratio)
{
  const gg_history *h = &r->history;
  for (int k = 0; k < GG_N_HISTORY; k++) {
    if (gg_common_quantity_of_history(k) != GG_Q_TEMPERATURE_RATIO || h->n < 100) continue;
    *ratio = h->value[k][h->n - 1];
    const double earlier = h->value[k][h->n / 2];
    return !isnan(earlier) && !(*ratio < 1e3) && !(*ratio < 30 * earlier);
  }
  return false;
}

void gg_run_replicas_report_steadiness(const gg_replicas *all, const gg_convergence *c, gg_result *result)
{
  uint64_t window = all->state.due - all->state.window_at;
  char *text = result->steadiness_text;
  size_t size = sizeof result->steadiness_text;
  double sampled = (double)window * all->n; /* by all replicas */
  double happened = 2 * (double)result->averaging.collisions / ((double)all->model.n * all->n);
  double ratio;
  result->steadiness = GG_NOT_STEADY;
  if (gg_scene_is_followed(&all->scene)) {
    result->steadiness = GG_HEATING;
    char when[40] = "the end";
    if (all->state.due < all->criteria.most)
      snprintf(when, sizeof when, "time %.3g", gg_run_relaxation_time(&all->scene, all->state.due));
    snprintf(text, size, "followed in time, %d replica%s: values are those at %s", all->n, all->n > 1 ? "s" : "", when);
  } else if (!all->model.steady && !all->model.linear_response) {
    result->steadiness = GG_HEATING;
    snprintf(text, size, "no steady state exists: collisions lose no energy and shear heats the gas");
  } else if (all->state.arrest_share > 0) {
    snprintf(text, size, "the grains have come to rest or nearly so: %.0f %% of collisions are contacts that last",
             100 * all->state.arrest_share);
  } else if (!all->state.averaging) {
    snprintf(text, size, "the run ended in its warm-up");
  } else if (all->replica[0].series.width == 0) { /* not even modes of the gap */
    snprintf(text, size, "unknown: nothing is measured (rheology is needed)");
  } else if (spins_run_away(result, &ratio)) {
    char beyond[32] = "infinity";
    if (isfinite(ratio)) snprintf(beyond, sizeof beyond, "%.2g", ratio);
    snprintf(text, size,
             "theta/T grows without end, and has come to %s: friction takes less from spins than collisions from "
             "velocities",
             beyond);
  } else if (c->trending) {
    describe_trend(c, happened, text, size);
  } else if (window == 0) {
    snprintf(text, size, "too short to tell: no sample was averaged over");
  } else if (window < all->criteria.least_steady) {
    snprintf(text, size, "too short to tell: averaged over %.0f collisions a grain, the slowest mode asks for %.0f",
             happened, (double)all->criteria.least_steady * happened / (double)window);
  } else if (all->model.linear_response) {
    result->steadiness = GG_STEADY;
    gg_linear_response s = gg_common_linear_response_of(&all->model);
    snprintf(text, size, "%s: reduced shear rate a* from %g to %g again and again, viscosity extrapolated to a* = 0",
             s.cools ? "linear response of the cooling gas" : "linear response of the heated gas",
             s.cools ? s.low : s.high, s.cools ? s.high : s.low);
  } else if ((double)window < GG_LEAST_CORRELATION_TIMES * c->slowest) {
    snprintf(text, size,
             "too short to tell: averaged over %.1f correlation times of the slowest quantity, %d are needed",
             (double)window / c->slowest, GG_LEAST_CORRELATION_TIMES);
  } else if (c->slow_mode >= 0 && sampled < c->slow_mode_least * c->slow_mode_time) {
    snprintf(text, size,
             "too short to tell: one mode dominates, %s, which wanders with a correlation time of %.2g collisions a "
             "grain; averaged over %.1f of these, %d are needed",
             gg_measure_wall_mode_name(c->slow_mode), c->slow_mode_time * GG_SAMPLING_INTERVAL,
             sampled / c->slow_mode_time, c->slow_mode_least);
  } else {
    result->steadiness = GG_STEADY;
    snprintf(text, size, "no trend over %.0f collisions a grain, %.0f correlation times of the slowest quantity",
             happened, (double)window / c->slowest);
  }
}
