/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/product.h"

#include <string.h>

#include "common/vec.h"
#include "simd/clones.h"

enum {
  LANES = 8,
  VECTORS = GG_PRODUCT_COLUMNS / LANES,
  FEW_COLUMNS = 8,
  NARROW = 4,
  FEW_VECTORS = FEW_COLUMNS / NARROW
};

/* Vectors of 256 bits, and half of the columns at a time, so that all sums stay in the 16 registers. gcc 12 keeps
 * vectors that are wider than registers in memory, and takes them apart there. */
typedef double narrow __attribute__((vector_size(NARROW * sizeof(double)), aligned(8), may_alias));

GG_INLINE void add_narrow_tile(int depth, const double *A, int stride_A, const double *B, int stride_B, double *C,
                               int stride_C)
{
  narrow sum[GG_PRODUCT_ROWS][FEW_VECTORS] = {{{0}}};
  for (int d = 0; d < depth; d++, A += stride_A, B += stride_B)
    for (int i = 0; i < GG_PRODUCT_ROWS; i++)
      for (int k = 0; k < FEW_VECTORS; k++) sum[i][k] += A[i] * *(const narrow *)(B + k * NARROW);
  for (int i = 0; i < GG_PRODUCT_ROWS; i++)
    for (int k = 0; k < FEW_VECTORS; k++) *(narrow *)(C + i * stride_C + k * NARROW) += sum[i][k];
}

GG_NARROW_CLONES static void add_narrow_tiles(int rows, int columns, int depth, const double *A, int stride_A,
                                              const double *B, int stride_B, double *C, int stride_C)
{
  for (int row = 0; row < rows; row += GG_PRODUCT_ROWS)
    for (int column = 0; column < columns; column += FEW_COLUMNS)
      add_narrow_tile(depth, A + row, stride_A, B + column, stride_B, C + (long)row * stride_C + column, stride_C);
}

#ifdef GG_WIDE_TARGET
typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));

GG_INLINE void add_tile(int depth, const double *restrict A, int stride_A, const double *restrict B, int stride_B,
                        double *restrict C, int stride_C)
{
  lanes sum[GG_PRODUCT_ROWS][VECTORS] = {{{0}}}, b;
  for (int d = 0; d < depth; d++, A += stride_A, B += stride_B)
    for (int k = 0; k < VECTORS; k++) {
      memcpy(&b, B + k * LANES, sizeof b);
      for (int i = 0; i < GG_PRODUCT_ROWS; i++) sum[i][k] += A[i] * b;
    }
  for (int i = 0; i < GG_PRODUCT_ROWS; i++)
    for (int k = 0; k < VECTORS; k++) {
      memcpy(&b, C + i * stride_C + k * LANES, sizeof b);
      b += sum[i][k];
      memcpy(C + i * stride_C + k * LANES, &b, sizeof b);
    }
}

GG_WIDE_TARGET static void add_tiles(int rows, int columns, int depth, const double *A, int stride_A, const double *B,
                                     int stride_B, double *C, int stride_C)
{
  for (int row = 0; row < rows; row += GG_PRODUCT_ROWS)
    for (int column = 0; column < columns; column += GG_PRODUCT_COLUMNS)
      add_tile(depth, A + row, stride_A, B + column, stride_B, C + (long)row * stride_C + column, stride_C);
}
#endif

void gg_hermite_product_add(int rows, int columns, int depth, const double *A, int stride_A, const double *B,
                            int stride_B, double *C, int stride_C)
{
#ifdef GG_WIDE_TARGET
  if (__builtin_cpu_supports("avx512f")) {
    add_tiles(rows, columns, depth, A, stride_A, B, stride_B, C, stride_C);
    return;
  }
#endif
  add_narrow_tiles(rows, columns, depth, A, stride_A, B, stride_B, C, stride_C);
}
