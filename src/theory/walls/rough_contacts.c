/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/rough_contacts.h"

#include <gsl/gsl_multifit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "theory/gaussian_moments.h"

enum { DEGREE = 4, SAMPLES = 360, ODD = 32 };
static const double most_shear = 2.5;

static int monomials(int odd, gg_rough_point p, double f[])
{
  double x[4][DEGREE + 1];
  const double v[4] = {p.xx, p.yy, p.xy, p.a};
  for (int k = 0; k < 4; k++) {
    x[k][0] = 1;
    for (int i = 1; i <= DEGREE; i++) x[k][i] = x[k][i - 1] * v[k];
  }
  int n = 0;
  for (int both = odd; both <= DEGREE; both += 2)
    for (int i = 0; i <= both; i++)
      for (int j = 0; j <= DEGREE - both; j++)
        for (int k = 0; k <= DEGREE - both - j; k++) f[n++] = x[2][i] * x[3][both - i] * x[0][j] * x[1][k];
  return n;
}

static void integrals(const gg_model *m, gg_rough_point p, double ratio, double f[])
{
  gg_model copy = *m;
  gg_gaussian_rates r;
  const double spin = ratio / m->inertia[0];
  copy.shear_rate = p.a;
  gg_gaussian s = {.M = {{{1 + p.xx, p.xy, 0}, {p.xy, 1 + p.yy, 0}, {0, 0, 1 - p.xx - p.yy}}},
                   .Theta = {{{spin, 0, 0}, {0, spin, 0}, {0, 0, spin}}},
                   .spin = -p.a / 4};
  gg_theory_gaussian_rates_at(&copy, &s, &r);
  const gg_tensor *M = &r.change[0].M;
  f[GG_CONTACT_XX] = M->at[0][0], f[GG_CONTACT_YY] = M->at[1][1], f[GG_CONTACT_ZZ] = M->at[2][2];
  f[GG_CONTACT_P_XX] = r.Pc.at[0][0], f[GG_CONTACT_P_YY] = r.Pc.at[1][1], f[GG_CONTACT_P_ZZ] = r.Pc.at[2][2];
  f[GG_CONTACT_SPINS] = gg_tensor_trace(r.change[0].Theta);
  f[GG_CONTACT_XY] = M->at[0][1], f[GG_CONTACT_P_YX] = r.Pc.at[1][0], f[GG_CONTACT_SPIN] = r.change[0].spin;
}

/* Halton's sequence. */
static double part(int i, int base)
{
  double sum = 0, step = 1;
  for (; i > 0; i /= base) step /= base, sum += step * (i % base);
  return sum;
}

static gg_rough_point sample(int *i)
{
  gg_rough_point p;
  do {
    ++*i;
    p.xx = -0.2 + 1.0 * part(*i, 2), p.yy = -0.45 + 0.65 * part(*i, 3);
    p.xy = (0.2 - 0.9 * part(*i, 5)) * sqrt((1 + p.xx) * (1 + p.yy)), p.a = most_shear * part(*i, 7);
  } while (p.xx + p.yy > 0.55 || p.xx + p.yy < -0.35);
  return p;
}

bool gg_theory_rough_contacts_make(const gg_model *m, gg_rough_contacts *c)
{
  gg_model copy = *m;
  copy.boltzmann = false, copy.density = copy.number_density[0] = copy.chi[0] = copy.sigma[0] = 1;
  memset(c, 0, sizeof *c);
  double (*f)[2][GG_CONTACT_FUNCTIONS] = malloc(SAMPLES * sizeof *f);
  gg_rough_point *p = malloc(SAMPLES * sizeof *p);
  for (int i = 0, k = 0; k < SAMPLES; k++) {
    p[k] = sample(&i);
    integrals(&copy, p[k], 0, f[k][0]), integrals(&copy, p[k], 1, f[k][1]);
  }
  for (int odd = 0; odd < 2; odd++) {
    const size_t n = odd ? ODD : GG_CONTACT_MONOMIALS;
    gsl_multifit_linear_workspace *w = gsl_multifit_linear_alloc(SAMPLES, n);
    gsl_matrix *X = gsl_matrix_alloc(SAMPLES, n), *V = gsl_matrix_alloc(n, n);
    gsl_vector *y = gsl_vector_alloc(SAMPLES), *b = gsl_vector_alloc(n);
    for (int k = 0; k < SAMPLES; k++) {
      double x[GG_CONTACT_MONOMIALS];
      monomials(odd, p[k], x);
      for (size_t j = 0; j < n; j++) gsl_matrix_set(X, (size_t)k, j, x[j]);
    }
    for (int q = odd ? GG_CONTACT_EVEN : 0; q < (odd ? GG_CONTACT_FUNCTIONS : GG_CONTACT_EVEN); q++)
      for (int r = 0; r < 2; r++) {
        double chi2;
        for (int k = 0; k < SAMPLES; k++) gsl_vector_set(y, (size_t)k, r ? f[k][1][q] - f[k][0][q] : f[k][0][q]);
        gsl_multifit_linear(X, y, b, V, &chi2, w);
        if (getenv("FIT")) fprintf(stderr, "function %d r %d rms %g\n", q, r, sqrt(chi2 / SAMPLES));
        for (size_t j = 0; j < n; j++) (r ? c->per_ratio : c->constant)[q][j] = gsl_vector_get(b, j);
      }
    gsl_multifit_linear_free(w), gsl_matrix_free(X), gsl_matrix_free(V), gsl_vector_free(y), gsl_vector_free(b);
  }
  free(f), free(p);
  return true;
}

void gg_theory_rough_contacts_at(const gg_rough_contacts *c, double ratio, double to[GG_CONTACT_FUNCTIONS][GG_CONTACT_MONOMIALS])
{
  for (int q = 0; q < GG_CONTACT_FUNCTIONS; q++)
    for (int j = 0; j < GG_CONTACT_MONOMIALS; j++) to[q][j] = c->constant[q][j] + ratio * c->per_ratio[q][j];
}

void gg_theory_rough_contacts_value(double c[GG_CONTACT_FUNCTIONS][GG_CONTACT_MONOMIALS], gg_rough_point p,
                                    double value[GG_CONTACT_FUNCTIONS])
{
  double x[2][GG_CONTACT_MONOMIALS];
  const int n[2] = {monomials(0, p, x[0]), monomials(1, p, x[1])};
  for (int q = 0; q < GG_CONTACT_FUNCTIONS; q++) {
    const int odd = q >= GG_CONTACT_EVEN;
    double sum = 0;
    for (int j = 0; j < n[odd]; j++) sum += c[q][j] * x[odd][j];
    value[q] = sum;
  }
}
