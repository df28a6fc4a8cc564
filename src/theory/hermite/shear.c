#include "theory/hermite/shear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "theory/gaussian_moments.h"
#include "theory/hermite/newton.h"

gg_status gg_hermite_shear_begin(gg_hermite_shear *h, const gg_model *m, gg_error *err)
{
  gg_gaussian start[GG_MAX_SPECIES];
  *h = (gg_hermite_shear){.model = m, .state.width = 1};
  h->gas = (gg_hermite_gas){.frequency = m->density * m->chi[0] * m->sigma[0] * m->sigma[0],
                            .eta = m->contact[0][0].jn,
                            .shear = m->boltzmann ? 0 : m->sigma[0] * m->shear_rate};
  h->gas.stream[0][1] = m->shear_rate;
  h->state.a = calloc((size_t)GG_HERMITE_MOST_FUNCTIONS, sizeof *h->state.a);
  if (!h->state.a) return gg_fail(err, GG_FAILED, "out of memory");
  h->state.a[0] = 1;
  double left = gg_gaussian_steady(m, start);
  if (left < 1e-6 && gg_hermite_gaussian(1, start[0].M.at, h->state.L)) return GG_OK;
  gg_hermite_shear_end(h);
  return gg_fail(err, GG_FAILED, "no steady state was found");
}

void gg_hermite_shear_end(gg_hermite_shear *h)
{
  gg_hermite_operator_clear(&h->op);
  free(h->state.a);
  *h = (gg_hermite_shear){0};
}

/* Functions are ordered by degree: those of the last degree keep their places, and the new ones are 0. */
gg_status gg_hermite_shear_solve(gg_hermite_shear *h, int degree, gg_error *err)
{
  double M[3][3], L[3][3];
  gg_hermite_operator_clear(&h->op);
  GG_TRY(gg_hermite_operator_make(&h->op, degree, GG_HERMITE_DECAY, false, err));
  gg_hermite_second_moments(&h->op.basis, &h->state, M);
  h->state.width = GG_HERMITE_WIDTH;
  if (!gg_hermite_gaussian(h->state.width, M, L)) return gg_fail(err, GG_FAILED, "no steady state was found");
  GG_TRY(gg_hermite_expand_anew(&h->op.basis, &h->state, L, err));
  return gg_hermite_newton(&h->op, &h->gas, &h->state, err);
}
