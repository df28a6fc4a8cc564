/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "simd/matrix.h"

#include "common/vec.h"
#include "simd/clones.h"

/* Vectors of 256 bits. Arrays of wider vectors stay in memory where registers are narrower. */
typedef double lanes __attribute__((vector_size(32), aligned(8), may_alias));
enum { LANES = 4, VECTORS = GG_RIGHT_PANEL / LANES };

/* A panel of rows by a panel of columns: all sums stay in registers. */
GG_INLINE void multiply_panels(int many, const double *left, const double *right, double *C, int stride)
{
  lanes sum[GG_LEFT_PANEL][VECTORS];
  for (int i = 0; i < GG_LEFT_PANEL; i++)
    for (int v = 0; v < VECTORS; v++) sum[i][v] = *(const lanes *)(C + i * stride + v * LANES);
  for (int k = 0; k < many; k++, left += GG_LEFT_PANEL, right += GG_RIGHT_PANEL)
    for (int i = 0; i < GG_LEFT_PANEL; i++)
      for (int v = 0; v < VECTORS; v++) sum[i][v] += left[i] * *(const lanes *)(right + v * LANES);
  for (int i = 0; i < GG_LEFT_PANEL; i++)
    for (int v = 0; v < VECTORS; v++) *(lanes *)(C + i * stride + v * LANES) = sum[i][v];
}

GG_CLONES static void multiply(int many, const double *left, int lefts, const double *right, int rights, double *C,
                               int stride)
{
  for (int j = 0; j < rights; j++)
    for (int i = 0; i < lefts; i++)
      multiply_panels(many, left + (size_t)i * (size_t)(many * GG_LEFT_PANEL),
                      right + (size_t)j * (size_t)(many * GG_RIGHT_PANEL),
                      C + (size_t)i * GG_LEFT_PANEL * (size_t)stride + j * GG_RIGHT_PANEL, stride);
}

void gg_simd_multiply(int many, const double *left, int lefts, const double *right, int rights, double *C, int stride)
{
  multiply(many, left, lefts, right, rights, C, stride);
}
