/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/noise_free_gas.h"

#include <math.h>

#include "theory/answer.h"
#include "theory/enskog_hermite.h"
#include "theory/theory_list.h"

/* The solutions: at chi = 1, these solid fractions and slopes of chi. */
static const double at_phi[] = {0.1, 0.4};

static double moving(const gg_model *m, double part)
{
  return 1 + part * (1 + m->e[0]) * gg_theory_phi_chi(m);
}

static gg_model model_at(const gg_model *m, double phi, double slope)
{
  gg_model to = *m;
  gg_common_model_set_pairs(&to);
  to.flow = GG_HCS, to.temperature0 = 1;
  if (m->boltzmann) return to;
  to.phi = phi, to.density = to.number_density[0] = 6 * phi / M_PI;
  to.chi[0] = 1, to.chi_slope = slope;
  return to;
}

/* a + b y through the values at two densities. */
static void line(const double value[2], double to[2])
{
  to[1] = (value[1] - value[0]) / (at_phi[1] - at_phi[0]), to[0] = value[0] - to[1] * at_phi[0];
}

/* mu_k, by its total. */
static double diffusive(const gg_model *m, const gg_theory_answer *a)
{
  return a->value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] / moving(m, 1.2);
}

gg_status gg_theory_noise_free_gas_make(const gg_model *m, gg_noise_free_gas *g, gg_error *err)
{
  double eta[2], kappa[2], mu[2], steeper[2];
  *g = (gg_noise_free_gas){0};
  for (int i = 0; i < 2; i++) {
    const gg_model flat = model_at(m, at_phi[i], 0), steep = model_at(m, at_phi[i], 1);
    gg_theory_answer a;
    const double *v = a.value, y = gg_theory_phi_chi(&flat), square = flat.phi * y;
    GG_TRY(gg_theory_evaluate(&gg_theory_enskog_hermite, &flat, &a, err));
    g->zeta = v[GG_Q_COOLING_RATE];
    g->eta[0] = eta[i] = v[GG_Q_VISCOSITY_REDUCED_KINETIC];
    g->kappa[0] = kappa[i] = v[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC];
    g->mu[0] = mu[i] = diffusive(&flat, &a);
    if (m->boltzmann) return GG_OK;
    g->bulk = (v[GG_Q_VISCOSITY_REDUCED] - eta[i] * moving(&flat, 0.8)) / square;
    g->collisional = (v[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] - kappa[i] * moving(&flat, 1.2)) / square;
    GG_TRY(gg_theory_enskog_hermite_conduct(&steep, &a, err));
    steeper[i] = diffusive(&steep, &a) - mu[i];
  }
  line(eta, g->eta), line(kappa, g->kappa), line(mu, g->mu), line(steeper, g->mu + 2);
  return GG_OK;
}

void gg_theory_noise_free_gas_at(const gg_noise_free_gas *g, const gg_model *m, gg_theory_answer *a)
{
  const double chi = m->chi[0], y = gg_theory_phi_chi(m), s = m->chi_slope, *mu = g->mu;
  const double eta = (g->eta[0] + g->eta[1] * y) / chi, kappa = (g->kappa[0] + g->kappa[1] * y) / chi;
  a->value[GG_Q_COOLING_RATE] = chi * g->zeta;
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = eta;
  a->value[GG_Q_VISCOSITY_REDUCED] = eta * moving(m, 0.8) + g->bulk * m->phi * y;
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC] = kappa;
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] = kappa * moving(m, 1.2) + g->collisional * m->phi * y;
  a->value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] =
      (mu[0] + mu[1] * y + s * (mu[2] + mu[3] * y)) / chi * moving(m, 1.2);
}
