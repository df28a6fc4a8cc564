#include "theory/hermite/newton.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A Jacobian costs as much as ten residuals: it is kept as long as steps with it shrink fast. */
enum { MOST_ITERATIONS = 60, MOST_HALVINGS = 10 };
static const double converged = 1e-10, fast = 0.25;

typedef struct gg_newton {
  int n;
  double *jacobian, *R, *trial;
  gsl_permutation *order;
} gg_newton;

static gg_status make(gg_newton *w, int n, gg_error *err)
{
  size_t m = (size_t)n;
  *w = (gg_newton){.n = n, .jacobian = malloc((m * m + 2 * m) * sizeof *w->jacobian)};
  w->order = gsl_permutation_alloc(m - 1);
  if (!w->jacobian || !w->order) return gg_fail(err, GG_FAILED, "out of memory");
  w->R = w->jacobian + m * m, w->trial = w->R + m;
  return GG_OK;
}

static void clear(gg_newton *w)
{
  free(w->jacobian);
  gsl_permutation_free(w->order);
}

static gsl_matrix_view matrix_of(gg_newton *w)
{
  size_t m = (size_t)w->n - 1; /* all but the constant */
  return gsl_matrix_view_array_with_tda(w->jacobian + w->n + 1, m, m, (size_t)w->n);
}

/* R becomes the step J^-1 R. */
static bool solve(gg_newton *w)
{
  gsl_matrix_view J = matrix_of(w);
  gsl_vector_view b = gsl_vector_view_array(w->R + 1, (size_t)w->n - 1);
  bool fine = gsl_linalg_LU_svx(&J.matrix, w->order, &b.vector) == GSL_SUCCESS;
  for (int i = 1; i < w->n; i++) fine = fine && isfinite(w->R[i]);
  return fine;
}

static bool factorise(gg_newton *w)
{
  int sign;
  gsl_matrix_view J = matrix_of(w);
  return gsl_linalg_LU_decomp(&J.matrix, w->order, &sign) == GSL_SUCCESS;
}

/* Is A - fraction B positive definite? */
static bool above(double A[3][3], double fraction, double B[3][3])
{
  double rest[3][3], ignored[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) rest[i][j] = A[i][j] - fraction * B[i][j];
  return gg_hermite_cholesky(rest, ignored);
}

/* One step; halved until the second moments shrink to no less than a fifth. */
static bool step(const gg_hermite_basis *b, gg_hermite_state *s, gg_newton *w, double L[3][3])
{
  double M[3][3], before[3][3], part = 1;
  gg_hermite_second_moments(b, s, before);
  memcpy(w->trial, s->a, (size_t)w->n * sizeof *s->a);
  for (int half = 0; half < MOST_HALVINGS; half++, part /= 2) {
    for (int r = 1; r < w->n; r++) s->a[r] = w->trial[r] - part * w->R[r];
    gg_hermite_second_moments(b, s, M);
    if (above(M, 0.2, before) && gg_hermite_gaussian(s->width, M, L)) return true;
  }
  return false;
}

static double length(const gg_newton *w)
{
  double most = 0, norm = 1;
  for (int r = 1; r < w->n; r++) most = fmax(most, fabs(w->R[r])), norm = fmax(norm, fabs(w->trial[r]));
  return most / norm;
}

static gg_status iterate(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *s, gg_newton *w,
                         gg_error *err)
{
  double L[3][3], last = INFINITY;
  bool anew = true;
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    gg_hermite_operator_at(op, gas, s->L, s->a, w->R, anew ? w->jacobian : NULL);
    if ((anew && !factorise(w)) || !solve(w) || !step(&op->basis, s, w, L)) break;
    GG_TRY(gg_hermite_expand_anew(&op->basis, s, L, err));
    double now = length(w);
    if (now < converged) return GG_OK;
    anew = !(now < fast * last);
    last = anew ? INFINITY : now;
  }
  return gg_fail(err, GG_FAILED, "no steady state was found");
}

gg_status gg_hermite_newton(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *s, gg_error *err)
{
  gg_newton w;
  gsl_error_handler_t *handler = gsl_set_error_handler_off();
  gg_status status = make(&w, op->basis.n, err);
  if (status == GG_OK) status = iterate(op, gas, s, &w, err);
  clear(&w);
  gsl_set_error_handler(handler);
  return status;
}
