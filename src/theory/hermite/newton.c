/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/newton.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* A Jacobian costs as much as ten residuals: it is kept as long as its steps shrink fast. */
enum { MOST_ITERATIONS = 60, MOST_HALVINGS = 10 };
static const double converged = 1e-10, fast = 0.25;

/* Coefficients of all species one after another, with the constants, which stay. */
typedef struct gg_newton {
  int n_species, functions, n;
  double *jacobian, *R, *trial, *P; /* P: derivatives of R with respect to a pin's factor */
  double part;                      /* fraction of the last step that was taken */
  bool factorised;
  gsl_permutation *order;
} gg_newton;

static gg_status make(gg_newton *w, int n_species, int functions, gg_error *err)
{
  *w = (gg_newton){.n_species = n_species, .functions = functions, .n = n_species * functions};
  size_t m = (size_t)w->n;
  w->jacobian = malloc((m * m + 3 * m) * sizeof *w->jacobian);
  w->order = gsl_permutation_alloc(m);
  if (!w->jacobian || !w->order) return gg_base_out_of_memory(err);
  w->R = w->jacobian + m * m, w->trial = w->R + m, w->P = w->trial + m;
  return GG_OK;
}

static void clear(gg_newton *w)
{
  free(w->jacobian);
  gsl_permutation_free(w->order);
}

static gsl_matrix_view matrix_of(gg_newton *w)
{
  return gsl_matrix_view_array(w->jacobian, (size_t)w->n, (size_t)w->n);
}

/* Replace R by the step J^-1 R. */
static bool solve(gg_newton *w, double *R)
{
  gsl_matrix_view J = matrix_of(w);
  gsl_vector_view b = gsl_vector_view_array(R, (size_t)w->n);
  for (int i = 0; i < w->n; i += w->functions) R[i] = 0;
  bool fine = gsl_linalg_LU_svx(&J.matrix, w->order, &b.vector) == GSL_SUCCESS;
  for (int i = 0; i < w->n; i++) fine = fine && isfinite(R[i]);
  return fine;
}

static bool factorise(gg_newton *w)
{
  int sign;
  gsl_matrix_view J = matrix_of(w);
  for (int i = 0; i < w->n; i += w->functions)
    for (int j = 0; j < w->n; j++) w->jacobian[i * w->n + j] = i == j;
  return gsl_linalg_LU_decomp(&J.matrix, w->order, &sign) == GSL_SUCCESS;
}

/* True if A - fraction B is positive definite. */
static bool above(double A[3][3], double fraction, double B[3][3])
{
  double rest[3][3], ignored[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) rest[i][j] = A[i][j] - fraction * B[i][j];
  return gg_hermite_cholesky(rest, ignored);
}

/* Move one species; false if its second moments shrink to less than a fifth. */
static bool move(const gg_hermite_basis *b, gg_hermite_state *s, const double *from, const double *step, double part,
                 double L[3][3])
{
  double M[3][3], before[3][3];
  memcpy(s->a, from, (size_t)b->n * sizeof *s->a);
  gg_hermite_second_moments(b, s, before);
  for (int r = 1; r < b->n; r++) s->a[r] = from[r] - part * step[r];
  gg_hermite_second_moments(b, s, M);
  return above(M, 0.2, before) && gg_hermite_gaussian(s->width, M, L);
}

/* One step, halved until it is not too long. */
static bool step(const gg_hermite_basis *b, gg_hermite_state *s, gg_newton *w, double L[][3][3])
{
  double part = 1;
  for (int i = 0; i < w->n_species; i++) memcpy(w->trial + i * b->n, s[i].a, (size_t)b->n * sizeof *s->a);
  for (int half = 0; half < MOST_HALVINGS; half++, part /= 2) {
    int fine = 0;
    for (int i = 0; i < w->n_species; i++) fine += move(b, &s[i], w->trial + i * b->n, w->R + i * b->n, part, L[i]);
    w->part = part;
    if (fine == w->n_species) return true;
  }
  return false;
}

static double length(const gg_newton *w)
{
  double most = 0, norm = 1;
  for (int r = 0; r < w->n; r++) most = fmax(most, fabs(w->R[r])), norm = fmax(norm, fabs(w->trial[r]));
  return most / norm;
}

gg_hermite_pin gg_hermite_pin_of(const gg_hermite_gas *gas)
{
  gg_hermite_pin pin = {.factor = 1, .bath = {.n_species = gas->n_species}};
  memcpy(pin.bath.drag, gas->drag, sizeof gas->drag);
  memcpy(pin.bath.diffusion, gas->diffusion, sizeof gas->diffusion);
  return pin;
}

double gg_hermite_temperature(const gg_hermite_basis *b, const gg_hermite_gas *gas, const gg_hermite_state *s)
{
  double T = 0, M[3][3];
  for (int i = 0; i < gas->n_species; i++) {
    gg_hermite_second_moments(b, &s[i], M);
    T += gas->fraction[i] * gas->mass[i] * (M[0][0] + M[1][1] + M[2][2]) / 3;
  }
  return T;
}

/* Decrease of T by a step: T is linear in the coefficients. */
static double cooled_by(const gg_hermite_basis *b, const gg_hermite_gas *gas, gg_hermite_state *s, const double *step)
{
  const double before = gg_hermite_temperature(b, gas, s);
  for (int i = 0; i < gas->n_species; i++)
    for (int r = 1; r < b->n; r++) s[i].a[r] -= step[i * b->n + r];
  const double after = gg_hermite_temperature(b, gas, s);
  for (int i = 0; i < gas->n_species; i++)
    for (int r = 1; r < b->n; r++) s[i].a[r] += step[i * b->n + r];
  return before - after;
}

/* R + change P = J step, where the step leads to the pin's temperature; the step replaces R. */
static bool pinned(const gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *s, gg_newton *w,
                   const gg_hermite_pin *pin, double *change)
{
  memset(w->P, 0, (size_t)w->n * sizeof *w->P);
  for (int i = 0; i < gas->n_species; i++)
    gg_hermite_add_streaming(op, &pin->bath, i, &s[i], w->P + i * w->functions, NULL, 0);
  if (!solve(w, w->P)) return false;
  const double too_hot = gg_hermite_temperature(&op->basis, gas, s) - pin->T;
  *change = (too_hot - cooled_by(&op->basis, gas, s, w->R)) / cooled_by(&op->basis, gas, s, w->P);
  for (int r = 0; r < w->n; r++) w->R[r] += *change * w->P[r];
  return isfinite(*change);
}

static void set_bath(const gg_hermite_pin *pin, gg_hermite_gas *gas)
{
  for (int i = 0; i < gas->n_species; i++)
    gas->drag[i] = pin->factor * pin->bath.drag[i], gas->diffusion[i] = pin->factor * pin->bath.diffusion[i];
}

static gg_status iterate(gg_hermite_operator *op, const gg_hermite_gas *given, gg_hermite_state *s, gg_newton *w,
                         gg_hermite_pin *pin, gg_error *err)
{
  double L[GG_MAX_SPECIES][3][3], last = INFINITY, change = 0;
  gg_hermite_gas at_pin = *given, *gas = &at_pin;
  bool anew = !w->factorised;
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    if (pin) set_bath(pin, gas);
    if (!gg_hermite_operator_at(op, gas, s, w->R, anew ? w->jacobian : NULL)) break;
    w->factorised = !anew || factorise(w);
    if (!w->factorised || !solve(w, w->R)) break;
    if ((pin && !pinned(op, gas, s, w, pin, &change)) || !step(&op->basis, s, w, L)) break;
    if (pin) pin->factor += w->part * change;
    for (int k = 0; k < gas->n_species; k++) GG_TRY(gg_hermite_expand_anew(&op->basis, &s[k], L[k], err));
    double now = length(w) + fabs(change);
    if (now < converged) return GG_OK;
    anew = !(now < fast * last);
    last = anew ? INFINITY : now;
  }
  w->factorised = false;
  return gg_base_fail(err, GG_FAILED, "no steady state was found");
}

gg_status gg_hermite_newton(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *s,
                            gg_hermite_pin *pin, gg_error *err)
{
  gg_newton own = {0}, *w = &own;
  gg_status status = GG_OK;
  gg_base_gsl_enter();
  if (pin && !pin->kept) pin->kept = gg_base_array_new(1, sizeof *pin->kept, err);
  if (pin) w = pin->kept;
  if (!w)
    status = GG_FAILED;
  else if (!w->jacobian)
    status = make(w, gas->n_species, op->basis.n, err);
  if (status == GG_OK) status = iterate(op, gas, s, w, pin, err);
  clear(&own);
  gg_base_gsl_leave();
  return status;
}

void gg_hermite_pin_end(gg_hermite_pin *pin)
{
  if (pin->kept) clear(pin->kept);
  free(pin->kept);
  pin->kept = NULL;
}
