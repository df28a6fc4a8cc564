/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady-state test: whether a mean over the window is that of a steady state. */
#include <math.h>
#include <stdio.h>

#include "common/linear_response.h"
#include "measure/wall_modes.h"
#include "run/protocol_times.h"
#include "run/replicas.h"
#include "theory/spin_escape.h"

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

/* True if theta/T grows without end. With weak friction spins may lose less energy than velocities do: theta/T then
 * grows by decades, and scatters too much for a trend to show. */
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

typedef enum verdict {
  FOLLOWED,
  WITHOUT_LOSS,
  ARRESTED,
  IN_WARMUP,
  NOTHING_MEASURED,
  SPINS_RUN_AWAY,
  TRENDING,
  NO_SAMPLE,
  SHORTER_THAN_SLOWEST_MODE,
  LINEAR_RESPONSE,
  FEW_CORRELATION_TIMES,
  ONE_MODE_DOMINATES,
  METASTABLE,
  NO_TREND
} verdict;

/* A lower rate of escape is never met. */
static const double least_escapes = 1e-15;

/* Length of the averaging window. */
typedef struct window {
  double samples;  /* of one replica */
  double sampled;  /* by all replicas */
  double happened; /* collisions per grain */
} window;

static verdict decide(const gg_replicas *all, const gg_convergence *c, const gg_result *result, window w)
{
  double ratio;
  if (gg_scene_is_followed(&all->scene)) return FOLLOWED;
  if (!all->model.steady && !all->model.linear_response) return WITHOUT_LOSS;
  if (all->state.arrest_share > 0) return ARRESTED;
  if (!all->state.averaging) return IN_WARMUP;
  if (all->replica[0].series.width == 0) return NOTHING_MEASURED; /* not even modes of the gap */
  if (all->model.rule == GG_FRICTIONAL && spins_run_away(result, &ratio)) return SPINS_RUN_AWAY;
  if (c->trending) return TRENDING;
  if (w.samples == 0) return NO_SAMPLE;
  if (w.samples < (double)all->criteria.least_steady) return SHORTER_THAN_SLOWEST_MODE;
  if (all->model.linear_response) return LINEAR_RESPONSE;
  if (w.samples < GG_LEAST_CORRELATION_TIMES * c->slowest) return FEW_CORRELATION_TIMES;
  if (c->slow_mode >= 0 && w.sampled < c->slow_mode_least * c->slow_mode_time) return ONE_MODE_DOMINATES;
  return gg_theory_is_metastable(&all->model) && !(result->escape_rate < least_escapes) ? METASTABLE : NO_TREND;
}

static void describe_followed(const gg_replicas *all, char *text, size_t size)
{
  char when[40] = "the end";
  if (all->state.due < all->criteria.most)
    snprintf(when, sizeof when, "time %.3g", gg_run_protocol_time(&all->scene, all->state.due));
  snprintf(text, size, "followed in time, %d replica%s: values are those at %s", all->n, all->n > 1 ? "s" : "", when);
}

static void describe_spins(const gg_result *result, char *text, size_t size)
{
  double ratio;
  char beyond[32] = "infinity";
  spins_run_away(result, &ratio);
  if (isfinite(ratio)) snprintf(beyond, sizeof beyond, "%.2g", ratio);
  snprintf(text, size,
           "theta/T grows without end, and has come to %s: grains that spin fast have escaped friction, which takes "
           "less from them than collisions from velocities",
           beyond);
}

/* The rate of mixtures and of laws of restitution is unknown. */
static void describe_metastable(const gg_replicas *all, const gg_result *result, window w, char *text, size_t size)
{
  int n = snprintf(text, size, "no trend over %.0f collisions a grain, but grains that spin fast escape friction",
                   w.happened);
  if (isfinite(result->escape_rate))
    n += snprintf(text + n, size - (size_t)n, ", one of %lld about every %.1g collisions a grain",
                  (long long)all->model.n * all->n, 1 / (result->escape_rate * (double)all->model.n * all->n));
  snprintf(text + n, size - (size_t)n, "; theta/T then grows without end");
}

static void describe_linear_response(const gg_model *model, char *text, size_t size)
{
  const gg_linear_response s = gg_common_linear_response_of(model);
  snprintf(text, size, "%s: reduced shear rate a* from %g to %g again and again, viscosity extrapolated to a* = 0",
           s.cools ? "linear response of the cooling gas" : "linear response of the heated gas",
           s.cools ? s.low : s.high, s.cools ? s.high : s.low);
}

static void describe(verdict v, const gg_replicas *all, const gg_convergence *c, const gg_result *result, window w,
                     char *text, size_t size)
{
  switch (v) {
  case FOLLOWED: describe_followed(all, text, size); return;
  case WITHOUT_LOSS:
    snprintf(text, size, "no steady state exists: %s",
             all->model.by_speed.gains && !all->model.kicks ? "contacts give energy and take none"
             : all->model.kicks || all->model.turns
                 ? "what kicks and torques give is not lost again, or spins take up the kicks"
                 : "collisions lose no energy and shear heats the gas");
    return;
  case ARRESTED:
    snprintf(text, size, "the grains have come to rest or nearly so: %.0f %% of collisions are contacts that last",
             100 * all->state.arrest_share);
    return;
  case IN_WARMUP: snprintf(text, size, "the run ended in its warm-up"); return;
  case NOTHING_MEASURED: snprintf(text, size, "unknown: nothing is measured (rheology is needed)"); return;
  case SPINS_RUN_AWAY: describe_spins(result, text, size); return;
  case TRENDING: describe_trend(c, w.happened, text, size); return;
  case NO_SAMPLE: snprintf(text, size, "too short to tell: no sample was averaged over"); return;
  case SHORTER_THAN_SLOWEST_MODE:
    snprintf(text, size, "too short to tell: averaged over %.0f collisions a grain, the slowest mode needs %.0f",
             w.happened, (double)all->criteria.least_steady * w.happened / w.samples);
    return;
  case LINEAR_RESPONSE: describe_linear_response(&all->model, text, size); return;
  case FEW_CORRELATION_TIMES:
    snprintf(text, size,
             "too short to tell: averaged over %.1f correlation times of the slowest quantity, %d are needed",
             w.samples / c->slowest, GG_LEAST_CORRELATION_TIMES);
    return;
  case ONE_MODE_DOMINATES:
    snprintf(text, size,
             "too short to tell: one mode dominates, %s, which wanders with a correlation time of %.2g collisions a "
             "grain; averaged over %.1f of these, %d are needed",
             gg_measure_wall_mode_name(c->slow_mode), c->slow_mode_time * GG_SAMPLING_INTERVAL,
             w.sampled / c->slow_mode_time, c->slow_mode_least);
    return;
  case METASTABLE: describe_metastable(all, result, w, text, size); return;
  case NO_TREND:
    snprintf(text, size, "no trend over %.0f collisions a grain, %.0f correlation times of the slowest quantity",
             w.happened, w.samples / c->slowest);
    return;
  }
}

void gg_run_replicas_report_steadiness(const gg_replicas *all, const gg_convergence *c, gg_result *result)
{
  const double samples = (double)(all->state.due - all->state.window_at);
  const window w = {.samples = samples,
                    .sampled = samples * all->n,
                    .happened = 2 * (double)result->averaging.collisions / ((double)all->model.n * all->n)};
  result->escape_rate = gg_theory_spin_escape(&all->model);
  const verdict v = decide(all, c, result, w);
  result->steadiness = v == LINEAR_RESPONSE || v == NO_TREND ? GG_STEADY
                       : v == METASTABLE                     ? GG_METASTABLE
                       : v == FOLLOWED || v == WITHOUT_LOSS  ? GG_HEATING
                                                             : GG_NOT_STEADY;
  describe(v, all, c, result, w, result->steadiness_text, sizeof result->steadiness_text);
}
