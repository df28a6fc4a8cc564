/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/rough_gas.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void gg_theory_rough_gas_make(const gg_model *m, gg_rough_gas *g)
{
  gg_theory_newtonian_gas_make(m, &g->density);
  g->grain = gg_theory_grain_of(m), g->contacts = NULL;
}

/* Coefficients at the density where P = T f1, and at theta/T. */
static bool functions_at(gg_rough_gas *g, double P, double T, double ratio, gg_lun_functions *f, gg_gap_local *at)
{
  const bool within = gg_theory_newtonian_gas_find(&g->density, P / T);
  const gg_model *m = &g->density.model;
  *f = gg_theory_lun_functions_at((gg_lun_state){m->density, m->phi, m->chi[0], g->grain, ratio});
  *at = (gg_gap_local){.n = m->density, .phi = m->phi, .Txx = T, .Tyy = T, .Tzz = T};
  return within;
}

enum { LOG_N, SHEAR, XX, YY, XY, UNKNOWNS };

typedef struct mom { double left[UNKNOWNS], f[GG_CONTACT_FUNCTIONS], S, xi, n, chi, a; } mom;

static void equations(gg_rough_gas *g, const gg_rough_state *s, const double x[UNKNOWNS], mom *to)
{
  gg_theory_newtonian_gas_set(&g->density, exp(x[LOG_N]));
  const gg_model *m = &g->density.model;
  const double n = m->density, chi = m->chi[0], rate = n * chi, T = s->T, a = x[SHEAR], root = sqrt(T);
  const bool point = m->boltzmann;
  gg_theory_rough_contacts_value(g->coefficient, (gg_rough_point){x[XX], x[YY], x[XY], point ? 0 : a}, to->f);
  const double *f = to->f, Myy = 1 + x[YY], Mxy = x[XY];
  const double S = -a * Mxy + 0.5 * rate * (f[GG_CONTACT_XX] + f[GG_CONTACT_YY] + f[GG_CONTACT_ZZ]);
  const double W = a / (16. / 5 * sqrt(M_PI) * rate * g->heat_rate);
  double xi = -1.4 * W;
  const double ryy = 1.5 * Myy + Myy * Myy + Mxy * Mxy, rxy = Mxy * (1.5 + 2 + x[XX] + x[YY]);
  if (getenv("XI")) xi = rxy * (1 - 0.56 * W * W) / (ryy - 0.4 * W * rxy) - 1.4 * W;
  if (getenv("XI0")) xi = 0;
  const double mu_r = g->grain.eta2 * n * n * chi * sqrt(M_PI) / 3;
  to->left[0] = -2 * a * Mxy / rate + f[GG_CONTACT_XX] - 0.4 * S / rate;
  to->left[1] = f[GG_CONTACT_YY] - 1.2 * S / rate;
  to->left[2] = -a * Myy / rate + f[GG_CONTACT_XY] - 0.4 * xi * S / rate;
  const double c = point ? 0 : n * n * chi;
  to->left[3] = (n * Myy + c * f[GG_CONTACT_P_YY]) * T / s->P - 1;
  to->left[4] = ((n * Mxy + c * f[GG_CONTACT_P_YX]) * T - (point ? 0 : 2 * mu_r * root * (s->omega + 0.5 * a * root)) - s->tau) / s->P;
  to->S = S, to->xi = xi, to->n = n, to->chi = chi, to->a = a;
}

static bool solve5(double A[UNKNOWNS][UNKNOWNS], double b[UNKNOWNS])
{
  for (int k = 0; k < UNKNOWNS; k++) {
    int p = k;
    for (int i = k + 1; i < UNKNOWNS; i++) if (fabs(A[i][k]) > fabs(A[p][k])) p = i;
    for (int j = 0; j < UNKNOWNS; j++) { const double t = A[k][j]; A[k][j] = A[p][j], A[p][j] = t; }
    const double t = b[k]; b[k] = b[p], b[p] = t;
    if (A[k][k] == 0) return false;
    for (int i = k + 1; i < UNKNOWNS; i++) {
      const double f = A[i][k] / A[k][k];
      for (int j = k; j < UNKNOWNS; j++) A[i][j] -= f * A[k][j];
      b[i] -= f * b[k];
    }
  }
  for (int k = UNKNOWNS - 1; k >= 0; k--) {
    for (int j = k + 1; j < UNKNOWNS; j++) b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
  return true;
}

static bool newton5(gg_rough_gas *g, const gg_rough_state *s, double x[UNKNOWNS], mom *now)
{
  for (int step = 0; step < 40; step++) {
    double J[UNKNOWNS][UNKNOWNS], d[UNKNOWNS], most = 0;
    mom up;
    equations(g, s, x, now);
    for (int k = 0; k < UNKNOWNS; k++) {
      const double keep = x[k], h = 1e-6;
      x[k] = keep + h, equations(g, s, x, &up), x[k] = keep;
      for (int j = 0; j < UNKNOWNS; j++) J[j][k] = (up.left[j] - now->left[j]) / h;
      d[k] = now->left[k];
    }
    if (!solve5(J, d)) return false;
    for (int k = 0; k < UNKNOWNS; k++) most = fmax(most, fabs(d[k]));
    if (!isfinite(most)) return false;
    const double part = fmin(1, 0.3 / most);
    for (int k = 0; k < UNKNOWNS; k++) x[k] -= part * d[k];
    if (most < 1e-11) { equations(g, s, x, now); return true; }
  }
  return false;
}

bool gg_theory_rough_gas_local(gg_rough_gas *g, const gg_rough_state *s, gg_rough_local *at)
{
  const gg_model *m = &g->density.model;
  const double root = sqrt(s->T), K = g->grain.K, h2 = g->grain.eta2, e = m->e[0], beta = m->beta[0];
  gg_lun_functions f;
  bool within = functions_at(g, s->P, s->T, s->theta / s->T, &f, &at->gas);
  double n = m->density, chi = m->chi[0], mu_r = h2 * n * n * chi * sqrt(M_PI) / 3 * root;
  double of_flow = m->boltzmann ? 0 : mu_r;
  at->gas.shear = -(s->tau + 2 * of_flow * s->omega) / (f.f2 * root + of_flow);
  double S = 0, gain_r = s->T * root * f.f5r, torque = 0;
  mom now;
  if (g->contacts) {
    const double r = s->theta / s->T;
    double x[UNKNOWNS] = {log(n), at->gas.shear / root, 0, 0, 0};
    gg_theory_rough_contacts_at(g->contacts, r, g->coefficient);
    g->heat_rate = gg_theory_heat_rates(g->grain, r).at[0][0];
    bool good = false;
    if (g->warm) {
      double y[UNKNOWNS];
      memcpy(y, g->last, sizeof y);
      good = newton5(g, s, y, &now);
      if (good) memcpy(x, y, sizeof x);
    }
    if (!good) {
      const double lim = fmax(-1.5, fmin(1.5, x[SHEAR]));
      x[SHEAR] = lim;
      good = newton5(g, s, x, &now);
    }
    g->warm = good;
    memcpy(g->last, x, sizeof x);
    within = within && good;
    n = now.n, chi = now.chi;
    const double T = s->T, c = m->boltzmann ? 0 : n * n * chi * T, y = m->phi * chi;
    at->gas = (gg_gap_local){.n = n, .phi = m->phi, .shear = now.a * root, .Txx = T * (1 + x[XX]), .Tyy = T * (1 + x[YY]), .Tzz = T * (1 - x[XX] - x[YY])};
    at->gas.xx = n * T * (x[XX] - x[YY]) + c * (now.f[GG_CONTACT_P_XX] - now.f[GG_CONTACT_P_YY]);
    at->gas.zz = -n * T * (x[XX] + 2 * x[YY]) + c * (now.f[GG_CONTACT_P_ZZ] - now.f[GG_CONTACT_P_YY]);
    mu_r = h2 * n * n * chi * sqrt(M_PI) / 3 * root, of_flow = m->boltzmann ? 0 : mu_r;
    S = n * T * root * now.S;
    gain_r = 0.5 * K * n * n * chi * T * root * now.f[GG_CONTACT_SPINS];
    torque = m->boltzmann ? 0 : 0.5 * K * n * n * chi * T * now.f[GG_CONTACT_SPIN];
    f = gg_theory_lun_functions_at((gg_lun_state){n, m->phi, chi, g->grain, r});
    const double hh = 1 / (1 + 0.8 * y * (3 * g->grain.eta1 + 2 * h2));
    if (!getenv("NOQX")) at->gas.carried_x = now.xi * hh;
    const double nu = 16. / 5 * sqrt(M_PI) * n * chi * ((g->grain.eta1 + h2) * (2 - g->grain.eta1 - h2) + h2 * h2 * r / (6 * K));
    double q = hh * hh * now.S / nu, fac = q > 0 ? 1 / (1 + 8.8 * q) : 1;
    if (getenv("NOFAC")) fac = 1;
    const double W = now.a / (16. / 5 * sqrt(M_PI) * n * chi * g->heat_rate), Myy = 1 + x[YY], Mxy = x[XY];
    const double ryy = 1.5 * Myy + Myy * Myy + Mxy * Mxy, rxy = Mxy * (1.5 + 2 + x[XX] + x[YY]);
    double F = (ryy - 0.4 * W * rxy) / (2.5 * (1 - 0.56 * W * W));
    if (getenv("NOF")) F = 1;
    const double tr = 24 / pow(M_PI, 1.5) * m->phi * m->phi * chi * (g->grain.eta1 + h2);
    f.f4[0][0] = tr + (f.f4[0][0] - tr) * F * fac, f.f4[0][1] *= F * fac;
  }
  const double w = s->omega + (m->boltzmann ? 0 : 0.5 * at->gas.shear), slides = 4 * mu_r * w * w;
  at->torque = torque - 4 * mu_r * w;
  at->turning = 0.25 * K * root / (4. / 3 * sqrt(M_PI) * chi * (2 + e + beta)) * (getenv("NOTYY") ? 1 : at->gas.Tyy / s->T);
  at->gain[0] = g->contacts ? s->tau * at->gas.shear + S + slides * h2 : -2 * of_flow * w * at->gas.shear + slides * h2 - s->T * root * f.f5;
  at->gain[1] = at->torque * s->omega + slides * h2 / K + gain_r;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) at->heat[i][j] = root * f.f4[i][j];
  return within;
}

bool gg_theory_rough_gas_rolling(void *self, double P, double tau, double T, gg_gap_local *at)
{
  gg_rough_gas *g = self;
  const double ratio = gg_theory_lun_ratio(g->grain), root = sqrt(T);
  gg_lun_functions f;
  const bool within = functions_at(g, P, T, ratio, &f, at);
  const gg_model *m = &g->density.model;
  const double Z = f.f1 / m->density, slope = m->boltzmann ? 1 : 1 + (Z - 1) * (2 + m->chi_slope);
  at->shear = -tau / (root * f.f2);
  at->n_P = 1 / (T * slope), at->n_T = -P / (T * T * slope);
  at->kappa = root * (f.f4[0][0] + ratio * f.f4[0][1] + f.f4[1][0] + ratio * f.f4[1][1]);
  at->loss = T * root * (f.f5 - f.f5r);
  return within;
}
