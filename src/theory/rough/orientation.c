/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <cos^2 Psi> from f = weight x sum_q a_q Ho_r(c) Ho_s(o), C = L c, W = S o: cos^2 Psi depends on the directions of c
 * and o alone, so that radial integrals of each function come first, then a sum over directions of both. cos^2 Psi does
 * not change where c or o is reversed: half a sphere each, and functions of even degree in c and in o. */
#include "theory/rough/orientation.h"

#include <math.h>
#include <stdlib.h>

#include "theory/hermite/overlap.h"

enum { POLAR = 8, AZIMUTH = 18, DIRECTIONS = POLAR * AZIMUTH, RADIAL = GG_ROUGH_MOST_DEGREE / 2 + 2 };

typedef struct directions {
  double k[DIRECTIONS][3], weight[DIRECTIONS], rho[RADIAL], rho_weight[RADIAL];
} directions;

static bool make_directions(directions *d)
{
  double z[POLAR], wz[POLAR];
  gg_error ignored;
  if (gg_hermite_legendre_rule(POLAR, z, wz, &ignored) != GG_OK) return false;
  if (gg_hermite_rule(RADIAL, d->rho, d->rho_weight, &ignored) != GG_OK) return false;
  for (int i = 0; i < DIRECTIONS; i++) {
    const int p = i / AZIMUTH;
    const double angle = 2 * M_PI * (i % AZIMUTH + 0.5) / AZIMUTH, r = sqrt(1 - z[p] * z[p]);
    d->k[i][0] = r * cos(angle), d->k[i][1] = r * sin(angle), d->k[i][2] = z[p];
    d->weight[i] = wz[p] / AZIMUTH;
  }
  return true;
}

/* Ho_0 .. Ho_degree at x. */
static void hermite(int degree, double x, double *Ho)
{
  Ho[0] = 1, Ho[1] = x;
  for (int k = 2; k <= degree; k++) Ho[k] = (x * Ho[k - 1] - sqrt(k - 1.) * Ho[k - 2]) / sqrt(k);
}

/* int rho^2 drho exp(-rho^2/2) Ho_v(rho k) for all functions v of three coordinates, of even degree. */
static void integrate_radius(const directions *d, const gg_rough_functions *f, int i, double *integral)
{
  double Ho[3][GG_ROUGH_MOST_DEGREE + 1];
  for (int v = 0; v < f->n3; v++) integral[v] = 0;
  for (int g = 0; g < RADIAL; g++) {
    for (int x = 0; x < 3; x++) hermite(f->degree, d->rho[g] * d->k[i][x], Ho[x]);
    const double weight = d->weight[i] * d->rho_weight[g] * d->rho[g] * d->rho[g];
    for (int v = 0; v < f->n3; v++) {
      const int *r = f->three[v];
      if ((r[0] + r[1] + r[2]) % 2 == 0) integral[v] += weight * Ho[0][r[0]] * Ho[1][r[1]] * Ho[2][r[2]];
    }
  }
}

/* Unit vectors along A k. */
static void turn(const directions *d, const double A[3][3], double unit[DIRECTIONS][3])
{
  for (int i = 0; i < DIRECTIONS; i++) {
    double square = 0;
    for (int x = 0; x < 3; x++) {
      unit[i][x] = A[x][0] * d->k[i][0] + A[x][1] * d->k[i][1] + A[x][2] * d->k[i][2];
      square += unit[i][x] * unit[i][x];
    }
    for (int x = 0; x < 3; x++) unit[i][x] /= sqrt(square);
  }
}

/* mean[i n3 + s] = sum over directions j of o of cos^2 Psi_ij times the radial integral of function s. */
static void average_over_spins(const directions *d, const gg_rough_weight *w, size_t n3, const double *integral,
                               double *mean)
{
  double C[DIRECTIONS][3], W[DIRECTIONS][3];
  turn(d, w->L, C);
  turn(d, w->S, W);
  for (size_t i = 0; i < DIRECTIONS; i++)
    for (size_t j = 0; j < DIRECTIONS; j++) {
      const double cosine = C[i][0] * W[j][0] + C[i][1] * W[j][1] + C[i][2] * W[j][2], square = cosine * cosine;
      for (size_t s = 0; s < n3; s++) mean[i * n3 + s] += square * integral[j * n3 + s];
    }
}

double gg_rough_cos2_psi(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *w,
                         const double *a)
{
  const size_t n3 = (size_t)f->n3;
  directions *d = calloc(1, sizeof *d);
  double *integral = calloc(DIRECTIONS * n3, sizeof *integral), *mean = calloc(DIRECTIONS * n3, sizeof *mean);
  double sum = NAN;
  if (d && integral && mean && make_directions(d)) {
    for (int i = 0; i < DIRECTIONS; i++) integrate_radius(d, f, i, integral + (size_t)i * n3);
    average_over_spins(d, w, n3, integral, mean);
    sum = 0;
    for (size_t s = 0; s < n3; s++)
      for (int place = f->from[s]; place < f->from[s + 1]; place++) {
        const int q = form->unknown[place];
        const size_t r = (size_t)(place - f->from[s]);
        for (size_t i = 0; i < DIRECTIONS && q >= 0; i++) sum += a[q] * integral[i * n3 + r] * mean[i * n3 + s];
      }
  }
  free(d), free(integral), free(mean);
  return sum;
}
