/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/rough_moments.h"

#include <math.h>
#include <string.h>

enum { N = GG_ROUGH_UNKNOWNS, STEPS = 20 };

static const double difference = 1e-6, converged = 1e-12;

/* nu_0 chi at T = 1. */
static double rate_of(const gg_model *m)
{
  return 16. / 5 * sqrt(M_PI) * m->density * m->chi[0];
}

typedef struct moments {
  double left[N]; /* of the equations */
  double f[GG_CONTACT_FUNCTIONS];
  double S, xi; /* S/n; q_x/q_y */
} moments;

static void equations(gg_rough_moments *g, const gg_rough_state *s, const double x[N], moments *to)
{
  gg_theory_newtonian_gas_set(&g->gas.density, exp(x[GG_ROUGH_LOG_N]));
  const gg_model *m = &g->gas.density.model;
  const bool point = m->boltzmann;
  const double n = m->density, rate = n * m->chi[0], T = s->T, a = x[GG_ROUGH_SHEAR], root = sqrt(T);
  const double xx = x[GG_ROUGH_XX], yy = x[GG_ROUGH_YY], xy = x[GG_ROUGH_XY], carried = point ? 0 : n * rate;
  const double *f = to->f, w = s->omega + 0.5 * a * root;
  gg_theory_rough_contacts_value((const double(*)[GG_CONTACT_MONOMIALS])g->series,
                                 (gg_contact_point){xx, yy, xy, point ? 0 : a}, to->f);
  const double S = -a * xy + 0.5 * rate * (f[GG_CONTACT_XX] + f[GG_CONTACT_YY] + f[GG_CONTACT_ZZ]);
  const double xi = -1.4 * a / (rate_of(m) * g->heat_rate);
  to->left[0] = (-2 * a * xy - 0.4 * S) / rate + f[GG_CONTACT_XX];
  to->left[1] = -1.2 * S / rate + f[GG_CONTACT_YY];
  to->left[2] = (-a * (1 + yy) - 0.4 * xi * S) / rate + f[GG_CONTACT_XY];
  to->left[3] = T * (n * (1 + yy) + carried * f[GG_CONTACT_P_YY]) / s->P - 1;
  to->left[4] = T * (n * xy + carried * f[GG_CONTACT_P_YX]) - s->tau;
  if (!point) to->left[4] -= 2 * gg_theory_rough_fluid_grip(&g->gas, T) * w;
  to->left[4] /= s->P;
  to->S = S, to->xi = xi;
}

static gg_band_matrix matrix_of(gg_rough_moments *g)
{
  return (gg_band_matrix){.n = N, .below = N - 1, .above = N - 1, .pivot = g->pivot, .cell = g->cell};
}

static bool differentiate(gg_rough_moments *g, const gg_rough_state *s, const double x[N], const moments *here)
{
  gg_band_matrix J = matrix_of(g);
  memset(g->cell, 0, sizeof g->cell);
  for (int k = 0; k < N; k++) {
    double moved[N];
    moments there;
    memcpy(moved, x, sizeof moved), moved[k] += difference;
    equations(g, s, moved, &there);
    for (int i = 0; i < N; i++) *gg_band_at(&J, i, k) = (there.left[i] - here->left[i]) / difference;
  }
  return gg_theory_band_factor(&J);
}

/* Newton's method from x, with the last derivatives as long as they do: the next state is mostly very near. */
static bool improve(gg_rough_moments *g, const gg_rough_state *s, double x[N], bool derived, moments *at)
{
  const gg_band_matrix J = matrix_of(g);
  double last = INFINITY;
  for (int step = 0; step < STEPS; step++) {
    double d[N], most = 0;
    equations(g, s, x, at);
    if (!derived && !differentiate(g, s, x, at)) return false;
    memcpy(d, at->left, sizeof d);
    gg_theory_band_solve(&J, d);
    for (int k = 0; k < N; k++) most = fmax(most, fabs(d[k]));
    if (!isfinite(most)) return false;
    if (most <= converged) return true;
    const bool slow = derived && most > 0.1 * last; /* the derivatives are of another place */
    derived = derived && !slow && most < 0.1, last = most;
    if (slow) continue;
    const double part = fmin(1, 0.3 / most);
    for (int k = 0; k < N; k++) x[k] -= part * d[k];
  }
  return false;
}

/* The moments of a state; else, from the Newtonian gas. */
static bool solve(gg_rough_moments *g, const gg_rough_state *s, moments *at)
{
  double x[N];
  memcpy(x, g->x, sizeof x);
  bool good = g->known && improve(g, s, x, true, at);
  if (!good) {
    gg_rough_local newtonian;
    gg_theory_rough_fluid_local(&g->gas, s, &newtonian);
    memset(x, 0, sizeof x);
    x[GG_ROUGH_LOG_N] = log(newtonian.gas.n);
    x[GG_ROUGH_SHEAR] = fmax(-1.5, fmin(1.5, newtonian.gas.shear / sqrt(s->T)));
    good = improve(g, s, x, false, at);
  }
  g->known = good;
  memcpy(g->x, x, sizeof x);
  return good;
}

static void put_stress(gg_rough_moments *g, const gg_rough_state *s, const moments *now, gg_rough_local *at)
{
  const gg_model *m = &g->gas.density.model;
  const double n = m->density, T = s->T, xx = g->x[GG_ROUGH_XX], yy = g->x[GG_ROUGH_YY];
  const double carried = m->boltzmann ? 0 : n * n * m->chi[0] * T, *f = now->f;
  at->gas = (gg_gap_local){.n = n,
                           .phi = m->phi,
                           .shear = g->x[GG_ROUGH_SHEAR] * sqrt(T),
                           .Txx = T * (1 + xx),
                           .Tyy = T * (1 + yy),
                           .Tzz = T * (1 - xx - yy)};
  at->gas.xx = n * T * (xx - yy) + carried * (f[GG_CONTACT_P_XX] - f[GG_CONTACT_P_YY]);
  at->gas.zz = -n * T * (xx + 2 * yy) + carried * (f[GG_CONTACT_P_ZZ] - f[GG_CONTACT_P_YY]);
}

static void put_heat(const gg_rough_moments *g, const gg_rough_state *s, const moments *now, gg_rough_local *at)
{
  const gg_model *m = &g->gas.density.model;
  const gg_grain grain = g->gas.grain;
  const gg_lun_functions f =
      gg_theory_lun_functions_at((gg_lun_state){m->density, m->phi, m->chi[0], grain, s->theta / s->T});
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) at->heat[i][j] = sqrt(s->T) * f.f4[i][j];
  /* The share of the heat flux that grains carry (lun1991.c: c_0). */
  at->gas.carried_x = now->xi / (1 + 0.8 * gg_theory_phi_chi(m) * (3 * grain.eta1 + 2 * grain.eta2));
}

/* Torque and gain of energy of grains that roll, and what those add that do not. Rotation gains what translation and
 * the mean spin lose and contacts do not destroy, so that elastic grains keep their energy whatever the fit. */
static void put_gains(const gg_rough_moments *g, const gg_rough_state *s, const moments *now, gg_rough_local *at)
{
  const gg_model *m = &g->gas.density.model;
  const gg_grain grain = g->gas.grain;
  const bool point = m->boltzmann;
  const double n = m->density, T = s->T, rate = n * n * m->chi[0] * T, shear = at->gas.shear, *f = now->f;
  const double w = s->omega + (point ? 0 : 0.5 * shear), grip = 4 * gg_theory_rough_fluid_grip(&g->gas, T) * w;
  const double torque = point ? 0 : 0.5 * grain.K * rate * f[GG_CONTACT_SPIN];
  const double S = n * T * sqrt(T) * now->S, carried = point ? 0 : rate * f[GG_CONTACT_P_YX] * shear;
  const double gain = S + n * T * g->x[GG_ROUGH_XY] * shear + carried;
  at->torque = torque - grip;
  at->slides[0] = grip * w * grain.eta2, at->slides[1] = at->slides[0] / grain.K;
  at->gain[0] = s->tau * shear + S + at->slides[0];
  at->gain[1] =
      at->torque * s->omega + at->slides[1] - rate * sqrt(T) * f[GG_CONTACT_LOSS] - gain + 0.5 * torque * shear;
}

static bool local(gg_rough_fluid *gas, const gg_rough_state *s, gg_rough_local *at)
{
  gg_rough_moments *g = (gg_rough_moments *)gas;
  moments now;
  gg_theory_rough_contacts_at(&g->contacts, s->theta / s->T, g->series);
  g->heat_rate = gg_theory_heat_rates(gas->grain, s->theta / s->T).at[0][0];
  const bool good = solve(g, s, &now);
  put_stress(g, s, &now, at), put_heat(g, s, &now, at), put_gains(g, s, &now, at);
  at->turning = gg_theory_rough_fluid_turning(gas, s->T, at->gas.Tyy);
  return good && (gas->density.model.boltzmann || gas->density.model.phi < gas->density.most);
}

gg_status gg_theory_rough_moments_make(const gg_model *m, gg_rough_moments *g, gg_error *err)
{
  gg_theory_rough_fluid_make(m, &g->gas);
  GG_TRY(gg_theory_rough_contacts_make(m, &g->contacts, err));
  g->gas.local = local, g->known = false;
  return GG_OK;
}
