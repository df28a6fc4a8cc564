/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/rough_contacts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/gaussian_moments.h"
#include "theory/linear_solve.h"

enum { DEGREE = 4, SAMPLES = 200, MONOMIALS = GG_CONTACT_MONOMIALS };

static const double most_shear = 2.5; /* of the fit */

/* Monomials whose degree in xy and a together is even or odd; their number. */
static int monomials(int odd, gg_contact_point p, double f[])
{
  const double v[4] = {p.xx, p.yy, p.xy, p.a};
  double x[4][DEGREE + 1];
  for (int k = 0; k < 4; k++) {
    x[k][0] = 1;
    for (int i = 1; i <= DEGREE; i++) x[k][i] = x[k][i - 1] * v[k];
  }
  int n = 0;
  for (int both = odd; both <= DEGREE; both += 2)
    for (int i = 0; i <= both; i++) {
      const double turned = x[2][i] * x[3][both - i];
      for (int j = 0; j <= DEGREE - both; j++)
        for (int k = 0; k <= DEGREE - both - j; k++) f[n++] = turned * x[0][j] * x[1][k];
    }
  return n;
}

void gg_theory_rough_contacts_model(const gg_model *m, gg_model *one)
{
  *one = *m;
  one->boltzmann = false, one->density = one->number_density[0] = one->chi[0] = one->sigma[0] = 1;
}

void gg_theory_rough_contacts_integral(gg_model *m, gg_contact_point p, double ratio, double f[GG_CONTACT_FUNCTIONS])
{
  gg_gaussian_rates r;
  const double spin = ratio / m->inertia[0];
  const gg_gaussian s = {.M = {{{1 + p.xx, p.xy, 0}, {p.xy, 1 + p.yy, 0}, {0, 0, 1 - p.xx - p.yy}}},
                         .Theta = {{{spin, 0, 0}, {0, spin, 0}, {0, 0, spin}}},
                         .spin = -p.a / 4};
  m->shear_rate = p.a;
  gg_theory_gaussian_rates_at(m, &s, &r);
  const gg_gaussian *change = &r.change[0];
  f[GG_CONTACT_XX] = change->M.at[0][0], f[GG_CONTACT_YY] = change->M.at[1][1], f[GG_CONTACT_ZZ] = change->M.at[2][2];
  f[GG_CONTACT_P_XX] = r.Pc.at[0][0], f[GG_CONTACT_P_YY] = r.Pc.at[1][1], f[GG_CONTACT_P_ZZ] = r.Pc.at[2][2];
  f[GG_CONTACT_LOSS] = r.loss, f[GG_CONTACT_SPIN] = change->spin;
  f[GG_CONTACT_XY] = change->M.at[0][1], f[GG_CONTACT_P_YX] = r.Pc.at[1][0];
}

/* Halton's sequence. */
static double part(int i, int base)
{
  double sum = 0, step = 1;
  for (; i > 0; i /= base) step /= base, sum += step * (i % base);
  return sum;
}

/* The next state of a gas with shear stress against the flow, mostly. */
static gg_contact_point sample(int *i)
{
  gg_contact_point p;
  do {
    ++*i;
    p.xx = part(*i, 2) - 0.2, p.yy = 0.65 * part(*i, 3) - 0.45;
    p.xy = (0.2 - 0.9 * part(*i, 5)) * sqrt((1 + p.xx) * (1 + p.yy)), p.a = most_shear * part(*i, 7);
  } while (p.xx + p.yy > 0.55 || p.xx + p.yy < -0.35);
  return p;
}

typedef struct samples {
  gg_contact_point at[SAMPLES];
  double value[2][SAMPLES][GG_CONTACT_FUNCTIONS]; /* at theta = 0, and what theta = 1 adds */
} samples;

static void take(gg_model *m, samples *s)
{
  for (int k = 0, i = 0; k < SAMPLES; k++) {
    s->at[k] = sample(&i);
    for (int r = 0; r < 2; r++) gg_theory_rough_contacts_integral(m, s->at[k], r, s->value[r][k]);
    for (int q = 0; q < GG_CONTACT_FUNCTIONS; q++) s->value[1][k][q] -= s->value[0][k][q];
  }
}

/* Least squares, by the normal equations. M: memory for them. */
static bool fit(const samples *s, int r, int q, double *M, double to[MONOMIALS])
{
  double x[MONOMIALS];
  const size_t n = (size_t)monomials(q >= GG_CONTACT_EVEN, s->at[0], x);
  memset(M, 0, n * (n + 1) * sizeof *M);
  for (int k = 0; k < SAMPLES; k++) {
    monomials(q >= GG_CONTACT_EVEN, s->at[k], x);
    for (size_t i = 0; i < n; i++) {
      for (size_t j = 0; j < n; j++) M[n * i + j] += x[i] * x[j];
      M[n * n + i] += x[i] * s->value[r][k][q];
    }
  }
  if (!gg_theory_linear_solve(n, M)) return false;
  memset(to, 0, MONOMIALS * sizeof *to);
  memcpy(to, M + n * n, n * sizeof *to);
  return true;
}

gg_status gg_theory_rough_contacts_make(const gg_model *m, gg_rough_contacts *c, gg_error *err)
{
  gg_model *one = gg_base_array_new(1, sizeof *one, err); /* too large for small stacks */
  samples *s = gg_base_array_new(1, sizeof *s, err);
  double *M = gg_theory_linear_new(MONOMIALS);
  bool good = one && s && M;
  if (good) gg_theory_rough_contacts_model(m, one), take(one, s);
  for (int q = 0; q < GG_CONTACT_FUNCTIONS && good; q++)
    good = fit(s, 0, q, M, c->smooth[q]) && fit(s, 1, q, M, c->spins[q]);
  const bool room = one && s && M;
  free(one), free(s), free(M);
  if (!room) return gg_base_out_of_memory(err);
  return good ? GG_OK : gg_base_fail(err, GG_FAILED, "averages over contacts have no polynomials here");
}

void gg_theory_rough_contacts_at(const gg_rough_contacts *c, double ratio, gg_contact_series to)
{
  for (int q = 0; q < GG_CONTACT_FUNCTIONS; q++)
    for (int j = 0; j < MONOMIALS; j++) to[q][j] = c->smooth[q][j] + ratio * c->spins[q][j];
}

void gg_theory_rough_contacts_value(const gg_contact_series series, gg_contact_point p,
                                    double value[GG_CONTACT_FUNCTIONS])
{
  double x[2][MONOMIALS];
  const int n[2] = {monomials(0, p, x[0]), monomials(1, p, x[1])};
  for (int q = 0; q < GG_CONTACT_FUNCTIONS; q++) {
    const int odd = q >= GG_CONTACT_EVEN;
    value[q] = 0;
    for (int j = 0; j < n[odd]; j++) value[q] += series[q][j] * x[odd][j];
  }
}
