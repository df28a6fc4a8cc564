#include "theory/hermite/viscosity.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Shear rate of the central difference, in units in which T = m = 1. */
static const double small = 1e-3;

typedef struct gg_response {
  gg_hermite_operator op;
  gg_hermite_gas gas;
  gg_hermite_state *base;
  int n, *function; /* those odd in x and in y */
  double *R, *other, *jacobian, *a;
} gg_response;

static gg_status make(gg_response *r, gg_hermite_isotropic *state, gg_error *err)
{
  const gg_hermite_basis *b = &state->op.basis;
  size_t n = (size_t)b->n;
  *r = (gg_response){.gas = state->gas, .base = &state->state};
  GG_TRY(gg_hermite_operator_make(&r->op, b->degree, state->op.decay, false, err));
  r->function = malloc(n * sizeof *r->function);
  r->R = malloc((n * n + 3 * n) * sizeof *r->R);
  if (!r->function || !r->R) return gg_fail(err, GG_FAILED, "out of memory");
  r->other = r->R + n, r->a = r->other + n, r->jacobian = r->a + n;
  memcpy(r->a, state->state.a, n * sizeof *r->a);
  for (int i = 0; i < b->n; i++)
    if (b->function[i].r[0] % 2) r->function[r->n++] = i;
  return GG_OK;
}

static void clear(gg_response *r)
{
  gg_hermite_operator_clear(&r->op);
  free(r->function);
  free(r->R);
}

/* What the shear does to f0: half the difference of R at the two signs, over the shear rate. */
static void source(gg_response *r, double sigma)
{
  for (int sign = -1; sign <= 1; sign += 2) {
    gg_hermite_gas sheared = r->gas;
    sheared.shear = sign * small * sigma;
    sheared.stream[0][1] = sign * small;
    gg_hermite_operator_at(&r->op, &sheared, r->base->L, r->base->a, sign < 0 ? r->other : r->R, NULL);
  }
  for (int i = 0; i < r->op.basis.n; i++) r->R[i] = (r->R[i] - r->other[i]) / (2 * small);
}

/* d<psi_r>/dt of f1 itself where it fades: sum_s < psi_r Ho_s > a_s. */
static double overlap(const gg_response *r, int i, int j)
{
  const int *m = r->op.basis.function[i].r, *s = r->op.basis.function[j].r;
  if (m[0] + m[1] + m[2] <= 2) return i == j;
  double product = 1;
  for (int x = 0; x < 3; x++) product *= (m[x] - s[x]) % 2 ? 0 : r->op.overlap[m[x] * (r->op.basis.degree + 1) + s[x]];
  return product;
}

/* (J - fading) f1 = -source */
static bool solve(gg_response *r, double fading)
{
  size_t n = (size_t)r->n;
  gsl_matrix *J = gsl_matrix_alloc(n, n);
  gsl_vector *x = gsl_vector_alloc(n);
  gsl_permutation *order = gsl_permutation_alloc(n);
  bool fine = J && x && order;
  for (size_t i = 0; fine && i < n; i++) {
    gsl_vector_set(x, i, -r->R[r->function[i]]);
    for (size_t j = 0; j < n; j++) {
      int row = r->function[i], column = r->function[j];
      double value = r->jacobian[(size_t)row * (size_t)r->op.basis.n + (size_t)column];
      gsl_matrix_set(J, i, j, value - fading * overlap(r, row, column));
    }
  }
  int sign;
  fine = fine && gsl_linalg_LU_decomp(J, order, &sign) == GSL_SUCCESS && gsl_linalg_LU_svx(J, order, x) == GSL_SUCCESS;
  for (size_t i = 0; fine && i < n; i++) r->a[r->function[i]] = gsl_vector_get(x, i);
  if (J) gsl_matrix_free(J);
  if (x) gsl_vector_free(x);
  gsl_permutation_free(order);
  return fine;
}

/* Collisional transfer of momentum, by the same difference: f0 and the flow between centres both change sign with it.
 */
static double transfer(gg_response *r, double sigma)
{
  gg_hermite_sums sums[2];
  for (int k = 0; k < 2; k++) {
    double rate = k ? small : -small;
    gg_hermite_gas sheared = r->gas;
    sheared.shear = rate * sigma;
    memcpy(r->other, r->base->a, (size_t)r->op.basis.n * sizeof *r->other);
    for (int i = 0; i < r->n; i++) r->other[r->function[i]] = rate * r->a[r->function[i]];
    gg_hermite_sums_at(&r->op, &sheared, sigma, r->base->L, r->other, &sums[k]);
  }
  return (sums[1].transfer[0][1] - sums[0].transfer[0][1]) / (2 * small);
}

gg_status gg_hermite_viscosity_of(gg_hermite_isotropic *state, double sigma, double fading, gg_hermite_viscosity *v,
                                  gg_error *err)
{
  gg_response r;
  gg_status status = make(&r, state, err);
  if (status == GG_OK) {
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    gg_hermite_operator_at(&r.op, &r.gas, r.base->L, r.base->a, r.other, r.jacobian);
    source(&r, sigma);
    if (!solve(&r, fading)) status = gg_fail(err, GG_FAILED, "no linear response was found");
    gsl_set_error_handler(handler);
  }
  if (status == GG_OK) {
    int xy = gg_hermite_place(&r.op.basis, 1, 1, 0);
    v->kinetic = -r.a[xy] * r.base->L[0][0] * r.base->L[1][1];
    v->total = v->kinetic - (sigma > 0 ? transfer(&r, sigma) : 0);
  }
  clear(&r);
  return status;
}
