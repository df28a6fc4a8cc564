/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/newtonian_gas.h"

#include <math.h>

#include "common/contact_value.h"
#include "theory/answer.h"
#include "theory/theory_list.h"

static void set_density(gg_model *m, double n)
{
  if (m->boltzmann) return;
  m->density = m->number_density[0] = n, m->phi = n * M_PI / 6;
  gg_common_model_set_pairs(m);
}

void gg_theory_newtonian_gas_set(gg_newtonian_gas *g, double n)
{
  set_density(&g->model, n);
  if (g->model.boltzmann) g->model.density = n;
}

static void put_coefficients(gg_newtonian_gas *g)
{
  if (g->noise_free)
    gg_theory_noise_free_gas_at(&g->series, &g->model, &g->answer);
  else
    gg_theory_garzo_santos_montanero2007.evaluate(&g->model, &g->answer, NULL);
}

void gg_theory_newtonian_gas_at(gg_newtonian_gas *g, double n)
{
  set_density(&g->model, n);
  put_coefficients(g);
}

static double Z_of(const gg_model *m)
{
  return 1 + 2 * (1 + m->e[0]) * gg_theory_phi_chi(m);
}

/* By Newton's method: n Z is convex in n. */
bool gg_theory_newtonian_gas_find(gg_newtonian_gas *g, double x)
{
  const double most = g->most * 6 / M_PI;
  gg_model *m = &g->model;
  if (m->boltzmann) {
    m->density = x;
    return true;
  }
  double n = fmin(x, most);
  for (int k = 0; k < 60; k++) {
    set_density(m, n);
    const double Z = Z_of(m), slope = 1 + (Z - 1) * (2 + m->chi_slope), step = (x - n * Z) / slope;
    n = fmin(n + step, most);
    if (fabs(step) <= 1e-15 * n || (n == most && step > 0)) break;
  }
  set_density(m, n);
  return n < most;
}

bool gg_theory_newtonian_gas_local(void *self, double P, double tau, double T, gg_gap_local *at)
{
  gg_newtonian_gas *g = self;
  const gg_model *m = &g->model;
  const double *v = g->answer.value, c0 = 5 / (16 * sqrt(M_PI)), root = sqrt(T);
  const bool within = gg_theory_newtonian_gas_find(g, P / T);
  put_coefficients(g);
  const double n = m->density, slope = m->boltzmann ? 1 : 1 + (Z_of(m) - 1) * (2 + m->chi_slope);
  const double viscosity = c0 * root * v[GG_Q_VISCOSITY_REDUCED];
  *at = (gg_gap_local){
      .n = n,
      .phi = m->phi,
      .shear = -tau / viscosity,
      .n_P = 1 / (T * slope),
      .n_T = -P / (T * T * slope),
      .kappa = 3.75 * c0 * root * v[GG_Q_THERMAL_CONDUCTIVITY_REDUCED],
      .mu = 3.75 * c0 * root * T * v[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] / n,
      .loss = 1.5 * n * n * T * root * v[GG_Q_COOLING_RATE] / c0,
      .Txx = T,
      .Tyy = T,
      .Tzz = T,
  };
  return within;
}

void gg_theory_newtonian_gas_make(const gg_model *m, gg_newtonian_gas *g)
{
  g->model = *m;
  g->model.flow = GG_HCS, g->model.temperature0 = 1, g->model.rule = GG_SMOOTH;
  g->noise_free = false;
  g->most = gg_common_contact_value_limit(m->contact_value);
}
