/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/steady.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/hermite_state.h"

enum { MOST_ITERATIONS = 40 };
static const double converged = 1e-11;

void gg_rough_steady_clear(gg_rough_steady *s)
{
  gg_rough_relative_clear(&s->relative);
  gg_rough_form_clear(&s->form);
  free(s->a);
  s->a = NULL;
}

static gg_status make(gg_rough_steady *s, int degree, bool isotropic, gg_error *err)
{
  gg_rough_steady_clear(s);
  s->degree = degree;
  int relative = degree + s->choice.extra;
  if (isotropic)
    GG_TRY(gg_rough_relative_isotropic(&s->relative, &s->gas, &s->weight, relative, err));
  else
    GG_TRY(gg_rough_relative_make(&s->relative, &s->gas, &s->weight, relative, false, err));
  GG_TRY(gg_rough_form_make(&s->form, &s->relative, degree, isotropic, &s->choice, err));
  s->a = calloc((size_t)s->form.n, sizeof *s->a);
  if (!s->a) return gg_base_out_of_memory(err);
  s->a[0] = 1;
  for (int x = 0; x < GG_ROUGH_AXES; x++) {
    double width = x < 3 ? s->choice.width : s->choice.spin_width;
    int place = s->relative.f.up[s->relative.f.up[0][x]][x];
    s->a[s->form.unknown[place]] = (1 / width - 1) / M_SQRT2;
  }
  return GG_OK;
}

static bool widen(double width, double M[3][3], double L[3][3])
{
  for (int i = 0; i < 9; i++) M[i / 3][i % 3] *= width;
  return gg_hermite_cholesky(M, L);
}

bool gg_rough_follow(gg_rough_steady *s)
{
  double C[3][3], S[3][3];
  gg_rough_covariance(&s->form, &s->relative.f, &s->weight, s->a, false, C);
  gg_rough_covariance(&s->form, &s->relative.f, &s->weight, s->a, true, S);
  double spin = gg_rough_mean_spin(&s->form, &s->relative.f, &s->weight, s->a);
  s->weight.spin = spin;
  return widen(s->choice.width, C, s->weight.L) && widen(s->choice.spin_width, S, s->weight.S);
}

/* Unknowns are combinations x_i of the coefficients: a = sum_i x_i direction_i, equations the same combinations of
 * R. The first unknown may be another parameter; `extra` is then the derivative of R with respect to it. */
typedef struct gg_rough_newton {
  int m, n;
  double *direction; /* m rows of n; NULL: the coefficients themselves, from 1 on */
  double *R, *J, *extra;
  gsl_matrix *A;
  gsl_vector *x;
  gsl_permutation *order;
} gg_rough_newton;

static gg_status begin(gg_rough_newton *w, int n, int m, gg_error *err)
{
  size_t rows = (size_t)n, unknowns = (size_t)m;
  *w = (gg_rough_newton){.m = m, .n = n};
  w->R = calloc(rows * rows + 2 * rows, sizeof *w->R);
  w->A = gsl_matrix_alloc(unknowns, unknowns);
  w->x = gsl_vector_alloc(unknowns);
  w->order = gsl_permutation_alloc(unknowns);
  if (!w->R || !w->A || !w->x || !w->order) return gg_base_out_of_memory(err);
  w->extra = w->R + n, w->J = w->extra + n;
  return GG_OK;
}

static void end(gg_rough_newton *w)
{
  free(w->R);
  free(w->direction);
  if (w->A) gsl_matrix_free(w->A);
  if (w->x) gsl_vector_free(w->x);
  gsl_permutation_free(w->order);
}

static void residual(const gg_rough_steady *s, gg_rough_newton *w)
{
  memset(w->R, 0, (size_t)w->n * sizeof *w->R);
  memset(w->J, 0, (size_t)w->n * (size_t)w->n * sizeof *w->J);
  gg_rough_stream_add(&s->form, &s->relative.f, &s->weight, &s->stream, s->a, w->R, w->J);
  gg_rough_form_add(&s->form, s->gas.frequency, s->a, w->R, w->J);
}

static bool solve(gg_rough_newton *w)
{
  int sign;
  if (gsl_linalg_LU_decomp(w->A, w->order, &sign) != GSL_SUCCESS) return false;
  if (gsl_linalg_LU_svx(w->A, w->order, w->x) != GSL_SUCCESS) return false;
  for (int i = 0; i < w->m; i++)
    if (!isfinite(gsl_vector_get(w->x, (size_t)i))) return false;
  return true;
}

static gg_status iterate_shear(gg_rough_steady *s, gg_rough_newton *w, gg_error *err)
{
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    double most = 0;
    residual(s, w);
    for (int r = 0; r < w->m; r++) {
      gsl_vector_set(w->x, (size_t)r, w->R[r + 1]);
      for (int q = 0; q < w->m; q++) gsl_matrix_set(w->A, (size_t)r, (size_t)q, w->J[(r + 1) * w->n + q + 1]);
    }
    if (!solve(w)) break;
    for (int q = 0; q < w->m; q++) {
      double step = gsl_vector_get(w->x, (size_t)q);
      s->a[q + 1] -= step;
      most = fmax(most, fabs(step));
    }
    if (most < converged) return GG_OK;
    if (most > 1e3) break;
  }
  return gg_base_fail(err, GG_FAILED, "no steady state was found");
}

gg_status gg_rough_shear_solve(gg_rough_steady *s, int degree, gg_error *err)
{
  gg_rough_newton w = {0};
  gg_base_gsl_enter();
  gg_status status = make(s, degree, false, err);
  if (status == GG_OK) status = begin(&w, s->form.n, s->form.n - 1, err);
  if (status == GG_OK) status = iterate_shear(s, &w, err);
  end(&w);
  gg_base_gsl_leave();
  return status;
}

/* Coefficients of the same functions in another form, which may have more. */
static void take_coefficients(gg_rough_steady *s, const gg_rough_steady *from)
{
  for (int q = 0; q < s->form.n; q++) s->a[q] = 0;
  for (int q = 0; q < from->form.n; q++) {
    const int place = gg_rough_place(&s->relative.f, from->relative.f.function[from->form.function[q]].r);
    s->a[s->form.unknown[place]] = from->a[q];
  }
}

/* One step of Newton's method from the isotropic state: the rest is of second order in the shear rate. */
static gg_status respond(gg_rough_steady *s, gg_rough_newton *w, double growth, gg_error *err)
{
  residual(s, w);
  for (int r = 0; r < w->m; r++) {
    gsl_vector_set(w->x, (size_t)r, w->R[r + 1]);
    for (int q = 0; q < w->m; q++)
      gsl_matrix_set(w->A, (size_t)r, (size_t)q, w->J[(r + 1) * w->n + q + 1] - (r == q ? growth : 0));
  }
  if (!solve(w)) return gg_base_fail(err, GG_FAILED, "no linear response was found");
  for (int q = 0; q < w->m; q++) s->a[q + 1] -= gsl_vector_get(w->x, (size_t)q);
  return GG_OK;
}

gg_status gg_rough_slow_shear_solve(gg_rough_steady *s, const gg_rough_steady *isotropic, double growth, gg_error *err)
{
  gg_rough_newton w = {0};
  gg_base_gsl_enter();
  s->weight = isotropic->weight;
  gg_status status = make(s, isotropic->degree, false, err);
  if (status == GG_OK) status = begin(&w, s->form.n, s->form.n - 1, err);
  if (status == GG_OK) {
    take_coefficients(s, isotropic);
    status = respond(s, &w, growth, err);
  }
  end(&w);
  gg_base_gsl_leave();
  return status;
}

/* sum_i x^+_(one + i) x^+_(two + i): a scalar product of creation operators. */
static void raise(const gg_rough_functions *f, int one, int two, const double *from, double *to)
{
  memset(to, 0, (size_t)f->n * sizeof *to);
  for (int q = 0; q < f->n; q++)
    for (int i = 0; i < 3 && from[q] != 0; i++) {
      int once = f->up[q][one + i], twice = once < 0 ? -1 : f->up[once][two + i];
      if (twice >= 0) to[twice] += from[q] * sqrt(f->function[once].r[one + i] * f->function[twice].r[two + i]);
    }
}

/* The isotropic functions: (C.C)^i (S.S)^j (C.S)^2k and lower ones, of degree 2 (i + j + 2 k); normalised. The first
 * is C.C. */
static int isotropic_functions(const gg_rough_steady *s, double *direction)
{
  const gg_rough_functions *f = &s->relative.f;
  int m = 0;
  double *x = calloc(2 * (size_t)f->n, sizeof *x), *y = x ? x + f->n : NULL;
  if (!x) return 0;
  for (int total = 1; total <= s->degree / 2; total++)
    for (int k = 0; 2 * k <= total; k++)
      for (int j = 0; j + 2 * k <= total; j++, m++) {
        if (!direction) continue;
        memset(x, 0, (size_t)f->n * sizeof *x);
        x[0] = 1;
        for (int step = 0; step < total; step++) {
          int one = step < j ? 3 : 0, two = step < j ? 3 : 0;
          if (step >= j && step < j + 2 * k) one = 0, two = 3;
          raise(f, one, two, x, y);
          memcpy(x, y, (size_t)f->n * sizeof *x);
        }
        double norm = 0;
        for (int q = 0; q < f->n; q++) norm += x[q] * x[q];
        for (int r = 0; r < s->form.n; r++)
          direction[(size_t)m * (size_t)s->form.n + (size_t)r] = x[s->form.function[r]] / sqrt(norm);
      }
  free(x);
  return m;
}

static gg_rough_stream heat(gg_heating_rates at)
{
  gg_rough_stream s = {.spin = at.spin_drag, .diffusion = at.diffusion, .spin_diffusion = at.spin_diffusion};
  for (int i = 0; i < 3; i++) s.velocity[i][i] = at.drag;
  return s;
}

static double product(const gg_rough_newton *w, int i, const double *R)
{
  double sum = 0;
  for (int r = 0; r < w->n; r++) sum += w->direction[(size_t)i * (size_t)w->n + (size_t)r] * R[r];
  return sum;
}

/* The derivative of R along direction j; for the first, which the width fixes, with respect to x of heating.h. */
static void derivative(gg_rough_steady *s, gg_rough_newton *w, int j, gg_heating_rates slopes)
{
  memset(w->extra, 0, (size_t)w->n * sizeof *w->extra);
  if (j == 0) {
    gg_rough_stream unit = heat(slopes);
    gg_rough_stream_add(&s->form, &s->relative.f, &s->weight, &unit, s->a, w->extra, NULL);
    return;
  }
  const double *direction = w->direction + (size_t)j * (size_t)w->n;
  for (int r = 0; r < w->n; r++)
    for (int q = 0; q < w->n; q++) w->extra[r] += w->J[r * w->n + q] * direction[q];
}

static gg_status iterate_isotropic(gg_rough_steady *s, gg_rough_newton *w, const gg_heating *heating, double *x,
                                   gg_error *err)
{
  *x = heating->guess;
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    s->stream = heat(gg_theory_heating_at(heating, 0, *x));
    residual(s, w);
    for (int k = 0; k < w->m; k++) gsl_vector_set(w->x, (size_t)k, product(w, k, w->R));
    for (int j = 0; j < w->m; j++) {
      derivative(s, w, j, gg_theory_heating_slopes(heating, 0, *x));
      for (int k = 0; k < w->m; k++) gsl_matrix_set(w->A, (size_t)k, (size_t)j, product(w, k, w->extra));
    }
    if (!solve(w)) break;
    *x -= gsl_vector_get(w->x, 0);
    double most = gg_theory_heating_step(heating, *x, gsl_vector_get(w->x, 0), s->gas.frequency);
    for (int j = 1; j < w->m; j++) {
      double step = gsl_vector_get(w->x, (size_t)j);
      for (int q = 0; q < w->n; q++) s->a[q] -= step * w->direction[j * w->n + q];
      most = fmax(most, fabs(step));
    }
    s->stream = heat(gg_theory_heating_at(heating, 0, *x));
    if (most < converged) return GG_OK;
    if (most > 1e3) break;
  }
  return gg_base_fail(err, GG_FAILED, "no steady state was found");
}

gg_status gg_rough_isotropic_solve(gg_rough_steady *s, int degree, const gg_heating *heating, double *x, gg_error *err)
{
  gg_rough_newton w = {0};
  memset(s->weight.L, 0, sizeof s->weight.L);
  for (int i = 0; i < 3; i++) s->weight.L[i][i] = sqrt(s->choice.width);
  gg_base_gsl_enter();
  gg_status status = make(s, degree, true, err);
  int m = status == GG_OK ? isotropic_functions(s, NULL) : 0;
  if (status == GG_OK) status = begin(&w, s->form.n, m, err);
  if (status == GG_OK) {
    w.direction = calloc((size_t)m * (size_t)w.n, sizeof *w.direction);
    if (!w.direction || isotropic_functions(s, w.direction) != m) status = gg_base_out_of_memory(err);
  }
  if (status == GG_OK) status = iterate_isotropic(s, &w, heating, x, err);
  end(&w);
  gg_base_gsl_leave();
  return status;
}
