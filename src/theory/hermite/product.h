/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Products of small matrices: C += A^T B. */
#ifndef GG_HERMITE_PRODUCT_H
#define GG_HERMITE_PRODUCT_H

/* Rows of A and columns of B are padded with zeros to multiples of these. */
enum { GG_PRODUCT_ROWS = 4, GG_PRODUCT_COLUMNS = 16 };

static inline int gg_padded(int n, int unit)
{
  return (n + unit - 1) / unit * unit;
}

/* A: depth x rows, B: depth x columns, C: rows x columns, each by rows of the given strides. */
void gg_hermite_product_add(int rows, int columns, int depth, const double *A, int stride_A, const double *B,
                            int stride_B, double *C, int stride_C);

#endif
