/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/order_convergence.h"

#include <math.h>
#include <string.h>

#include "theory/answer.h"

gg_theory_answer *gg_hermite_convergence_next(gg_hermite_convergence *r)
{
  memmove(r->answer + 1, r->answer, 3 * sizeof *r->answer);
  r->n++;
  for (int q = 0; q < GG_MOST_QUANTITIES; q++) r->answer[0].value[q] = r->answer[0].error[q] = NAN;
  return &r->answer[0];
}

static double step(const gg_hermite_convergence *r, gg_quantity q, int k)
{
  return k + 1 < r->n ? r->answer[k].value[q] - r->answer[k + 1].value[q] : 0;
}

static double last_change(const gg_hermite_convergence *r, gg_quantity q)
{
  return fmax(fabs(step(r, q, 0)), fabs(step(r, q, 0) + step(r, q, 1)) / 10);
}

/* Error of a quantity of sheared gases, whose degrees change in pairs: multiples of four change it much, degrees
 * between them little, and any single step may vanish by chance. So the last three count together. Weights: in 90
 * sheared mixtures of two species (phi up to 0.1, e from 0.2 to 0.9) degree 14 differs by at most 1.6 such errors
 * from degrees 10 and 12 in every quantity. */
static double paired_error(const gg_hermite_convergence *r, gg_quantity q)
{
  const bool much = r->n % 2; /* from degree 4 on */
  return hypot(hypot(step(r, q, 0), (much ? 0.8 : 0.2) * step(r, q, 1)), (much ? 0.08 : 0.06) * step(r, q, 2));
}

double gg_hermite_convergence_error_of(const gg_hermite_convergence *r, gg_quantity q)
{
  const double of_degree = r->paired ? paired_error(r, q) : last_change(r, q);
  return r->widened ? hypot(of_degree, r->wide.value[q] - r->answer[0].value[q]) : of_degree;
}

double gg_hermite_convergence_change(const gg_hermite_convergence *r, gg_quantity q)
{
  return r->n < 2 ? INFINITY : last_change(r, q) / fabs(r->answer[0].value[q]);
}

void gg_hermite_convergence_take(const gg_hermite_convergence *r, gg_quantity q, gg_theory_answer *a)
{
  a->value[q] = r->widened ? r->wide.value[q] : r->answer[0].value[q];
  a->error[q] = gg_hermite_convergence_error_of(r, q);
}

gg_status gg_hermite_convergence_finish(const gg_hermite_convergence *r, const char *theory, gg_quantity judge,
                                        double least, gg_theory_answer *a, gg_error *err)
{
  *a = r->widened ? r->wide : r->answer[0];
  for (int q = 0; q < GG_N_QUANTITIES; q++) a->error[q] = gg_hermite_convergence_error_of(r, (gg_quantity)q);
  double left = r->n < 2 ? INFINITY : a->error[judge] / fmax(fabs(a->value[judge]), least);
  if (left < (r->poor > 0 ? r->poor : 0.01)) return GG_OK;
  return gg_theory_reject(err, theory, "does not converge here: it is still %.1g %% off", 100 * left);
}
