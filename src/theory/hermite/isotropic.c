/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/isotropic.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/direction_workspace.h"

enum { MOST_ITERATIONS = 60, HALVES = GG_HERMITE_MOST_DEGREE / 2 + 1 };
static const double converged = 1e-12;

/* Coefficient of Ho_r in the normalised Phi_l, 2 l its degree: l!/(x! y! z!) sqrt((2x)! (2y)! (2z)!/(2l + 1)!). */
static double coefficient(const int r[3])
{
  double product = 1;
  int l = 0;
  for (int i = 0; i < 3; i++) {
    if (r[i] % 2) return 0;
    l += r[i] / 2;
    product *= sqrt(gsl_sf_fact((unsigned)r[i])) / gsl_sf_fact((unsigned)r[i] / 2);
  }
  return product * gsl_sf_fact((unsigned)l) / sqrt(gsl_sf_fact(2 * (unsigned)l + 1));
}

void gg_hermite_isotropic_expand(const gg_hermite_basis *b, const double *alpha, double *a)
{
  for (int r = 0; r < b->n; r++) a[r] = alpha[gg_hermite_degree(b->function[r]) / 2] * coefficient(b->function[r].r);
}

static void project(const gg_hermite_basis *b, const double *R, double *projected)
{
  memset(projected, 0, HALVES * sizeof *projected);
  for (int r = 0; r < b->n; r++)
    projected[gg_hermite_degree(b->function[r]) / 2] += R[r] * coefficient(b->function[r].r);
}

typedef struct gg_isotropic_work {
  double *R, *jacobian, *column;
  gsl_matrix *J;
  gsl_vector *x;
  gsl_permutation *order;
} gg_isotropic_work;

static bool make(gg_isotropic_work *w, int n, int half)
{
  size_t m = (size_t)n, h = (size_t)half;
  *w = (gg_isotropic_work){.R = malloc((m * m + 2 * m) * sizeof *w->R),
                           .J = gsl_matrix_alloc(h, h),
                           .x = gsl_vector_alloc(h),
                           .order = gsl_permutation_alloc(h)};
  w->jacobian = w->R ? w->R + m : NULL, w->column = w->R ? w->jacobian + m * m : NULL;
  return w->R && w->J && w->x && w->order;
}

static void clear(gg_isotropic_work *w)
{
  free(w->R);
  if (w->J) gsl_matrix_free(w->J);
  if (w->x) gsl_vector_free(w->x);
  if (w->order) gsl_permutation_free(w->order);
}

static void heat(gg_hermite_gas *gas, gg_heating_rates rates)
{
  gas->drag[0] = rates.drag;
  gas->diffusion[0] = rates.diffusion;
}

/* The matrix: derivatives of d<psi>/dt by the unknowns, which are the heating in place of alpha_1, fixed by the
 * width; and alpha_2 ..., which decay. */
static void linearise(gg_hermite_isotropic *h, gg_isotropic_work *w, const gg_heating *heating, double fading)
{
  const gg_hermite_basis *b = &h->op.basis;
  int half = b->degree / 2;
  double projected[HALVES], basis[HALVES];
  for (int l = 1; l <= half; l++) {
    memset(w->column, 0, (size_t)b->n * sizeof *w->column);
    if (l == 1) {
      gg_hermite_gas unit = {0};
      heat(&unit, gg_theory_heating_slopes(heating, 0, h->heating));
      gg_hermite_add_streaming(&h->op, &unit, 0, &h->state, w->column, NULL, 0);
    } else {
      memset(basis, 0, sizeof basis);
      basis[l] = 1;
      gg_hermite_isotropic_expand(b, basis, h->state.a);
      for (int r = 0; r < b->n; r++)
        for (int s = 0; s < b->n; s++) {
          double rate = w->jacobian[(size_t)r * (size_t)b->n + (size_t)s];
          if (fading != 0) rate -= fading * gg_hermite_test_overlap(&h->op, r, s);
          w->column[r] += rate * h->state.a[s];
        }
    }
    project(b, w->column, projected);
    for (int k = 1; k <= half; k++) gsl_matrix_set(w->J, (size_t)k - 1, (size_t)l - 1, projected[k]);
  }
}

/* Solve J x = x. */
static bool solve(gg_isotropic_work *w)
{
  int sign;
  return gsl_linalg_LU_decomp(w->J, w->order, &sign) == GSL_SUCCESS &&
         gsl_linalg_LU_svx(w->J, w->order, w->x) == GSL_SUCCESS;
}

/* The last step, relative. */
static double newton_step(gg_hermite_isotropic *h, gg_isotropic_work *w, double *alpha, const gg_heating *heating)
{
  const gg_hermite_basis *b = &h->op.basis;
  int half = b->degree / 2;
  double projected[HALVES], most = 0;
  heat(&h->gas, gg_theory_heating_at(heating, 0, h->heating));
  gg_hermite_isotropic_expand(b, alpha, h->state.a);
  if (!gg_hermite_operator_at(&h->op, &h->gas, &h->state, w->R, w->jacobian)) return INFINITY;
  project(b, w->R, projected);
  for (int l = 1; l <= half; l++) gsl_vector_set(w->x, (size_t)l - 1, projected[l]);
  linearise(h, w, heating, 0);
  if (!solve(w)) return INFINITY;
  h->heating -= gsl_vector_get(w->x, 0);
  most = gg_theory_heating_step(heating, h->heating, gsl_vector_get(w->x, 0), h->gas.impact[0][0].frequency);
  for (int l = 2; l <= half; l++) {
    double step = gsl_vector_get(w->x, (size_t)l - 1);
    alpha[l] -= step;
    most = fmax(most, fabs(step));
  }
  return isfinite(most) ? most : INFINITY;
}

static gg_status iterate(gg_hermite_isotropic *h, gg_isotropic_work *w, const gg_heating *heating, gg_error *err)
{
  double alpha[HALVES] = {1, (3 / h->state.width - 3) / sqrt(6)}, left = INFINITY;
  h->heating = heating->guess;
  for (int i = 0; i < MOST_ITERATIONS && left > converged; i++) {
    left = newton_step(h, w, alpha, heating);
    if (left == INFINITY) break;
  }
  if (left > converged) return gg_base_fail(err, GG_FAILED, "no steady state was found");
  heat(&h->gas, gg_theory_heating_at(heating, 0, h->heating));
  gg_hermite_isotropic_expand(&h->op.basis, alpha, h->state.a);
  h->cooling_rate = 2 * (h->gas.diffusion[0] - h->gas.drag[0]); /* dT/dt = 2 D - 2 drag T, at T = 1 */
  return GG_OK;
}

gg_status gg_hermite_isotropic_solve(gg_hermite_isotropic *h, int degree, double frequency, double eta,
                                     const gg_heating *heating, gg_error *err)
{
  gg_isotropic_work w = {0};
  *h = (gg_hermite_isotropic){.gas = gg_hermite_one(frequency, eta, 0), .state.width = GG_HERMITE_WIDTH};
  for (int i = 0; i < 3; i++) h->state.L[i][i] = sqrt(h->state.width);
  gg_status status = gg_hermite_operator_make(&h->op, degree, GG_HERMITE_DECAY, true, err);
  if (status == GG_OK) h->state.a = calloc((size_t)h->op.basis.n, sizeof *h->state.a);
  gg_base_gsl_enter();
  if (status == GG_OK && (!h->state.a || !make(&w, h->op.basis.n, degree / 2))) status = gg_base_out_of_memory(err);
  if (status == GG_OK) status = iterate(h, &w, heating, err);
  gg_base_gsl_leave();
  clear(&w);
  if (status != GG_OK) gg_hermite_isotropic_end(h);
  return status;
}

/* Step of the central difference in a third of div u, at T = m = 1. */
static const double small = 1e-3;

/* f0 plus this fraction of the response, x[1] .. */
static void respond(gg_hermite_isotropic *h, const double *alpha, const gsl_vector *x, double share)
{
  double with[HALVES];
  memcpy(with, alpha, sizeof with);
  for (int l = 2; l <= h->op.basis.degree / 2; l++) with[l] += share * gsl_vector_get(x, (size_t)l - 1);
  gg_hermite_isotropic_expand(&h->op.basis, with, h->state.a);
}

static bool expand(gg_hermite_isotropic *h, gg_isotropic_work *w, double reach, double *zeta_u)
{
  const gg_hermite_basis *b = &h->op.basis;
  const gg_heating heating = {.kind = GG_HEATING_COOLS};
  double alpha[HALVES] = {0}, side[2][HALVES], loss[2];
  gg_hermite_sums sums;
  for (int l = 0; l <= b->degree / 2; l++) alpha[l] = h->state.a[gg_hermite_place(b, 2 * l, 0, 0)] * sqrt(2 * l + 1);
  for (int k = 0; k < 2; k++) {
    h->gas.impact[0][0].apart = (k ? small : -small) * reach;
    gg_hermite_operator_at(&h->op, &h->gas, &h->state, w->R, NULL);
    project(b, w->R, side[k]);
  }
  h->gas.impact[0][0].apart = 0;
  gg_hermite_operator_at(&h->op, &h->gas, &h->state, w->R, w->jacobian);
  for (int l = 1; l <= b->degree / 2; l++) gsl_vector_set(w->x, (size_t)l - 1, (side[0][l] - side[1][l]) / (2 * small));
  linearise(h, w, &heating, h->cooling_rate / 2);
  const bool fine = solve(w);
  for (int k = 0; k < 2 && fine; k++) {
    h->gas.impact[0][0].apart = (k ? small : -small) * reach;
    respond(h, alpha, w->x, k ? small : -small);
    gg_hermite_sums_at(&h->op, &h->gas, &h->state, &sums);
    loss[k] = sums.loss;
  }
  h->gas.impact[0][0].apart = 0;
  respond(h, alpha, w->x, 0);
  if (fine) *zeta_u = 2. / 9 * (loss[1] - loss[0]) / (2 * small); /* zeta = (2/3) loss, div u is three times the rate */
  return fine;
}

gg_status gg_hermite_isotropic_expansion(gg_hermite_isotropic *h, double reach, double *zeta_u, gg_error *err)
{
  gg_isotropic_work w;
  gg_status status = GG_OK;
  gg_base_gsl_enter();
  if (!make(&w, h->op.basis.n, h->op.basis.degree / 2))
    status = gg_base_out_of_memory(err);
  else if (!expand(h, &w, reach, zeta_u))
    status = gg_base_fail(err, GG_FAILED, "no linear response was found");
  gg_base_gsl_leave();
  clear(&w);
  return status;
}

void gg_hermite_isotropic_end(gg_hermite_isotropic *h)
{
  gg_hermite_operator_clear(&h->op);
  free(h->state.a);
  *h = (gg_hermite_isotropic){0};
}
