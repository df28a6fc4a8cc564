/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tensors of rank two in three dimensions. */
#ifndef GG_TENSOR_H
#define GG_TENSOR_H

#include "common/vec.h"

typedef struct gg_tensor {
  double at[3][3];
} gg_tensor;

GG_INLINE gg_vec gg_tensor_times(gg_tensor A, gg_vec b)
{
  return (gg_vec){A.at[0][0] * b.x + A.at[0][1] * b.y + A.at[0][2] * b.z,
                  A.at[1][0] * b.x + A.at[1][1] * b.y + A.at[1][2] * b.z,
                  A.at[2][0] * b.x + A.at[2][1] * b.y + A.at[2][2] * b.z};
}

GG_INLINE gg_tensor gg_tensor_product(gg_tensor A, gg_tensor B)
{
  gg_tensor C;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      C.at[i][j] = A.at[i][0] * B.at[0][j] + A.at[i][1] * B.at[1][j] + A.at[i][2] * B.at[2][j];
  return C;
}

/* A + f B */
GG_INLINE gg_tensor gg_tensor_plus(gg_tensor A, double f, gg_tensor B)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) A.at[i][j] += f * B.at[i][j];
  return A;
}

GG_INLINE gg_tensor gg_tensor_scaled(double f, gg_tensor A)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) A.at[i][j] *= f;
  return A;
}

GG_INLINE gg_tensor gg_tensor_transposed(gg_tensor A)
{
  gg_tensor B;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) B.at[i][j] = A.at[j][i];
  return B;
}

/* a b^T */
GG_INLINE gg_tensor gg_tensor_outer(gg_vec a, gg_vec b)
{
  return (gg_tensor){
      {{a.x * b.x, a.x * b.y, a.x * b.z}, {a.y * b.x, a.y * b.y, a.y * b.z}, {a.z * b.x, a.z * b.y, a.z * b.z}}};
}

/* X of X w = k x w. */
GG_INLINE gg_tensor gg_tensor_cross(gg_vec k)
{
  return (gg_tensor){{{0, -k.z, k.y}, {k.z, 0, -k.x}, {-k.y, k.x, 0}}};
}

GG_INLINE double gg_tensor_trace(gg_tensor A)
{
  return A.at[0][0] + A.at[1][1] + A.at[2][2];
}

#endif
