/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog's equation itself, solved without random numbers: an expansion of the distribution about an anisotropic
 * Gaussian, all collision integrals by quadrature, the steady state by Newton's method (theory/hermite). The degree
 * grows step by step, so that each number has its distance from the limit as its error. Rough and frictional grains:
 * theory/rough. */
#include <math.h>

#include "theory/answer.h"
#include "theory/enskog_hermite.h"
#include "theory/garzo_dufty1999.h"
#include "theory/hermite/heat.h"
#include "theory/hermite/isotropic.h"
#include "theory/hermite/order_convergence.h"
#include "theory/hermite/viscosity.h"
#include "theory/spin_escape.h"
#include "theory/theory_list.h"

static const char name[] = "enskog_hermite";

/* Degrees of the isotropic state. */
enum { FIRST_DEGREE = 4, GOOD_DEGREE = 10, LAST_DEGREE = 18, VISCOSITY_DEGREE = 8 };
static const double good = 1e-8;

/* Cooling rate, in units of the collision frequency, below which its relative error is not counted: for elastic
 * grains the rate is 0. */
static const double hardly = 1e-6;

static void answer_flights(const gg_model *m, double rate, double speed, gg_theory_answer *a)
{
  a->value[GG_Q_COLLISION_RATE] = rate;
  a->value[GG_Q_MEAN_FREE_PATH] = speed / rate;
  if (!m->boltzmann) a->value[GG_Q_KNUDSEN] = speed / rate / m->length;
}

static double fourth(const double C[3])
{
  double square = C[0] * C[0] + C[1] * C[1] + C[2] * C[2];
  return square * square;
}

/* White noise is set to balance Maxwellians at temperature0 (thermostat.h). */
static double temperature_of(const gg_model *m, const gg_hermite_isotropic *h, const gg_heating *heating)
{
  double e = m->e[0], maxwellian = 5. / 12 * m->chi[0] * (1 - e * e) * gg_common_model_nu0(m, 1);
  bool balanced = heating->kind == GG_HEATING_NOISE && h->cooling_rate > 0 && !m->elastic;
  double T = m->temperature0 * (balanced ? pow(maxwellian / h->cooling_rate, 2. / 3) : 1);
  return gg_theory_heating_temperature(heating, h->heating, T);
}

static void answer_isotropic(const gg_model *m, gg_hermite_isotropic *h, const gg_heating *heating, gg_theory_answer *a)
{
  gg_hermite_sums sums;
  gg_hermite_sums_at(&h->op, &h->gas, &h->state, &sums);
  double a2 = gg_hermite_mean(&h->op.basis, &h->state, fourth) / 15 - 1;
  a->value[GG_Q_A2] = a2;
  a->value[GG_Q_KURTOSIS_CX] = a->value[GG_Q_KURTOSIS_CY] = a->value[GG_Q_KURTOSIS_CZ] = 3 * (1 + a2);
  a->value[GG_Q_COOLING_RATE] = m->elastic ? 0 : h->cooling_rate / gg_common_model_nu0(m, 1);
  if (m->linear_response) return; /* no temperature of its own: it grows */
  double T = temperature_of(m, h, heating), p = m->density * T;
  gg_theory_answer_temperature(m, T, NAN, a);
  gg_theory_answer_pressure(m, T, p, p * sums.transfer[2][2] / 3, a); /* one direction for all: the trace */
  answer_flights(m, sums.rate * sqrt(T), sums.speed * sqrt(T), a);
  if (!m->boltzmann)
    a->value[GG_Q_BULK_VISCOSITY_REDUCED] =
        gg_theory_bulk_viscosity(m, sums.rate / gg_common_model_collision_rate(m, 1));
}

static gg_status answer_viscosity(const gg_model *m, gg_hermite_isotropic *h, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_viscosity v;
  double fading = gg_theory_thermostat_factor(m) == 0.5 ? h->cooling_rate / 2 : 0, nu0 = gg_common_model_nu0(m, 1);
  GG_TRY(gg_hermite_viscosity_of(&h->gas, &h->state, h->op.basis.degree, !m->boltzmann, fading, &v, err));
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = v.kinetic * nu0;
  a->value[GG_Q_VISCOSITY_REDUCED] = v.total * nu0;
  return GG_OK;
}

/* In units of 15/(4 nu_0), at n = T = m = 1. */
static gg_status answer_heat(const gg_model *m, const gg_hermite_isotropic *h, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_heat heat;
  gg_hermite_density density = {m->boltzmann ? 0 : gg_theory_phi_chi(m), m->chi_slope};
  double unit = 15 / (4 * gg_common_model_nu0(m, 1));
  GG_TRY(gg_hermite_heat_of(h, density, &heat, err));
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] = heat.conductivity / unit;
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC] = heat.conductivity_kinetic / unit;
  a->value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] = m->elastic ? 0 : heat.diffusive / unit;
  return GG_OK;
}

/* Degree after degree: the series of the heat flux needs all available degrees. */
gg_status gg_theory_enskog_hermite_conduct(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_convergence convergence = {.n = 0};
  const gg_quantity q[] = {GG_Q_THERMAL_CONDUCTIVITY_REDUCED, GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC,
                           GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED};
  double frequency = m->density * m->chi[0] * m->sigma[0] * m->sigma[0];
  const gg_heating heating = {.kind = GG_HEATING_COOLS};
  for (int degree = GOOD_DEGREE; degree <= LAST_DEGREE; degree += 2) {
    gg_hermite_isotropic h;
    GG_TRY(gg_stop_check(m->stop, err));
    GG_TRY(gg_hermite_isotropic_solve(&h, degree, frequency, m->contact[0][0].jn, &heating, err));
    gg_status status = answer_heat(m, &h, gg_hermite_convergence_next(&convergence), err);
    gg_hermite_isotropic_end(&h);
    GG_TRY(status);
    if (gg_hermite_convergence_change(&convergence, q[0]) < hardly) break;
  }
  for (size_t k = 0; k < sizeof q / sizeof *q; k++) gg_hermite_convergence_take(&convergence, q[k], a);
  return GG_OK;
}

/* The isotropic state is cheap, its viscosity is not: the viscosity is solved up to a lower degree, from which on
 * its series no longer changes. */
static gg_status homogeneous(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_convergence convergence = {.n = 0}, viscous = {.n = 0};
  const gg_heating heating = gg_theory_heating_of(m);
  double frequency = m->density * m->chi[0] * m->sigma[0] * m->sigma[0];
  for (int degree = FIRST_DEGREE; degree <= LAST_DEGREE; degree += 2) {
    if (degree > GOOD_DEGREE && gg_hermite_convergence_change(&convergence, GG_Q_COOLING_RATE) < good) break;
    gg_hermite_isotropic h;
    gg_error why;
    GG_TRY(gg_stop_check(m->stop, err));
    gg_status status = gg_hermite_isotropic_solve(&h, degree, frequency, m->contact[0][0].jn, &heating, &why);
    if (status != GG_OK) return gg_theory_reject(err, name, "fails here: %s", why.message);
    gg_theory_answer *rung = gg_hermite_convergence_next(&convergence);
    answer_isotropic(m, &h, &heating, rung);
    if (m->flow == GG_HCS && !m->boltzmann)
      status = gg_hermite_isotropic_expansion(&h, m->sigma[0], &rung->value[GG_Q_COOLING_RATE_TRANSPORT], &why);
    if (status == GG_OK && degree <= VISCOSITY_DEGREE)
      status = answer_viscosity(m, &h, gg_hermite_convergence_next(&viscous), &why);
    gg_hermite_isotropic_end(&h);
    if (status != GG_OK) return gg_theory_reject(err, name, "fails here: %s", why.message);
  }
  GG_TRY(gg_hermite_convergence_finish(&convergence, name, GG_Q_COOLING_RATE, hardly, a, err));
  gg_hermite_convergence_take(&viscous, GG_Q_VISCOSITY_REDUCED, a);
  gg_hermite_convergence_take(&viscous, GG_Q_VISCOSITY_REDUCED_KINETIC, a);
  if (m->flow != GG_HCS) return GG_OK;
  GG_TRY(gg_theory_enskog_hermite_conduct(m, a, err));
  gg_theory_answer_critical_lengths(m, 0, a);
  return GG_OK;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  if (m->rule != GG_SMOOTH && m->n_species == 1) return gg_rough_answer(m, a, err);
  GG_TRY(gg_theory_require_smooth(m, name, err));
  if (m->flow == GG_USF || m->flow == GG_HEATED_SHEAR) return gg_hermite_shear_answer(m, a, err);
  return m->n_species > 1 ? gg_hermite_mixture_answer(m, a, err) : homogeneous(m, a, err);
}

const gg_theory gg_theory_enskog_hermite = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_USF) | GG_FLOW_BIT(GG_SMALL_SHEAR) |
             GG_FLOW_BIT(GG_HEATED_SHEAR),
    .title = "Enskog's equation, solved by expansion without random numbers",
    .citation = "J.J. Brey, J.W. Dufty and A. Santos, J. Stat. Phys. 87 (1997) 1051, for the equation",
    .answers = "temperature rotational_temperature temperature_ratio spin_z pressure compressibility_factor "
               "shear_viscosity N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_TRANSFER GG_ANSWERS_RATES GG_ANSWERS_KURTOSES
               "cos2_psi kurtosis_Wx kurtosis_Wy kurtosis_Wz skewness_Wz a11 b dissipation cooling_rate a2 c_1 "
               "c_2 " GG_ANSWERS_MIXTURE GG_ANSWERS_VISCOSITY GG_ANSWERS_HEAT
               "rotational_conductivity_reduced rotational_diffusive_conductivity_reduced " GG_ANSWERS_EXPANSION
                   GG_ANSWERS_LENGTHS "relaxation_rate",
    .assumptions =
        "Any density, molecular chaos, no other assumption: each answer has a numerical error. One species, smooth, of "
        "constant beta or with Coulomb friction, or a smooth mixture: steady uniform shear (up to 8 species), free "
        "cooling and heated states, also in a bath; viscosity (of smooth grains up to 6 species), heat flux of one "
        "cooling species, smooth or of constant beta. Errors of smooth grains are mostly below 0.01 % (0.1 % in dilute "
        "shear at e = 0.5), of rough and frictional grains 0.1 % from e = 0.7 on, of the viscosity with friction 1 %.",
    .baths = true,
    .evaluate = evaluate,
    .curves = gg_hermite_curves,
    .beyond = gg_theory_beyond_metastable,
};
