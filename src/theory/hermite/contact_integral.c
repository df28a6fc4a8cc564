/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/contact_integral.h"

#include <math.h>

void gg_hermite_left_divide(double L[3][3], double A[3][3], double B[3][3])
{
  for (int column = 0; column < 3; column++)
    for (int i = 0; i < 3; i++) {
      double x = A[i][column];
      for (int j = 0; j < i; j++) x -= L[i][j] * B[j][column];
      B[i][column] = x / L[i][i];
    }
}

/* Any tangent: along a principal axis all are equivalent. */
static void any_tangent(double axis[3][3])
{
  int least = 0;
  for (int i = 1; i < 3; i++)
    if (fabs(axis[0][i]) < fabs(axis[0][least])) least = i;
  double along = axis[0][least], norm = sqrt(1 - along * along);
  for (int i = 0; i < 3; i++) axis[1][i] = ((i == least) - along * axis[0][i]) / norm;
}

gg_hermite_frame gg_hermite_frame_at(double L[3][3], const double k[3])
{
  gg_hermite_frame f;
  double(*axis)[3] = f.axis, b[3][3] = {{k[0]}, {k[1]}, {k[2]}}, image[3][3], s = 0, b0 = 0, b1 = 0;
  for (int i = 0; i < 3; i++) axis[0][i] = L[0][i] * k[0] + L[1][i] * k[1] + L[2][i] * k[2];
  for (int i = 0; i < 3; i++) s += axis[0][i] * axis[0][i];
  s = sqrt(s);
  gg_hermite_left_divide(L, b, image);
  for (int i = 0; i < 3; i++) axis[0][i] /= s, b0 += image[i][0] * axis[0][i];
  for (int i = 0; i < 3; i++) axis[1][i] = image[i][0] - b0 * axis[0][i], b1 += axis[1][i] * axis[1][i];
  b1 = sqrt(b1);
  if (b1 > 1e-14 * b0)
    for (int i = 0; i < 3; i++) axis[1][i] /= b1;
  else
    any_tangent(axis), b1 = 0;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, l = (i + 2) % 3;
    axis[2][i] = axis[0][j] * axis[1][l] - axis[0][l] * axis[1][j];
  }
  f.s = s, f.b0 = b0, f.b1 = b1;
  return f;
}

gg_hermite_contact gg_hermite_contact_of(const gg_hermite_impact *x, const gg_hermite_frame *one,
                                         const gg_hermite_frame *two, const double k[3])
{
  double S = sqrt(one->s * one->s + two->s * two->s);
  return (gg_hermite_contact){.frequency = x->frequency,
                              .eta = x->eta,
                              .S = S,
                              .own = one->s / S,
                              .other = two->s / S,
                              .b0 = one->b0,
                              .b1 = one->b1,
                              .u0 = (x->shear * k[0] * k[1] + x->apart) / S};
}
