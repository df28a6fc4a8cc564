/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear equations whose matrix has elements near its diagonal only. */
#ifndef GG_BAND_MATRIX_H
#define GG_BAND_MATRIX_H

#include <stdbool.h>

/* n x n, with `below` diagonals under and `above` over the main one. */
typedef struct gg_band_matrix {
  int n, below, above;
  int *pivot;
  double *cell;
} gg_band_matrix;

/* Bytes of cells and pivots; a row has room for the elements that exchanges of rows bring in. */
static inline int gg_band_width(int below, int above)
{
  return 2 * below + above + 1;
}
static inline double *gg_band_at(const gg_band_matrix *A, int row, int column)
{
  return A->cell + (long)row * gg_band_width(A->below, A->above) + (column - row + A->below);
}

/* Gauss elimination with exchanges of rows, in place. False: singular, or not finite. */
bool gg_theory_band_factor(gg_band_matrix *A);
/* Replace b by the solution of A x = b, after gg_theory_band_factor. */
void gg_theory_band_solve(const gg_band_matrix *A, double *b);

#endif
