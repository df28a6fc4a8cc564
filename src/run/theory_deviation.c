/* Theories against the simulations: how far off, and why. */
#include <math.h>

#include "run/z_scores.h"

double gg_run_deviation(const gg_estimate *simulation, double theory)
{
  bool told_from_zero = fabs(simulation->mean) > 3 * (isnan(simulation->error) ? 0 : simulation->error);
  return told_from_zero ? theory / simulation->mean - 1 : NAN;
}

/* Off by more than is expected of solutions of the same problem? NaN if not, or not known. */
static double unexpected(const gg_comparison *c, const gg_estimate *e, gg_quantity q, double theory)
{
  double off = gg_run_deviation(e, theory);
  bool known = isfinite(off) && fabs(theory - e->mean) > 4 * (isnan(e->error) ? 0 : e->error);
  return known && fabs(off) > gg_run_expected_deviation(&c->model, q) ? off : NAN;
}

/* Enskog's equation itself may be off: then a theory of it is as near to the Monte Carlo engine as may be. */
static const char *cause_of(const gg_comparison *c, const gg_theory_remark *r, double value)
{
  const char *beyond = gg_theory_beyond(r->theory, &c->model);
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  gg_estimate enskog;
  if (beyond) return beyond;
  if (md && gg_run_enskog_solution(c, r->quantity, &enskog) && isnan(unexpected(c, &enskog, r->quantity, value)))
    return "agrees with enskog_hermite: md differs from Enskog's equation (correlations, clustering or the number of "
           "grains)";
  const gg_estimate *e = dsmc ? &dsmc->value[r->quantity] : NULL;
  if (md && e && isfinite(e->mean) && isnan(unexpected(c, e, r->quantity, value)))
    return "agrees with dsmc: md differs from Enskog's equation (correlations, clustering or the number of grains)";
  return "no cause known: within the range that the theory was made for";
}

int gg_run_theory_remarks(const gg_comparison *c, gg_theory_remark remarks[GG_MOST_THEORIES])
{
  gg_quantity headline[GG_N_QUANTITIES];
  const gg_result *simulation = c->by_engine[GG_MD] ? c->by_engine[GG_MD] : c->by_engine[GG_DSMC];
  int n = 0, n_headline = gg_run_headline_quantities(&c->model, headline);
  for (int i = 0; simulation && i < c->n_theories; i++) {
    gg_theory_remark r = {.theory = c->theory[i].theory};
    if (r.theory == &gg_theory_enskog_hermite) continue;
    for (int k = 0; c->theory[i].applies && k < n_headline; k++) {
      double off = unexpected(c, &simulation->value[headline[k]], headline[k], c->theory[i].answer.value[headline[k]]);
      if (fabs(off) > fabs(r.deviation)) r.quantity = headline[k], r.deviation = off;
    }
    if (r.deviation == 0) continue;
    r.cause = cause_of(c, &r, c->theory[i].answer.value[r.quantity]);
    remarks[n++] = r;
  }
  return n;
}
