/* d<psi_r>/dt = R_r, so that sum_s <psi_r Ho_s> d a_s/dt = sum_s J_rs a_s for small a, about a Gaussian that stands. */
#include "theory/hermite/spectrum.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <stdlib.h>

#include "theory/hermite/room.h"

typedef struct gg_spectrum {
  double *R, *jacobian;
  gsl_matrix *mass;
  gsl_permutation *order;
  gsl_vector_complex *value;
  gsl_eigen_nonsymm_workspace *work;
} gg_spectrum;

static bool make(gg_spectrum *s, int functions)
{
  size_t n = (size_t)functions, m = n - 1;
  *s = (gg_spectrum){.R = malloc((n * n + n) * sizeof *s->R),
                     .mass = gsl_matrix_alloc(m, m),
                     .order = gsl_permutation_alloc(m),
                     .value = gsl_vector_complex_alloc(m),
                     .work = gsl_eigen_nonsymm_alloc(m)};
  s->jacobian = s->R ? s->R + n : NULL;
  return s->R && s->mass && s->order && s->value && s->work;
}

static void clear(gg_spectrum *s)
{
  free(s->R);
  if (s->mass) gsl_matrix_free(s->mass);
  gsl_permutation_free(s->order);
  if (s->value) gsl_vector_complex_free(s->value);
  gsl_eigen_nonsymm_free(s->work);
}

/* jacobian = mass^-1 jacobian, all but the constant. */
static bool divide(gg_spectrum *s, const gg_hermite_operator *op, gsl_matrix *J)
{
  int sign;
  for (size_t i = 0; i < J->size1; i++)
    for (size_t j = 0; j < J->size2; j++)
      gsl_matrix_set(s->mass, i, j, gg_hermite_test_overlap(op, (int)i + 1, (int)j + 1));
  if (gsl_linalg_LU_decomp(s->mass, s->order, &sign) != GSL_SUCCESS) return false;
  for (size_t j = 0; j < J->size2; j++) {
    gsl_vector_view column = gsl_matrix_column(J, j);
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
  size_t n = (size_t)op->basis.n, m = n - 1;
  gg_hermite_operator_at(op, gas, state, s->R, s->jacobian);
  gsl_matrix_view J = gsl_matrix_view_array_with_tda(s->jacobian + n + 1, m, m, n);
  if (!divide(s, op, &J.matrix) || gsl_eigen_nonsymm(&J.matrix, s->value, s->work) != GSL_SUCCESS) return false;
  for (size_t i = 0; i < m; i++) {
    gsl_complex z = gsl_vector_complex_get(s->value, i);
    mode[i] = (gg_hermite_mode){-GSL_REAL(z), GSL_IMAG(z)};
  }
  qsort(mode, m, sizeof *mode, slower);
  return true;
}

gg_status gg_hermite_spectrum(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                              gg_hermite_mode *mode, gg_error *err)
{
  gg_spectrum s;
  gg_status status = make(&s, op->basis.n) ? GG_OK : gg_fail(err, GG_FAILED, "out of memory");
  gsl_error_handler_t *handler = gsl_set_error_handler_off();
  if (status == GG_OK && !find(&s, op, gas, state, mode)) status = gg_fail(err, GG_FAILED, "no eigenvalues were found");
  gsl_set_error_handler(handler);
  clear(&s);
  return status;
}
