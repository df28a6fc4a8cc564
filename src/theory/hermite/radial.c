/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/radial.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_laguerre.h>
#include <math.h>
#include <stdbool.h>

#include "base/memory.h"

enum { POINTS = 2 * GG_RADIAL_MOST + 2 };

static double factorial(int n)
{
  return gsl_sf_fact((unsigned)n);
}

/* Norms: (2l+1)! of (a^+ . a^+)^l in three dimensions, (2j)! in one, 4^m m!^2 in two. */
static void make_split(gg_radial *r)
{
  for (int l = 0; l <= r->most; l++)
    for (int j = 0; j <= l; j++) {
      int m = l - j;
      r->split[l][j] = factorial(l) / (factorial(j) * factorial(m)) * sqrt(factorial(2 * j)) * pow(2, m) *
                       factorial(m) / sqrt(factorial(2 * l + 1));
    }
}

/* With t = c^2/2: Lambda_m = (-1)^m L_m(t), weight exp(-t); Phi_l = (-1)^l L_l^(1/2)(t)/norm, weight t^(1/2) exp(-t).
 */
static double sign(int l)
{
  return l % 2 ? -1 : 1;
}

static double norm(int l)
{
  return sqrt(gsl_sf_gamma(l + 1.5) / (factorial(l) * gsl_sf_gamma(1.5)));
}

static double phi(int l, double t)
{
  return sign(l) * gsl_sf_laguerre_n(l, 0.5, t) / norm(l);
}

static double slope(int l, double t)
{
  return l == 0 ? 0 : -sign(l) * gsl_sf_laguerre_n(l - 1, 1.5, t) / norm(l);
}

static double curvature(int l, double t)
{
  return l < 2 ? 0 : sign(l) * gsl_sf_laguerre_n(l - 2, 2.5, t) / norm(l);
}

/* Derivatives of psi_l = Phi_l exp(-decay t), without the exponential: c.grad = 2 t d/dt, laplacian = 3 d/dt + 2 t
 * d^2/dt^2. */
static double gradient(int l, double decay, double t)
{
  return 2 * t * (slope(l, t) - decay * phi(l, t));
}

static double laplacian(int l, double decay, double t)
{
  double second = curvature(l, t) - 2 * decay * slope(l, t) + decay * decay * phi(l, t);
  return 3 * (slope(l, t) - decay * phi(l, t)) + 2 * t * second;
}

static bool rule(double power, double rate, double *t, double *w)
{
  gsl_integration_fixed_workspace *x =
      gsl_integration_fixed_alloc(gsl_integration_fixed_laguerre, POINTS, 0, rate, power, 0);
  if (!x) return false;
  for (int i = 0; i < POINTS; i++) {
    t[i] = gsl_integration_fixed_nodes(x)[i];
    w[i] = gsl_integration_fixed_weights(x)[i] / gsl_sf_gamma(power + 1);
  }
  gsl_integration_fixed_free(x);
  return true;
}

gg_status gg_hermite_radial_make(gg_radial *r, int most, double decay, gg_error *err)
{
  double t[POINTS], w[POINTS];
  *r = (gg_radial){.most = most, .decay = decay};
  make_split(r);
  for (int k = 0; k < 2; k++) {
    if (!rule(0, k ? 1 + decay : 1, t, w)) return gg_base_out_of_memory(err);
    for (int M = 0; M <= most; M++)
      for (int m = 0; m <= most; m++)
        for (int i = 0; i < POINTS; i++)
          r->across[k][M][m] += w[i] * sign(M + m) * gsl_sf_laguerre_n(M, 0, t[i]) * gsl_sf_laguerre_n(m, 0, t[i]);
    if (!rule(0.5, k ? 1 + decay : 1, t, w)) return gg_base_out_of_memory(err);
    for (int l = k ? 2 : 0; l <= (k ? most : 1); l++)
      for (int m = 0; m <= most; m++)
        for (int i = 0; i < POINTS; i++) {
          r->growth[l][m] += w[i] * gradient(l, k ? decay : 0, t[i]) * phi(m, t[i]);
          r->spread[l][m] += w[i] * laplacian(l, k ? decay : 0, t[i]) * phi(m, t[i]);
        }
  }
  return GG_OK;
}

void gg_hermite_radial_marginal(const gg_radial *r, const double *alpha, double *marginal)
{
  for (int l = 0; l <= r->most; l++) marginal[l] = alpha[l] * r->split[l][l];
}
