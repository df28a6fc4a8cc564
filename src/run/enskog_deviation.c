/* Simulations against Enskog's equation itself, where it is solved without random numbers. */
#include <math.h>

#include "run/z_scores.h"

bool gg_run_enskog_solution(const gg_comparison *c, gg_quantity q, gg_estimate *solution)
{
  for (int i = 0; i < c->n_theories; i++) {
    if (c->theory[i].theory != &gg_theory_enskog_hermite || !c->theory[i].applies) continue;
    double error = c->theory[i].answer.error[q];
    *solution = (gg_estimate){.mean = c->theory[i].answer.value[q], .error = isfinite(error) ? error : 0};
    return isfinite(solution->mean);
  }
  return false;
}

/* Numbers about zero, of which a ratio tells nothing. */
static bool about_zero(gg_quantity q, const gg_estimate *solution)
{
  return gg_common_quantity_mask(q) & (GG_DRAWN | GG_STRESS_DIFFERENCE) || fabs(solution->mean) <= 3 * solution->error;
}

bool gg_run_enskog_deviation(const gg_comparison *c, gg_engine_kind kind, gg_quantity q, gg_departure *d)
{
  gg_estimate solution;
  const gg_result *r = c->by_engine[kind];
  if (!r || !isfinite(r->value[q].mean) || !gg_run_enskog_solution(c, q, &solution)) return false;
  double error = hypot(r->value[q].error, solution.error), scale = about_zero(q, &solution) ? NAN : solution.mean;
  if (!(isfinite(error) && error > 0)) return false;
  *d = (gg_departure){.difference = r->value[q].mean - solution.mean,
                      .error = error,
                      .headline = gg_common_quantity_mask(q) & (GG_DRAWN | GG_DRAWN_AS_RATIO) ? 1 : 0};
  d->z = d->difference / error;
  d->deviation = d->difference / scale;
  d->deviation_error = error / fabs(scale);
  return true;
}
