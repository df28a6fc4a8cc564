/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transport of rough grains that cool freely, dilute: G.M. Kremer, A. Santos & V. Garzo, Phys. Rev. E 90 (2014) 022205,
 * first Sonine order, Maxwellian spins. Translation and rotation cool alike, at the rate zeta, at r = theta/T of the
 * cooling state; in units of nu_0 = (16/5) sqrt(pi) n d^2 chi sqrt(T) and eta_0 = n T/nu_0:
 *   zeta   = 5/3 [eta_1 (1 - eta_1) + eta_2 (1 - eta_2) - eta_2^2 r/K]
 *   nu_eta = (eta_1 + eta_2)(2 - eta_1 - eta_2) + eta_2^2 r/(6K)
 *   eta    = 1/(nu_eta - zeta/2)
 *   kappa  = (rate - 2 zeta)^-1 (2/3, 2r/5),   mu = (rate - 3/2 zeta)^-1 zeta kappa
 *   eta_b  = 2/3 r/(1 + r)/(Lambda + zeta/2),  Lambda = d(zeta_r - zeta_t)/d ln r = 5/3 (eta_2/K)^2 (K r + K/r)
 * kappa, mu: of translation and rotation (rate: lun1991.c) along -grad T, with theta = r T, in 15/4 eta_0.
 * zeta/2 since eta goes as sqrt(T), which falls. Elastic and perfectly rough: 6 (1 + K)^2/(6 + 13 K) (F.B. Pidduck,
 * Proc. R. Soc. A 101 (1922) 101), also of kappa and eta_b = (1 + K)^2/(10 K): Chapman & Cowling, 11.62. */
#include <math.h>

#include "theory/answer.h"
#include "theory/lun1991.h"
#include "theory/range.h"
#include "theory/theory_list.h"
#include "theory/two_maxwellian.h"

static const char name[] = "kremer_santos_garzo2014";

static gg_status check(const gg_model *m, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  GG_TRY(gg_theory_require_constant_beta(m, name, err));
  GG_TRY(gg_theory_require_dilute(m, name, err));
  if (m->thermostat != GG_NO_THERMOSTAT)
    return gg_theory_reject(err, name, "describes gases that cool freely; this scene has a thermostat");
  if (m->rule == GG_SMOOTH)
    return gg_theory_reject(err, name,
                            "describes rough grains; for the smooth ones of this scene there is garzo_dufty1999");
  return GG_OK;
}

static void answer_heat(gg_model m, gg_grain g, double ratio, double zeta, gg_theory_answer *a)
{
  const gg_heat_rates rate = gg_theory_heat_rates(g, ratio);
  const double streaming[2] = {2. / 3, 0.4 * ratio}, chi = m.chi[0], share = g.eta2 / g.K;
  const double slowing = 5. / 3 * share * share * g.K * (ratio + 1 / ratio);
  double kappa[2], mu[2];
  a->value[GG_Q_BULK_VISCOSITY_REDUCED] = 2. / 3 * ratio / (1 + ratio) / (chi * (slowing + zeta / 2));
  if (!gg_theory_heat_flux(rate, 2 * zeta, streaming, kappa)) return;
  if (!gg_theory_heat_flux(rate, 1.5 * zeta, (double[]){zeta * kappa[0], zeta * kappa[1]}, mu)) return;
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] = a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC] = kappa[0] / chi;
  a->value[GG_Q_ROTATIONAL_CONDUCTIVITY_REDUCED] = kappa[1] / chi;
  a->value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] = mu[0] / chi;
  a->value[GG_Q_ROTATIONAL_DIFFUSIVE_CONDUCTIVITY_REDUCED] = mu[1] / chi;
  m.phi = m.chi_slope = 0; /* an ideal gas */
  gg_theory_answer_critical_lengths(&m, ratio, a);
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(check(m, err));
  const gg_grain g = gg_theory_grain_of(m);
  double ratio = gg_theory_ratio_cooling(g, INFINITY), h = g.eta1 + g.eta2, chi = m->chi[0];
  double zeta = m->elastic ? 0 : 5. / 12 * gg_theory_cooling_at(g, INFINITY, ratio);
  double nu = h * (2 - h) + g.eta2 * g.eta2 * ratio / (6 * g.K);
  if (!(nu > zeta / 2))
    return gg_theory_reject(err, name, "finds no viscosity: grains cool faster than stress relaxes");
  a->value[GG_Q_TEMPERATURE_RATIO] = ratio;
  a->value[GG_Q_COOLING_RATE] = chi * zeta;
  a->value[GG_Q_VISCOSITY_REDUCED] = a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = 1 / (chi * (nu - zeta / 2));
  if (!gg_flow_cools(m->flow)) return GG_OK; /* a sheared gas has no initial temperature */
  gg_theory_answer_temperature(m, m->temperature0, ratio, a);
  answer_heat(*m, g, ratio, zeta, a);
  return GG_OK;
}

static const char *beyond(const gg_model *m)
{
  if (m->beta[0] > 0.75)
    return "spins under shear go with velocities, which first Sonine order leaves out (6 % at beta = 1)";
  return gg_theory_beyond_gaussian(m);
}

const gg_theory gg_theory_kremer_santos_garzo2014 = {
    .name = name,
    .title = "Cooling, viscosities and heat flux of rough grains",
    .citation = "G.M. Kremer, A. Santos and V. Garzo, Phys. Rev. E 90 (2014) 022205",
    .answers = "temperature rotational_temperature temperature_ratio cooling_rate " GG_ANSWERS_VISCOSITY GG_ANSWERS_HEAT
               "rotational_conductivity_reduced rotational_diffusive_conductivity_reduced "
               "bulk_viscosity_reduced " GG_ANSWERS_LENGTHS,
    .assumptions = "Free cooling of a dilute gas (Boltzmann's equation, phi up to 0.05) of one species of rough grains "
                   "with constant beta. Viscosity of linear response, in units of eta_0 = n T/nu_0: within 2 % of "
                   "Boltzmann's equation at e = 0.8-0.9 and beta up to 0.5, 6 % low for perfectly rough grains. First "
                   "Sonine order, spins Maxwellian and independent of velocities.",
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .evaluate = evaluate,
    .beyond = beyond,
};
