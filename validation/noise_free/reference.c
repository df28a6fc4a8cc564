/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "reference.h"

#include "theory/hermite/shear.h"

const gg_quantity gg_reference_quantity[GG_REFERENCE_NUMBERS] = {GG_Q_TEMPERATURE, GG_Q_P_XY, GG_Q_N1, GG_Q_N2};

/* Whole stress. */
static void numbers_of(gg_hermite_shear *h, double number[GG_REFERENCE_NUMBERS])
{
  const gg_model *m = h->model;
  double M[3][3], P[3][3];
  gg_hermite_sums sums;
  gg_hermite_second_moments(&h->op.basis, h->state, M);
  gg_hermite_sums_at(&h->op, &h->gas, h->state, &sums);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) P[i][j] = m->density * (M[i][j] + (m->boltzmann ? 0 : sums.transfer[i][j]));
  double p = (P[0][0] + P[1][1] + P[2][2]) / 3;
  number[0] = (M[0][0] + M[1][1] + M[2][2]) / 3;
  number[1] = m->stress_unit * P[0][1];
  number[2] = (P[0][0] - P[1][1]) / p;
  number[3] = (P[1][1] - P[2][2]) / p;
}

bool gg_reference_shear(const gg_model *model, int last_degree, double number[GG_REFERENCE_NUMBERS])
{
  gg_hermite_shear h;
  gg_error err;
  if (gg_hermite_shear_begin(&h, model, &err) != GG_OK) return false;
  bool good = true;
  for (int degree = 4; good && degree <= last_degree; degree += 2)
    good = gg_hermite_shear_solve(&h, degree, &err) == GG_OK;
  if (good) numbers_of(&h, number);
  gg_hermite_shear_end(&h);
  return good;
}
