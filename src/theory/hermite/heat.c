/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/heat.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "theory/linear_solve.h"

/* A vector along x is c_x times a function of c^2, c = C/sqrt(width). A collision along z changes c_z alone; the sum
 * over all directions of one component is a third of the sum over the components in one direction: once along it,
 * and twice across. With x = c^2/2, trials are c_a H_n, H_n ~ L_n^(3/2)(x), n = 0 .. N/2, and tests are the same
 * times exp(-decay x), n > 0: n = 0 would be momentum, which neither A nor B has. */
enum { MOST = GG_HERMITE_MOST_DEGREE / 2 + 1, POINTS = 64, ACROSS = MOST + 4 };

/* Values at one c_z, for every s = (c_x^2 + c_y^2)/2 of the rule. */
typedef struct height {
  double z, damp;                           /* exp(-decay z^2/2) */
  double trial[ACROSS][MOST], base[ACROSS]; /* H_n; f0 over the Gaussian */
  /* Distributions of c_z over the Gaussian: of f0, of c_z H_n, and of D = -d/dC . (C f0)/2, the source term of grad
   * ln T. */
  double along, of_trial[MOST], of_gradient;
} height;

typedef struct response {
  int n;                                     /* number of functions */
  double decay, width, eta, frequency, rate; /* rate: of the stretching that keeps T */
  double alpha[MOST], marginal[MOST];        /* f0, by Sonine polynomials of x; along z by Ho_2l */
  int n_u, n_v, n_s;
  double u[POINTS], wu[POINTS], v[POINTS], wv[POINTS], s[ACROSS], ws[ACROSS];
  height z, after, partner;
  double M[MOST][MOST], overlap[MOST][MOST]; /* d<psi_m>/dt, and <psi_m>, for c_a H_n */
  /* <psi_m> of the streaming terms of grad ln T and grad ln n on f0; of the accelerations by the pressure; and of
   * partners at a distance: D, and f0. */
  double streamed[2][MOST], pressed[MOST], distant[2][MOST];
  double carried; /* collisional transfer of f0 along grad ln T, over the distance */
} response;

/* L_n^(a)(x), n < count, orthonormal under x^a exp(-x)/Gamma(a + 1), times sign^n. */
static void laguerre(double a, double x, int count, double sign, double *value)
{
  double before = 0, now = 1, norm = 1;
  for (int n = 0; n < count; n++) {
    value[n] = now * norm;
    double next = ((2 * n + 1 + a - x) * now - (n + a) * before) / (n + 1);
    before = now, now = next;
    norm *= sign * sqrt((n + 1) / (n + 1 + a));
  }
}

static gg_status laguerre_rule(double a, int n, double *x, double *w, gg_error *err)
{
  gsl_integration_fixed_workspace *rule =
      gsl_integration_fixed_alloc(gsl_integration_fixed_laguerre, (size_t)n, 0, 1, a, 0);
  if (!rule) return gg_base_out_of_memory(err);
  for (int k = 0; k < n; k++) {
    x[k] = gsl_integration_fixed_nodes(rule)[k];
    w[k] = gsl_integration_fixed_weights(rule)[k] / gsl_sf_gamma(a + 1);
  }
  gsl_integration_fixed_free(rule);
  return GG_OK;
}

static double base_at(const response *r, double x)
{
  double value[MOST], sum = 0;
  laguerre(0.5, x, r->n, -1, value);
  for (int l = 0; l < r->n; l++) sum += r->alpha[l] * value[l];
  return sum;
}

/* f0 and D along z: D is -d/dz (z phi Ho_k)/2, where d(phi Ho_k)/dz = -phi sqrt(k + 1) Ho_(k+1). */
static void evaluate_along(const response *r, height *h)
{
  double value[2 * MOST];
  gg_hermite_values(2 * r->n - 1, h->z, value);
  h->along = h->of_gradient = 0;
  for (int l = 0; l < r->n; l++) {
    h->along += r->marginal[l] * value[2 * l];
    h->of_gradient -= r->marginal[l] * (value[2 * l] - h->z * sqrt(2 * l + 1) * value[2 * l + 1]) / 2;
  }
}

static void look(const response *r, double z, height *h)
{
  h->z = z, h->damp = exp(-r->decay * z * z / 2);
  for (int k = 0; k < r->n_s; k++) {
    laguerre(1.5, z * z / 2 + r->s[k], r->n, 1, h->trial[k]);
    h->base[k] = base_at(r, z * z / 2 + r->s[k]);
  }
  evaluate_along(r, h);
  laguerre(0.5, z * z / 2, r->n, 1, h->of_trial); /* L_n^(3/2)(x + s) under exp(-s) is L_n^(1/2)(x) */
  for (int n = 0; n < r->n; n++) h->of_trial[n] *= z / sqrt(1 + n / 1.5);
}

/* One point of the rule: the grain at z, its partner, and the grain's velocity after the collision. */
static void add_pair(response *r, double w)
{
  const height *h = &r->z, *after = &r->after, *partner = &r->partner;
  for (int k = 0; k < r->n_s; k++)
    for (int m = 1; m < r->n; m++) {
      double gain = w * r->ws[k] * after->damp * after->trial[k][m], loss = w * r->ws[k] * h->damp * h->trial[k][m];
      double along = after->z * gain - h->z * loss, across = 2 * r->s[k] * (gain - loss);
      double own = (along * h->z + across) * partner->along, others = along * h->base[k];
      for (int n = 0; n < r->n; n++) r->M[m][n] += own * h->trial[k][n] + others * partner->of_trial[n];
      r->distant[0][m] += others * partner->of_gradient;
      r->distant[1][m] += others * partner->along;
    }
}

/* g = sqrt(2) u; the amount that a collision transfers along z over the distance is proportional to g^2 v/sqrt(2). */
static void add_collisions(response *r)
{
  for (int i = 0; i < r->n_u; i++)
    for (int j = 0; j < r->n_v; j++) {
      double u = r->u[i], v = r->v[j], g = M_SQRT2 * u;
      double w = 4 * M_PI / 3 * r->frequency * sqrt(r->width) * g * r->wu[i] * r->wv[j];
      look(r, (v + u) / M_SQRT2, &r->z);
      look(r, (v - u) / M_SQRT2, &r->partner);
      look(r, r->z.z - r->eta * g, &r->after);
      add_pair(r, w);
      r->carried +=
          w * r->width * g * v / M_SQRT2 * (r->z.along * r->partner.of_gradient - r->z.of_gradient * r->partner.along);
    }
}

/* Isotropic averages at one x, of weight w with the damping of the tests. */
static void add_averages(response *r, double x, double w)
{
  double trial[MOST], higher[MOST], base = base_at(r, x), V = sqrt(r->width);
  laguerre(1.5, x, r->n, 1, trial);
  laguerre(2.5, x, r->n, 1, higher);
  for (int m = 1; m < r->n; m++) {
    /* x G' of the damped test G; x dL_m^(3/2)/dx = -x L_(m-1)^(5/2) */
    double G = trial[m], xdG = -x * higher[m - 1] * sqrt(m / 2.5) - r->decay * x * G;
    for (int n = 0; n < r->n; n++) {
      r->overlap[m][n] += w * 2 * x / 3 * G * trial[n];
      r->M[m][n] += w * r->rate * 2 * x / 3 * (G + 2 * xdG) * trial[n]; /* c . grad (c_x G) */
    }
    r->streamed[0][m] -= w * base * V / 6 * 4 * x * (G + xdG); /* C_x d/dC . (C f0)/2 */
    r->streamed[1][m] -= w * base * V / 3 * 2 * x * G;         /* -C_x f0 */
    r->pressed[m] += w * base * (G + 2 * xdG / 3) / V;         /* -df0/dC_x */
  }
}

/* exp(-x (1 + decay)) is the weight of the rule. */
static gg_status add_streaming(response *r, gg_error *err)
{
  double x[POINTS], w[POINTS], scale = 1 / (1 + r->decay);
  const int points = 2 * r->n + 6;
  GG_TRY(laguerre_rule(0.5, points, x, w, err));
  for (int k = 0; k < points; k++) add_averages(r, scale * x[k], w[k] * pow(scale, 1.5));
  return GG_OK;
}

static gg_status make(response *r, const gg_hermite_isotropic *h, gg_error *err)
{
  const gg_hermite_basis *b = &h->op.basis;
  const int N = b->degree;
  r->n = N / 2 + 1;
  r->decay = h->op.decay, r->width = h->state.width, r->rate = h->cooling_rate / 2;
  r->eta = h->gas.impact[0][0].eta, r->frequency = h->gas.impact[0][0].frequency;
  for (int l = 0; l < r->n; l++) {
    r->marginal[l] = h->state.a[gg_hermite_place(b, 2 * l, 0, 0)];
    r->alpha[l] = r->marginal[l] * sqrt(2 * l + 1); /* isotropic.c: Ho_2l is the part (2l + 1)^(-1/2) of Phi_l */
  }
  const double farthest = 12; /* as in flux.c */
  r->n_u = 24 + N, r->n_v = (3 * N + 8) / 2, r->n_s = r->n + 3;
  GG_TRY(gg_hermite_legendre_rule(r->n_u, r->u, r->wu, err));
  GG_TRY(gg_hermite_rule(r->n_v, r->v, r->wv, err));
  GG_TRY(laguerre_rule(0, r->n_s, r->s, r->ws, err));
  for (int i = 0; i < r->n_u; i++) {
    r->u[i] *= farthest;
    r->wu[i] *= farthest * exp(-r->u[i] * r->u[i] / 2) / sqrt(2 * M_PI);
  }
  for (int k = 0; k < r->n_s; k++) r->s[k] /= 1 + r->decay, r->ws[k] /= 1 + r->decay;
  return GG_OK;
}

/* (M + fading) f1 = -source; f1 replaces the source. For functions without momentum f1_0 = 0. */
static bool solve(const response *r, double fading, double *f1)
{
  const size_t n = (size_t)r->n - 1;
  double *M = gg_theory_linear_new(n), *x = M ? M + n * n : NULL;
  for (size_t m = 0; M && m < n; m++) {
    x[m] = -f1[m + 1];
    for (size_t k = 0; k < n; k++) M[m * n + k] = r->M[m + 1][k + 1] + fading * r->overlap[m + 1][k + 1];
  }
  const bool solved = M && gg_theory_linear_solve(n, M);
  f1[0] = 0;
  for (size_t m = 0; solved && m < n; m++) f1[m + 1] = x[m];
  free(M);
  return solved;
}

/* -<C^2 C_x>/2 of f1: C^2 C_x is of degree 3, sqrt(W)^3 c_x (5 - sqrt(10) H_1). */
static double kinetic(const response *r, const double *f1)
{
  return pow(r->width, 1.5) * sqrt(10) / 2 * f1[1];
}

/* The equations of A and B; sigma is the diameter in units in which n chi sigma^2 is the frequency. */
static gg_status respond(response *r, gg_hermite_density d, gg_hermite_heat *heat, gg_error *err)
{
  double A[MOST], B[MOST], reach = 6 / M_PI * d.phi_chi / r->frequency, y = 4 * r->eta * d.phi_chi;
  for (int m = 0; m < r->n; m++) A[m] = r->streamed[0][m] + (1 + y) * r->pressed[m] + reach * r->distant[0][m];
  if (!solve(r, r->rate, A)) return gg_base_fail(err, GG_FAILED, "no linear response was found");
  for (int m = 0; m < r->n; m++) {
    B[m] = r->streamed[1][m] + (1 + y * (2 + d.slope)) * r->pressed[m] + reach * (1 + d.slope / 2) * r->distant[1][m];
    for (int n = 0; n < r->n; n++) B[m] += 2 * r->rate * (1 + d.slope) * r->overlap[m][n] * A[n];
  }
  if (!solve(r, 0, B)) return gg_base_fail(err, GG_FAILED, "no linear response was found");
  heat->conductivity_kinetic = kinetic(r, A);
  heat->diffusive_kinetic = kinetic(r, B);
  heat->conductivity = heat->conductivity_kinetic * (1 + 0.6 * y) - reach * reach * r->eta / 4 * r->carried;
  heat->diffusive = heat->diffusive_kinetic * (1 + 0.6 * y);
  return GG_OK;
}

gg_status gg_hermite_heat_of(const gg_hermite_isotropic *cooling, gg_hermite_density density, gg_hermite_heat *heat,
                             gg_error *err)
{
  response *r = gg_base_array_new(1, sizeof *r, err);
  if (!r) return GG_FAILED;
  gg_base_gsl_enter();
  gg_status status = make(r, cooling, err);
  if (status == GG_OK) status = add_streaming(r, err);
  if (status == GG_OK) {
    add_collisions(r);
    status = respond(r, density, heat, err);
  }
  gg_base_gsl_leave();
  free(r);
  return status;
}
