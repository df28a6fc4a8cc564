/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Products of normalised Hermite polynomials, Ho_r(c) = prod_i He_{r_i}(c_i)/sqrt(r_i!), orthonormal under the weight
 * (2 pi)^(-3/2) exp(-c^2/2); those of even total degree up to N. */
#ifndef GG_HERMITE_BASIS_H
#define GG_HERMITE_BASIS_H

#include <stdbool.h>

#include "base/error.h"

enum { GG_HERMITE_MOST_DEGREE = 20, GG_HERMITE_MOST_FUNCTIONS = 600 };

typedef struct gg_hermite_index {
  int r[3];
} gg_hermite_index;

typedef struct gg_hermite_basis {
  int degree; /* N, even */
  /* Functions that are also even in z, for a flow that is symmetric under reflection of z. The first is the
   * constant. */
  int n;
  gg_hermite_index *function;
  int from[GG_HERMITE_MOST_DEGREE + 2]; /* functions of even degree d are at from[d] .. from[d + 1] */
  /* All functions of even degree in the frame of a collision (normal, tangent, binormal), ordered by the last index:
   * those of last index Q are at rotated_from[Q] .. rotated_from[Q + 1]. */
  int n_rotated;
  gg_hermite_index *rotated;
  int rotated_from[GG_HERMITE_MOST_DEGREE + 2];
  /* Index into `function` and into `rotated`, by the three indices; -1: none. See gg_hermite_cell. */
  int *place, *rotated_place;
} gg_hermite_basis;

gg_status gg_hermite_basis_make(gg_hermite_basis *basis, int degree, gg_error *err);
void gg_hermite_basis_clear(gg_hermite_basis *basis);

/* Index into `place`; r_i from 0 to N. */
static inline int gg_hermite_cell(const gg_hermite_basis *b, int x, int y, int z)
{
  return (x * (b->degree + 1) + y) * (b->degree + 1) + z;
}

/* Index of a function; -1 if there is none (also for indices beyond the degree, or negative). */
int gg_hermite_place(const gg_hermite_basis *basis, int x, int y, int z);

int gg_hermite_rotated_place(const gg_hermite_basis *basis, int J, int P, int Q);

/* He_0 .. He_N at x, normalised. */
void gg_hermite_values(int degree, double x, double *value);

/* The same at n points, by rows of `stride`; beyond He_N rows are not changed. */
void gg_hermite_values_of(int degree, int n, const double *x, double *value, int stride);

/* D, n_rotated rows of `wide` >= n: Ho_s(c) = sum_q D_qs Ho_q(c'), where c'_i = axis_i . c; orthogonal, degree by
 * degree. `work`: scratch of gg_hermite_rotation_scratch doubles. */
void gg_hermite_rotation(const gg_hermite_basis *basis, double axis[3][3], int wide, double *D, double *work);
size_t gg_hermite_rotation_scratch(int degree);

#endif
