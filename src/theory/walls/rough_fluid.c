/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/rough_fluid.h"

#include <math.h>

void gg_theory_rough_fluid_make(const gg_model *m, gg_rough_fluid *g)
{
  gg_theory_newtonian_gas_make(m, &g->density);
  g->grain = gg_theory_grain_of(m), g->local = gg_theory_rough_fluid_local;
}

double gg_theory_rough_fluid_grip(const gg_rough_fluid *g, double T)
{
  const gg_model *m = &g->density.model;
  return g->grain.eta2 * m->density * m->density * m->chi[0] * sqrt(M_PI * T) / 3;
}

double gg_theory_rough_fluid_turning(const gg_rough_fluid *g, double T, double Tyy)
{
  const gg_model *m = &g->density.model;
  return 0.25 * g->grain.K * Tyy / (4. / 3 * sqrt(M_PI * T) * m->chi[0] * (2 + m->e[0] + m->beta[0]));
}

/* Coefficients at the density where P = T f1, and at theta/T. */
static bool functions_at(gg_rough_fluid *g, double P, double T, double ratio, gg_lun_functions *f, gg_gap_local *at)
{
  const bool within = gg_theory_newtonian_gas_find(&g->density, P / T);
  const gg_model *m = &g->density.model;
  *f = gg_theory_lun_functions_at((gg_lun_state){m->density, m->phi, m->chi[0], g->grain, ratio});
  *at = (gg_gap_local){.n = m->density, .phi = m->phi, .Txx = T, .Tyy = T, .Tzz = T};
  return within;
}

bool gg_theory_rough_fluid_local(gg_rough_fluid *g, const gg_rough_state *s, gg_rough_local *at)
{
  const double root = sqrt(s->T), h2 = g->grain.eta2;
  gg_lun_functions f;
  const bool within = functions_at(g, s->P, s->T, s->theta / s->T, &f, &at->gas), point = g->density.model.boltzmann;
  const double mu_r = gg_theory_rough_fluid_grip(g, s->T), of_flow = point ? 0 : mu_r;
  const double shear = at->gas.shear = -(s->tau + 2 * of_flow * s->omega) / (f.f2 * root + of_flow);
  const double w = s->omega + (point ? 0 : 0.5 * shear), taken = 4 * mu_r * w * w;
  at->slides[0] = taken * h2, at->slides[1] = taken * h2 / g->grain.K;
  at->torque = -4 * mu_r * w, at->turning = gg_theory_rough_fluid_turning(g, s->T, s->T);
  at->gain[0] = -2 * of_flow * w * shear + at->slides[0] - s->T * root * f.f5;
  at->gain[1] = at->torque * s->omega + at->slides[1] + s->T * root * f.f5r;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) at->heat[i][j] = root * f.f4[i][j];
  return within;
}

bool gg_theory_rough_fluid_rolling(void *self, double P, double tau, double T, gg_gap_local *at)
{
  gg_rough_fluid *g = self;
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
