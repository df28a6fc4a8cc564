/* SPDX-License-Identifier: GPL-3.0-or-later */
/* z-scores of the engines, and deviations from Enskog's equation and from theories. */
#include "run/z_scores.h"

#include <math.h>

#include "scene/scene.h"
#include "theory/md_causes.h"

double gg_run_z_score(const gg_estimate *a, const gg_estimate *b)
{
  double error = hypot(a->error, b->error);
  return error > 0 ? (a->mean - b->mean) / error : NAN;
}

bool gg_run_has_theories(const gg_comparison *c, gg_quantity q)
{
  return !gg_scene_is_followed(c->scene) || (gg_common_quantity_mask(q) & GG_NEEDS_LINEAR_RESPONSE);
}

/* Solution of enskog_hermite with its numerical error; false where there is none. */
static bool enskog_solution(const gg_comparison *c, gg_quantity q, gg_estimate *solution)
{
  if (!gg_run_has_theories(c, q)) return false;
  for (int i = 0; i < c->n_theories; i++) {
    if (c->theory[i].theory != &gg_theory_enskog_hermite || !c->theory[i].applies) continue;
    double error = c->theory[i].answer.error[q];
    *solution = (gg_estimate){.mean = c->theory[i].answer.value[q], .error = isfinite(error) ? error : 0};
    return isfinite(solution->mean);
  }
  return false;
}

/* True for values about zero, whose ratios are meaningless. */
static bool about_zero(gg_quantity q, const gg_estimate *solution)
{
  return gg_common_quantity_mask(q) & (GG_DRAWN | GG_STRESS_DIFFERENCE) || fabs(solution->mean) <= 3 * solution->error;
}

gg_departure gg_run_reference_deviation(gg_quantity q, const gg_estimate *mean, const gg_estimate *reference)
{
  const double own = isfinite(mean->error) ? mean->error : 0, error = hypot(own, reference->error),
               scale = about_zero(q, reference) ? NAN : reference->mean, difference = mean->mean - reference->mean;
  return (gg_departure){.difference = difference,
                        .error = error,
                        .z = isfinite(mean->error) && error > 0 ? difference / error : NAN,
                        .deviation = difference / scale,
                        .deviation_error = hypot(own, mean->mean / scale * reference->error) / fabs(scale),
                        .headline = gg_common_quantity_mask(q) & (GG_DRAWN | GG_DRAWN_AS_RATIO) ? 1 : 0};
}

bool gg_run_enskog_deviation(const gg_comparison *c, gg_engine_kind kind, gg_quantity q, gg_departure *d)
{
  gg_estimate solution;
  const gg_result *r = c->by_engine[kind];
  if (!r || !isfinite(r->value[q].mean) || !enskog_solution(c, q, &solution)) return false;
  const gg_departure found = gg_run_reference_deviation(q, &r->value[q], &solution);
  if (!isfinite(found.z)) return false;
  *d = found;
  return true;
}

bool gg_run_is_beyond(const gg_model *m, gg_quantity q, const gg_estimate *mean, const gg_estimate *reference)
{
  const double difference = fabs(mean->mean - reference->mean),
               scale = gg_common_quantity_mask(q) & GG_STRESS_DIFFERENCE ? 1 : fabs(reference->mean),
               error = hypot(isfinite(mean->error) ? mean->error : 0, reference->error);
  return difference > 4 * error && difference > gg_theory_expected_deviation(m, q) * scale;
}

/* A user-defined quantity may have another number in a result that was read from a file. */
static const gg_estimate *estimate_of(const gg_result *r, const gg_quantity_row *row)
{
  const gg_quantity_row *own = r ? gg_run_rows_find(&r->rows, row->name) : NULL;
  return own ? &r->value[own->quantity] : NULL;
}

bool gg_run_reference_find(const gg_comparison *c, const gg_quantity_row *row, gg_reference *reference)
{
  const gg_estimate *dsmc = estimate_of(c->by_engine[GG_DSMC], row);
  reference->method = gg_theory_enskog_hermite.name;
  if (enskog_solution(c, row->quantity, &reference->value)) return true;
  if (!dsmc || !isfinite(dsmc->mean) || !isfinite(dsmc->error)) return false;
  *reference = (gg_reference){c->by_engine[GG_DSMC]->engine, *dsmc};
  return true;
}

bool gg_run_results_disagree(const gg_comparison *c, gg_quantity q)
{
  gg_estimate enskog;
  if (!c->by_engine[GG_MD]) return false;
  if (!enskog_solution(c, q, &enskog)) {
    if (!c->by_engine[GG_DSMC]) return false;
    enskog = c->by_engine[GG_DSMC]->value[q];
  }
  const gg_estimate *md = &c->by_engine[GG_MD]->value[q];
  return md->error > 0 && gg_run_is_beyond(&c->model, q, md, &enskog);
}

double gg_run_deviation(const gg_estimate *simulation, double theory)
{
  bool significant = fabs(simulation->mean) > 3 * (isnan(simulation->error) ? 0 : simulation->error);
  return significant ? theory / simulation->mean - 1 : NAN;
}

/* Relative deviation if it is significant and larger than expected between md and dsmc; else NaN. */
static double unexpected(const gg_comparison *c, const gg_estimate *e, gg_quantity q, double theory)
{
  double off = gg_run_deviation(e, theory);
  bool known = isfinite(off) && fabs(theory - e->mean) > 4 * (isnan(e->error) ? 0 : e->error);
  return known && fabs(off) > gg_theory_expected_deviation(&c->model, q) ? off : NAN;
}

static const char no_cause[] = "no cause known: within the range that the theory was made for";

const char *gg_run_theory_cause(const gg_theory_answer *answer)
{
  return *answer->remark ? answer->remark : no_cause;
}

/* Cause of a theory's deviation. If the theory agrees with the noise-free solution or with dsmc, md itself differs from
 * Enskog's equation. */
static const char *cause_of(const gg_comparison *c, const gg_run_theory_remark *r, const gg_theory_answer *answer)
{
  const double value = answer->value[r->quantity];
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  gg_estimate enskog;
  if (*answer->remark) return answer->remark;
  if (md && enskog_solution(c, r->quantity, &enskog) && isnan(unexpected(c, &enskog, r->quantity, value)))
    return "agrees with enskog_hermite: md differs from Enskog's equation (correlations, clustering or the number of "
           "grains)";
  const gg_estimate *e = dsmc ? &dsmc->value[r->quantity] : NULL;
  if (md && e && isfinite(e->mean) && isnan(unexpected(c, e, r->quantity, value)))
    return "agrees with dsmc: md differs from Enskog's equation (correlations, clustering or the number of grains)";
  return no_cause;
}

int gg_run_theory_remarks(const gg_comparison *c, gg_run_theory_remark remarks[GG_MOST_THEORIES])
{
  gg_quantity headline[GG_N_QUANTITIES];
  const gg_result *simulation = gg_run_comparison_first(c);
  int n = 0, n_headline = gg_scene_is_followed(c->scene) ? 0 : gg_run_headline_quantities(&c->model, headline);
  for (int i = 0; simulation && i < c->n_theories; i++) {
    gg_run_theory_remark r = {.theory = c->theory[i].theory};
    if (r.theory == &gg_theory_enskog_hermite) continue;
    for (int k = 0; c->theory[i].applies && k < n_headline; k++) {
      double off = unexpected(c, &simulation->value[headline[k]], headline[k], c->theory[i].answer.value[headline[k]]);
      if (fabs(off) > fabs(r.deviation)) r.quantity = headline[k], r.deviation = off;
    }
    if (r.deviation == 0) continue;
    r.cause = cause_of(c, &r, &c->theory[i].answer);
    remarks[n++] = r;
  }
  return n;
}

void gg_run_comparison_row(const gg_comparison *c, const gg_quantity_row *named, gg_comparison_row *row)
{
  const gg_quantity q = named->quantity;
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  *row = (gg_comparison_row){.name = named->name, .symbol = *named->symbol ? named->symbol : NULL, .unit = named->unit};
  for (int k = 0; k < GG_N_ENGINES; k++) {
    const gg_estimate *e = estimate_of(c->by_engine[k], named);
    row->mean[k] = e ? e->mean : NAN, row->error[k] = e ? e->error : NAN;
    if (!gg_run_enskog_deviation(c, (gg_engine_kind)k, q, &row->departure[k]))
      row->departure[k] = (gg_departure){NAN, NAN, NAN, NAN, NAN, 0};
  }
  row->z = md && dsmc ? gg_run_z_score(&md->value[q], &dsmc->value[q]) : NAN;
  row->beyond = gg_run_results_disagree(c, q);
}
