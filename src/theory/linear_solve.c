/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/linear_solve.h"

#include <gsl/gsl_linalg.h>
#include <stdlib.h>

double *gg_theory_linear_new(size_t n)
{
  return malloc((n + 1) * n * sizeof(double));
}

bool gg_theory_linear_solve(size_t n, double *M)
{
  gsl_matrix_view matrix = gsl_matrix_view_array(M, n, n);
  gsl_vector_view x = gsl_vector_view_array(M + n * n, n);
  gsl_permutation *order = gsl_permutation_alloc(n);
  int sign;
  const bool solved = order && gsl_linalg_LU_decomp(&matrix.matrix, order, &sign) == GSL_SUCCESS &&
                      gsl_linalg_LU_svx(&matrix.matrix, order, &x.vector) == GSL_SUCCESS;
  gsl_permutation_free(order);
  return solved;
}
