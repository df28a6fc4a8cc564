/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/factors.h"

#include <math.h>
#include <string.h>

#include "theory/hermite/overlap.h"

enum { APPROACH = 48 };

/* Limit of integration: beyond it the weight is below 1e-31. */
static const double farthest = 12;

static void values(int degree, double x, double *value)
{
  value[0] = 1;
  for (int n = 0; n < degree; n++) value[n + 1] = (x * value[n] - (n ? sqrt(n) * value[n - 1] : 0)) / sqrt(n + 1);
}

static gg_status make_normal(gg_rough_factors *f, const gg_rough_collision *c, int degree, gg_error *err)
{
  double u[APPROACH], w[APPROACH], before[GG_ROUGH_SIDE], after[GG_ROUGH_SIDE];
  GG_TRY(gg_hermite_legendre_rule(APPROACH, u, w, err));
  for (int i = 0; i < APPROACH; i++) {
    double x = farthest * u[i], amount = 4 * M_PI * farthest * w[i] * c->s * x * exp(-x * x / 2) / sqrt(2 * M_PI);
    values(degree, c->normal[2] * x, before);
    values(degree, c->M[2][2] * c->normal[2] * x, after);
    for (int r = 0; r <= degree; r++)
      for (int s = 0; s <= degree; s++) {
        f->gain[r][s] += amount * after[r] * before[s];
        f->loss[r][s] += amount * before[r] * before[s];
      }
  }
  return GG_OK;
}

/* Velocity axis d and spin axis p. */
static void add_tangent(gg_rough_factors *f, const gg_rough_collision *c, int degree, int d, int p, double x, double y,
                        double amount)
{
  double one[2][GG_ROUGH_SIDE], after[2][GG_ROUGH_SIDE];
  values(degree, x, one[0]);
  values(degree, y, one[1]);
  values(degree, c->M[d][d] * x + c->M[d][p] * y, after[0]);
  values(degree, c->M[p][d] * x + c->M[p][p] * y, after[1]);
  for (int a = 0; a <= degree; a++)
    for (int b = 0; a + b <= degree; b++)
      for (int s = 0; s <= degree; s++)
        for (int t = (a + b + s) % 2; s + t <= degree; t += 2)
          f->along[d][a][b][s][t] += amount * after[0][a] * after[1][b] * one[0][s] * one[1][t];
}

gg_status gg_rough_factors_make(gg_rough_factors *f, const gg_rough_collision *c, int degree, gg_error *err)
{
  double x[GG_ROUGH_SIDE], w[GG_ROUGH_SIDE];
  int n = degree + 1;
  memset(f, 0, sizeof *f);
  GG_TRY(make_normal(f, c, degree, err));
  GG_TRY(gg_hermite_rule(n, x, w, err));
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (int k = 0; k < 2; k++) add_tangent(f, c, degree, k, 4 - k, x[i], x[j], w[i] * w[j]);
  return GG_OK;
}
