/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smooth inelastic spheres, free cooling or heated, at all densities: V. Garzo & J.W. Dufty, Phys. Rev. E 59 (1999)
 * 5895; heated states V. Garzo & J.M. Montanero, Physica A 313 (2002) 336. With c = 2 a_2, nu_0 = nT/eta_0,
 * eta_0 = 5/(16 d^2) sqrt(m T/pi), rates and viscosities in units of those:
 *   zeta  = (5/12) chi (1-e^2)(1 + 3c/32),   nu_eta = chi [1 - (1-e)^2/4](1 - c/64)
 *   eta_k = [1 - 2/5 (1+e)(1-3e) phi chi]/(nu_eta - s zeta),  s = 1/2 cooling, 1 Gaussian thermostat, 0 white noise
 *   eta   = eta_k [1 + 4/5 (1+e) phi chi] + 3/5 kappa,   kappa = 128/(5 pi) phi^2 chi (1+e)(1 - c/32)
 *   p     = nT [1 + 2(1+e) phi chi]
 * Heat flux of a cooling gas, in units of kappa_0 = 15 nT/(4 m nu_0), with slope = d ln chi/d ln phi:
 *   nu_kappa = (1+e)/3 chi [1 + 33/16 (1-e) + (19-3e)/1024 c]
 *   kappa_k  = 2/3 {1 + c + 3/5 phi chi (1+e)^2 [2e-1 + (1+e) c/2]}/(nu_kappa - 2 zeta)
 *   kappa    = kappa_k [1 + 6/5 (1+e) phi chi] + 256/(25 pi) phi^2 chi (1+e)(1 - 7c/32)
 *   mu_k     = 2 {zeta kappa_k (1 + slope) + c/3 + 4/5 phi chi (1+e)(1 + slope/2)[e(e-1) + (16 - 3e + 3e^2) c/12]}
 *              /(2 nu_kappa - 3 zeta),   mu = mu_k [1 + 6/5 (1+e) phi chi]
 * Expansion: zeta_u = -2 phi chi (1-e^2) + (3/16) zeta_M b, where a_2 answers div u by b, with u = (1+e)/2,
 *   b = (8/5) phi chi u^2 [2(1-u)(5u-3) - a_2 (1 - 8u + 5u^2)]/(Gamma + zeta/2),
 *   Gamma = chi (1+e)[81 - 17e + 30 e^2 (1-e)]/192 the rate of a_2, zeta_M the cooling rate of a Maxwellian.
 * a_2 by T.P.C. van Noije & M.H. Ernst, Granular Matter 1 (1998) 57; collision rate and mean speed of that distribution
 * are those of a Maxwellian times 1 - a_2/16 and 1 - a_2/8.
 * Modified first Sonine: the weight of the expansion is the distribution of the cooling state itself, which makes
 * nu_eta = chi [1 - (1-e)^2/4](1 + 7c/32) and 947 - 579 e over 512 the factor of c in nu_kappa, with the a_2 of
 * Montanero & Santos: V. Garzo, A. Santos & J.M. Montanero, Physica A 376 (2007) 94. */
#include "theory/garzo_dufty1999.h"
#include "common/thermostat.h"

#include <math.h>

#include "theory/range.h"
#include "theory/theory_list.h"

static const char name[] = "garzo_dufty1999";

double gg_theory_a2_van_noije_ernst(double e)
{
  return 16 * (1 - e) * (1 - 2 * e * e) / (81 - 17 * e + 30 * e * e * (1 - e));
}

double gg_theory_a2_montanero_santos(double e)
{
  return 16 * (1 - e) * (1 - 2 * e * e) / (97 - 33 * e - 2 * e * e * (1 - e));
}

double gg_theory_a2_white_noise(double e)
{
  return 16 * (1 - e) * (1 - 2 * e * e) / (241 - 177 * e + 30 * e * e * (1 - e));
}

double gg_theory_thermostat_factor(const gg_model *m)
{
  static const double share[] = {[GG_UNHEATED] = 0.5, [GG_HEAT_SCALES] = 1, [GG_HEAT_KICKS] = 0, [GG_HEAT_BATHES] = 0};
  if (m->wave > 0 && gg_common_keeps_energy(m)) return share[GG_UNHEATED]; /* see measure/shear_wave.c */
  return share[gg_common_heat_of(m)];
}

/* White noise is set to balance Maxwellians at temperature0 (thermostat.h), which lose less by 1 + 3c/32. */
static double temperature_of(const gg_model *m, double a2)
{
  return m->temperature0 * (gg_common_heat_of(m) == GG_HEAT_KICKS ? pow(1 + 3. / 16 * a2, -2. / 3) : 1);
}

void gg_theory_answer_sonine(const gg_model *m, double T, double a2, gg_theory_answer *a)
{
  double e = m->e[0], p = m->density * T, pc = p * 2 * (1 + e) * gg_theory_phi_chi(m);
  a->value[GG_Q_A2] = a2;
  a->value[GG_Q_KURTOSIS_CX] = a->value[GG_Q_KURTOSIS_CY] = a->value[GG_Q_KURTOSIS_CZ] = 3 * (1 + a2);
  a->value[GG_Q_COOLING_RATE] = 5. / 12 * m->chi[0] * (1 - e * e) * (1 + 3. / 16 * a2);
  if (m->linear_response) return; /* T grows with time: no value */
  gg_theory_answer_temperature(m, T, NAN, a);
  gg_theory_answer_pressure(m, T, p, pc, a);
  gg_theory_answer_collisions_one(m, T, a);
  double rate = 1 - a2 / 16, speed = 1 - a2 / 8;
  a->value[GG_Q_COLLISION_RATE] *= rate;
  a->value[GG_Q_MEAN_FREE_PATH] *= speed / rate;
  a->value[GG_Q_KNUDSEN] *= speed / rate;
}

/* `weight`: nu_eta is Maxwellians' times 1 + weight a_2. */
static void answer_viscosity(const gg_model *m, double a2, double weight, gg_theory_answer *a)
{
  double e = m->e[0], y = gg_theory_phi_chi(m);
  double nu = m->chi[0] * (1 - (1 - e) * (1 - e) / 4) * (1 + weight * a2);
  double eta_k =
      (1 - 0.4 * (1 + e) * (1 - 3 * e) * y) / (nu - gg_theory_thermostat_factor(m) * a->value[GG_Q_COOLING_RATE]);
  double bulk = gg_theory_bulk_viscosity(m, 1 - a2 / 16);
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = eta_k;
  a->value[GG_Q_VISCOSITY_REDUCED] = eta_k * (1 + 0.8 * (1 + e) * y) + 0.6 * bulk;
  if (!m->boltzmann) a->value[GG_Q_BULK_VISCOSITY_REDUCED] = bulk;
}

/* Heat flux of a cooling gas; `weight`: coefficient of a_2 in nu_kappa. */
static void answer_heat(const gg_model *m, double a2, double weight, gg_theory_answer *a)
{
  double e = m->e[0], y = gg_theory_phi_chi(m), c = 2 * a2, zeta = a->value[GG_Q_COOLING_RATE], slope = m->chi_slope;
  double nu = (1 + e) / 3 * m->chi[0] * (1 + 33. / 16 * (1 - e) + weight * a2);
  double collisional = 1 + 1.2 * (1 + e) * y;
  double kappa = 2. / 3 * (1 + c + 0.6 * y * (1 + e) * (1 + e) * (2 * e - 1 + (1 + e) * c / 2)) / (nu - 2 * zeta);
  double density = 0.8 * y * (1 + e) * (1 + slope / 2) * (e * (e - 1) + (16 - 3 * e + 3 * e * e) * c / 12);
  double mu = 2 * (zeta * kappa * (1 + slope) + c / 3 + density) / (2 * nu - 3 * zeta);
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC] = kappa;
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] =
      kappa * collisional + 256 / (25 * M_PI) * m->phi * y * (1 + e) * (1 - 7. / 32 * c);
  a->value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] = mu * collisional;
}

static void answer_expansion(const gg_model *m, double a2, gg_theory_answer *a)
{
  double e = m->e[0], u = (1 + e) / 2, chi = m->chi[0], y = gg_theory_phi_chi(m);
  double rate = chi * (1 + e) * (81 - 17 * e + 30 * e * e * (1 - e)) / 192, maxwellian = 5. / 12 * chi * (1 - e * e);
  double response = 1.6 * y * u * u * (2 * (1 - u) * (5 * u - 3) - a2 * (1 - 8 * u + 5 * u * u)) /
                    (rate + a->value[GG_Q_COOLING_RATE] / 2);
  a->value[GG_Q_COOLING_RATE_TRANSPORT] = -2 * y * (1 - e * e) + 3. / 16 * maxwellian * response;
}

/* All answers, with a_2 and its weight in the rates by either order. */
static void answer_all(const gg_model *m, double a2, bool modified, gg_theory_answer *a)
{
  const double e = m->e[0];
  gg_theory_answer_sonine(m, temperature_of(m, a2), a2, a);
  answer_viscosity(m, a2, modified ? 7. / 16 : -1. / 32, a);
  if (m->flow != GG_HCS) return;
  if (!m->boltzmann) answer_expansion(m, a2, a);
  answer_heat(m, a2, modified ? (947 - 579 * e) / 256 : (19 - 3 * e) / 512, a);
  gg_theory_answer_critical_lengths(m, 0, a);
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  GG_TRY(gg_theory_require_smooth(m, name, err));
  bool noisy = gg_common_heat_of(m) == GG_HEAT_KICKS;
  double a2 = noisy ? gg_theory_a2_white_noise(m->e[0]) : gg_theory_a2_van_noije_ernst(m->e[0]);
  answer_all(m, a2, false, a);
  return GG_OK;
}

const gg_theory gg_theory_garzo_dufty1999 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .title = "Cooling and viscosity of smooth inelastic spheres",
    .citation =
        "V. Garzo and J.W. Dufty, Phys. Rev. E 59 (1999) 5895; V. Garzo and J.M. Montanero, Physica A 313 (2002) "
        "336",
    .answers = "temperature pressure compressibility_factor " GG_ANSWERS_RATES GG_ANSWERS_KURTOSES
               "cooling_rate a2 " GG_ANSWERS_VISCOSITY GG_ANSWERS_HEAT GG_ANSWERS_EXPANSION GG_ANSWERS_LENGTHS,
    .assumptions = "Cooling or heated state (Gaussian thermostat or white noise) of one species of smooth spheres, any "
                   "density with molecular chaos. Viscosity of linear response, in units of eta_0 = n T/nu_0. First "
                   "Sonine order, linear in a2 (van Noije and Ernst 1998).",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_first_sonine,
};

static const char name_ms[] = "montanero_santos2000";

static gg_status with_other_a2(const gg_model *m, const char *theory, bool modified, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, theory, err));
  GG_TRY(gg_theory_require_smooth(m, theory, err));
  if (gg_common_heat_of(m) == GG_HEAT_KICKS)
    return gg_theory_reject(err, theory,
                            "is given here for free cooling and the Gaussian thermostat; this scene is heated by "
                            "white noise");
  answer_all(m, gg_theory_a2_montanero_santos(m->e[0]), modified, a);
  return GG_OK;
}

static gg_status evaluate_ms(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return with_other_a2(m, name_ms, false, a, err);
}

static const char name_modified[] = "garzo_santos_montanero2007";

static gg_status evaluate_modified(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return with_other_a2(m, name_modified, true, a, err);
}

const gg_theory gg_theory_montanero_santos2000 = {
    .name = name_ms,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .title = "Fourth cumulant, the other linearisation",
    .citation = "J.M. Montanero and A. Santos, Granular Matter 2 (2000) 53",
    .answers = "temperature pressure compressibility_factor " GG_ANSWERS_RATES GG_ANSWERS_KURTOSES
               "cooling_rate a2 " GG_ANSWERS_VISCOSITY GG_ANSWERS_HEAT GG_ANSWERS_EXPANSION GG_ANSWERS_LENGTHS,
    .assumptions = "As garzo_dufty1999 for the cooling state, but the fourth-moment equation is divided by 1 + a2 "
                   "before it is linearised: closer to simulations for e below 0.7.",
    .evaluate = evaluate_ms,
};

const gg_theory gg_theory_garzo_santos_montanero2007 = {
    .name = name_modified,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .title = "Viscosity about the cooling state's own distribution",
    .citation = "V. Garzo, A. Santos and J.M. Montanero, Physica A 376 (2007) 94",
    .answers = "temperature pressure compressibility_factor " GG_ANSWERS_RATES GG_ANSWERS_KURTOSES
               "cooling_rate a2 " GG_ANSWERS_VISCOSITY GG_ANSWERS_HEAT GG_ANSWERS_EXPANSION GG_ANSWERS_LENGTHS,
    .assumptions = "As montanero_santos2000, but the first Sonine term multiplies the distribution of the cooling "
                   "state instead of a Maxwellian: closer to simulations for e below 0.7. Derived for one species in "
                   "the cooling state, used for the heated state, too.",
    .evaluate = evaluate_modified,
};
