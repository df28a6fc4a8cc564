#include "theory/hermite/order_convergence.h"

#include <math.h>

#include "theory/answer.h"

static const double poor = 0.01;

gg_theory_answer *gg_hermite_convergence_next(gg_rungs *r)
{
  r->answer[2] = r->answer[1];
  r->answer[1] = r->answer[0];
  r->n++;
  for (int q = 0; q < GG_MOST_QUANTITIES; q++) r->answer[0].value[q] = r->answer[0].error[q] = NAN;
  return &r->answer[0];
}

/* Series fall in pairs of degrees, now on one side of the limit, now on the other: the last step, or a tenth of the
 * last two, whichever is more. */
double gg_hermite_convergence_error_of(const gg_rungs *r, gg_quantity q)
{
  double last = fabs(r->answer[0].value[q] - r->answer[1].value[q]);
  return r->n < 3 ? last : fmax(last, fabs(r->answer[0].value[q] - r->answer[2].value[q]) / 10);
}

double gg_hermite_convergence_error(const gg_rungs *r, gg_quantity q)
{
  return r->n < 2 ? INFINITY : gg_hermite_convergence_error_of(r, q) / fabs(r->answer[0].value[q]);
}

void gg_hermite_convergence_take(const gg_rungs *r, gg_quantity q, gg_theory_answer *a)
{
  a->value[q] = r->answer[0].value[q];
  a->error[q] = gg_hermite_convergence_error_of(r, q);
}

gg_status gg_hermite_convergence_finish(const gg_rungs *r, const char *theory, gg_quantity judge, double least,
                                        gg_theory_answer *a, gg_error *err)
{
  *a = r->answer[0];
  for (int q = 0; q < GG_N_QUANTITIES; q++) a->error[q] = gg_hermite_convergence_error_of(r, (gg_quantity)q);
  double left = r->n < 2 ? INFINITY : a->error[judge] / fmax(fabs(a->value[judge]), least);
  if (left < poor) return GG_OK;
  return gg_theory_reject(err, theory, "does not converge here: it is still %.1g %% off", 100 * left);
}
