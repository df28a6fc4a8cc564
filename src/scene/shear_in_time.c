/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A shear rate that is a formula of time. Engines have piecewise constant rates: in each of equal steps the mean of the
 * formula, so that the strain is exact at the end of every step. */
#include <math.h>

#include "common/expression.h"
#include "scene/fields.h"

static gg_expression formula_of(const gg_scene *s)
{
  gg_expression e = {0};
  gg_common_expression_parse(&e, s->shear.formula, (const char *const[]){"t", NULL}, NULL); /* was read without error */
  return e;
}

static double length_of(const gg_scene *s)
{
  return s->run.duration / (double)gg_scene_shear_steps(s);
}

int64_t gg_scene_shear_steps(const gg_scene *s)
{
  if (!*s->shear.formula || !gg_scene_is_followed(s)) return 0;
  return (int64_t)gg_scene_shear_periods(s) * s->shear.steps;
}

double gg_scene_shear_periods(const gg_scene *s)
{
  return s->shear.period == GG_AUTO ? 1 : fmax(round(s->run.duration / s->shear.period), 1);
}

double gg_scene_shear_rate(const gg_scene *s, int64_t step)
{
  double unused;
  if (gg_scene_shear_steps(s) == 0) return s->shear.rate;
  const gg_expression e = formula_of(s);
  return gg_common_expression_mean(&e, (double)step * length_of(s), length_of(s), &unused);
}

double gg_scene_shear_strain(const gg_scene *s, double time)
{
  const gg_expression e = formula_of(s);
  const double length = length_of(s);
  double strain = 0, unused;
  for (int64_t k = 0; k < gg_scene_shear_steps(s) && (double)k * length < time; k++)
    strain +=
        gg_common_expression_mean(&e, (double)k * length, length, &unused) * fmin(length, time - (double)k * length);
  return strain;
}

enum { LEAST_STEPS = 8, MOST_STEPS = 100000 };

static gg_status check_steps(const gg_scene *s, gg_error *err)
{
  const double periods = s->run.duration / s->shear.period;
  const bool whole = fabs(periods - round(periods)) <= 1e-9 * periods;
  if (s->shear.period != GG_AUTO && !(whole && periods >= 1.5))
    return GG_REFUSE(err, "key 'shear_period': run.duration %g has %.6g of them; allowed: a whole number, 2 or more",
                     s->run.duration, periods);
  if (s->shear.period != GG_AUTO && s->shear.steps < LEAST_STEPS)
    return GG_REFUSE(err, "key 'shear_steps': %lld in shear_period; allowed: from %d, for harmonics",
                     (long long)s->shear.steps, LEAST_STEPS);
  if (gg_scene_shear_periods(s) * (double)s->shear.steps <= MOST_STEPS) return GG_OK;
  return GG_REFUSE(err, "key 'shear_steps': %g steps in the run; allowed: up to %d",
                   gg_scene_shear_periods(s) * (double)s->shear.steps, MOST_STEPS);
}

gg_status gg_scene_shear_finish(gg_scene *s, gg_error *err)
{
  const gg_expression e = formula_of(s);
  if (s->flow != GG_USF || !gg_scene_is_followed(s))
    return GG_REFUSE(err, "key 'shear_rate': a formula needs flow: %s and run.duration", gg_flow_of(GG_USF)->word);
  GG_TRY(check_steps(s, err));
  double most = 0;
  for (int64_t k = 0; k < gg_scene_shear_steps(s) && !isnan(most); k++) {
    double largest;
    gg_common_expression_mean(&e, (double)k * length_of(s), length_of(s), &largest);
    most = isnan(largest) ? NAN : fmax(most, largest);
  }
  if (!(most > 0 && most < 1e30))
    return GG_REFUSE(err, "key 'shear_rate': '%s' is %s", s->shear.formula,
                     most == 0 ? "0 all the time" : "infinite or not a number at some time");
  s->shear.rate = most;
  return GG_OK;
}
