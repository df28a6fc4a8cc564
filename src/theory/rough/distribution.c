/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/distribution.h"

#include <math.h>
#include <string.h>

#include "theory/hermite/contact_integral.h"

/* int w Ho_v n_i n_j over a velocity or a spin of direction n, for each function v of three coordinates. */
typedef struct second_moments {
  double of[GG_ROUGH_MOST_THREE][3][3];
} second_moments;

gg_hermite_component gg_rough_component_of(const gg_rough_steady *s, bool spin, int axis)
{
  gg_hermite_component m = {.degree = s->degree};
  gg_rough_marginal(&s->form, &s->relative.f, &s->weight, s->a, spin, axis, m.t);
  return m;
}

/* Ho_v along a ray x = rho u, |u| = 1, integrated over rho with the Gaussian; degree by degree the polynomials of one
 * coordinate. */
static void add_ray(const gg_rough_functions *f, const double u[3], double rho, double w, double *sum)
{
  double one[3][GG_ROUGH_MOST_DEGREE + 2];
  for (int i = 0; i < 3; i++) {
    const double x = rho * u[i];
    one[i][0] = 1, one[i][1] = x;
    for (int k = 1; k < f->degree; k++) one[i][k + 1] = (x * one[i][k] - sqrt(k) * one[i][k - 1]) / sqrt(k + 1);
  }
  w *= rho * rho * exp(-rho * rho / 2) / pow(2 * M_PI, 1.5);
  for (int v = 0; v < f->n3; v++)
    sum[v] += w * one[0][f->three[v][0]] * one[1][f->three[v][1]] * one[2][f->three[v][2]];
}

/* Directions u of the standard normal coordinates; n = L u/|L u| is that of the velocity. */
static bool direction_moments(const gg_rough_functions *f, const double L[3][3], second_moments *m)
{
  enum { POLAR = 20, AZIMUTH = 32, RADIAL = 40 };
  double z[POLAR], wz[POLAR], r[RADIAL], wr[RADIAL];
  gg_error ignored;
  memset(m, 0, sizeof *m);
  if (gg_hermite_legendre_rule(POLAR, z, wz, &ignored) != GG_OK) return false;
  if (gg_hermite_legendre_rule(RADIAL, r, wr, &ignored) != GG_OK) return false;
  for (int p = 0; p < POLAR * AZIMUTH; p++) {
    const double kz = 2 * z[p / AZIMUTH] - 1, s = sqrt(1 - kz * kz), angle = 2 * M_PI * (p % AZIMUTH + 0.5) / AZIMUTH;
    const double u[3] = {s * cos(angle), s * sin(angle), kz};
    double along[GG_ROUGH_MOST_THREE] = {0}, n[3] = {0}, square = 0;
    for (int k = 0; k < RADIAL; k++) add_ray(f, u, 12 * r[k], 12 * wr[k], along);
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j <= i; j++) n[i] += L[i][j] * u[j];
      square += n[i] * n[i];
    }
    const double w = 2 * wz[p / AZIMUTH] * 2 * M_PI / AZIMUTH / square;
    for (int v = 0; v < f->n3; v++)
      for (int i = 0; i < 9; i++) m->of[v][i / 3][i % 3] += w * along[v] * n[i / 3] * n[i % 3];
  }
  return true;
}

/* sum_q a_q of both moments, with their indices contracted. */
static double contract(const gg_rough_steady *s, const second_moments m[2], bool with_each_other)
{
  const gg_rough_functions *f = &s->relative.f;
  double sum = 0;
  for (int q = 0; q < s->form.n; q++) {
    const int place = s->form.function[q];
    int spin = 0;
    while (f->from[spin + 1] <= place) spin++;
    const double(*A)[3] = m[0].of[place - f->from[spin]], (*B)[3] = m[1].of[spin];
    for (int i = 0; i < 9; i++) {
      const int x = i / 3, y = i % 3;
      sum += s->a[q] * (with_each_other ? A[x][y] * B[x][y] : A[x][x] * B[y][y]);
    }
  }
  return sum;
}

double gg_rough_orientation(const gg_rough_steady *s)
{
  second_moments m[2];
  if (!direction_moments(&s->relative.f, s->weight.L, &m[0]) || !direction_moments(&s->relative.f, s->weight.S, &m[1]))
    return NAN;
  return contract(s, m, true) / contract(s, m, false);
}
