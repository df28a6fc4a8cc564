/* SPDX-License-Identifier: GPL-3.0-or-later */
/* d<psi_r>/dt = R_r, so that sum_s <psi_r Ho_s> d a_s/dt = sum_s J_rs a_s for small a, about a fixed Gaussian. */
#include "theory/hermite/spectrum.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <stdlib.h>

#include "base/memory.h"

typedef struct gg_spectrum {
  double *R, *jacobian;
  gsl_matrix *J, *mass; /* without the constants */
  gsl_permutation *order;
  gsl_vector_complex *value;
  gsl_eigen_nonsymm_workspace *work;
} gg_spectrum;

static bool make(gg_spectrum *s, int unknowns, int all)
{
  size_t n = (size_t)all, m = (size_t)unknowns;
  *s = (gg_spectrum){.R = malloc((n * n + n) * sizeof *s->R),
                     .J = gsl_matrix_alloc(m, m),
                     .mass = gsl_matrix_alloc(m, m),
                     .order = gsl_permutation_alloc(m),
                     .value = gsl_vector_complex_alloc(m),
                     .work = gsl_eigen_nonsymm_alloc(m)};
  s->jacobian = s->R ? s->R + n : NULL;
  return s->R && s->J && s->mass && s->order && s->value && s->work;
}

static void clear(gg_spectrum *s)
{
  free(s->R);
  if (s->J) gsl_matrix_free(s->J);
  if (s->mass) gsl_matrix_free(s->mass);
  gsl_permutation_free(s->order);
  if (s->value) gsl_vector_complex_free(s->value);
  gsl_eigen_nonsymm_free(s->work);
}

static void fill(gg_spectrum *s, const gg_hermite_operator *op, size_t all)
{
  size_t n = (size_t)op->basis.n, m = n - 1;
  for (size_t i = 0; i < s->J->size1; i++)
    for (size_t j = 0; j < s->J->size1; j++) {
      size_t r = i / m * n + i % m + 1, q = j / m * n + j % m + 1;
      gsl_matrix_set(s->J, i, j, s->jacobian[r * all + q]);
      gsl_matrix_set(s->mass, i, j,
                     i / m == j / m ? gg_hermite_test_overlap(op, (int)(i % m) + 1, (int)(j % m) + 1) : 0);
    }
}

/* J = mass^-1 J */
static bool divide(gg_spectrum *s)
{
  int sign;
  if (gsl_linalg_LU_decomp(s->mass, s->order, &sign) != GSL_SUCCESS) return false;
  for (size_t j = 0; j < s->J->size2; j++) {
    gsl_vector_view column = gsl_matrix_column(s->J, j);
    if (gsl_linalg_LU_svx(s->mass, s->order, &column.vector) != GSL_SUCCESS) return false;
  }
  return true;
}

static int slower(const void *one, const void *two)
{
  double a = ((const gg_hermite_mode *)one)->decay, b = ((const gg_hermite_mode *)two)->decay;
  return (a > b) - (a < b);
}

static bool find(gg_spectrum *s, gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                 gg_hermite_mode *mode)
{
  if (!gg_hermite_operator_at(op, gas, state, s->R, s->jacobian)) return false;
  fill(s, op, (size_t)(gas->n_species * op->basis.n));
  if (!divide(s) || gsl_eigen_nonsymm(s->J, s->value, s->work) != GSL_SUCCESS) return false;
  for (size_t i = 0; i < s->J->size1; i++) {
    gsl_complex z = gsl_vector_complex_get(s->value, i);
    mode[i] = (gg_hermite_mode){-GSL_REAL(z), GSL_IMAG(z)};
  }
  qsort(mode, s->J->size1, sizeof *mode, slower);
  return true;
}

gg_status gg_hermite_spectrum(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                              gg_hermite_mode *mode, gg_error *err)
{
  gg_spectrum s;
  int all = gas->n_species * op->basis.n;
  gg_status status = make(&s, all - gas->n_species, all) ? GG_OK : gg_base_out_of_memory(err);
  gg_base_gsl_enter();
  if (status == GG_OK && !find(&s, op, gas, state, mode))
    status = gg_base_fail(err, GG_FAILED, "no eigenvalues were found");
  gg_base_gsl_leave();
  clear(&s);
  return status;
}
