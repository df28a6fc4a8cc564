/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinetic theory of slightly inelastic, slightly rough (or nearly perfectly rough) spheres: C.K.K. Lun, J. Fluid Mech.
 * 233 (1991) 539. First Sonine order, first order in gradients, isotropic spins, independent of velocities, with mean
 * curl(u)/2; the dependence of the collision integrals on e and beta is kept in full. Steady shear: Gayen & Alam, J.
 * Fluid Mech. 567 (2006) 195.
 *
 * With y = phi chi, r = theta/T, per volume, m = d = 1:
 *   f1  = n (1 + 4 eta_1 y)
 *   f2  = 5/(16 sqrt(pi) chi) (1 + 8/5 y N)/Dn [1 + 4/5 y (2 eta_1 + 3 eta_2)]
 *         + 12/(5 pi^3/2) (4 eta_1 + 3 eta_2) phi y
 *   N   = eta_1 (3 eta_1 - 2) + eta_2 (6 eta_1 - 1 - 2 eta_2)/2 - eta_2^2 r/K
 *   Dn  = (eta_1 + eta_2)(2 - eta_1 - eta_2) + eta_2^2 r/(6K)
 *   f2r = 12/pi^3/2 eta_2 phi y,   f3 = 16/pi^3/2 eta_1 phi y
 *   f5  = 8 sqrt(pi) n^2 chi [eta_1 (1 - eta_1) + eta_2 (1 - eta_2) - eta_2^2 r/K]
 *   f5r = 8 sqrt(pi) n^2 chi (eta_2/K) [eta_2 - r (1 - eta_2/K)]
 *
 * Heat fluxes of translation and rotation, q_i = -T^1/2 sum_j f4_ij grad T_j with T_0 = T, T_1 = theta, from the
 * moments C C^2/2 and C K s^2/2, s = omega/2, at uniform n and, as f2, without cooling (rates and sources: below):
 *   f4_ij = 5/(16 sqrt(pi) chi) (rate^-1 source)_ij c_i + 24/pi^3/2 phi y X_i delta_ij
 *   c_0   = 1 + 4/5 y (3 eta_1 + 2 eta_2),   c_1 = 1 + 8/3 y eta_2/K,   X_0 = eta_1 + eta_2,   X_1 = eta_2/K
 * The couple stress is nought to this order: a collision changes the spins of both grains alike. */
#include "theory/lun1991.h"

#include <math.h>

#include "common/contact_value.h"
#include "theory/newtonian_shear.h"
#include "theory/range.h"
#include "theory/theory_list.h"

/* Random close packing in the contact value of Lun & Savage. */
#define GG_LUN_SAVAGE_PACKING 0.64

#define LUN_COEFFICIENTS                                                                                               \
  "thermal_conductivity thermal_conductivity_cross rotational_conductivity_cross rotational_conductivity "             \
  "bulk_viscosity rotational_viscosity"

double gg_theory_lun_ratio(gg_grain g)
{
  return g.eta2 == 0 ? 0 : g.eta2 / (1 - g.eta2 / g.K);
}

gg_heat_rates gg_theory_heat_rates(gg_grain g, double r)
{
  const double h1 = g.eta1, h2 = g.eta2, k = 1 / g.K, h = h1 + h2;
  return (gg_heat_rates){
      {{(41 * h - 33 * (h1 * h1 + h2 * h2) - 16 * h1 * h2 - 7 * h2 * h2 * k * r) / 12, -25. / 18 * h2 * h2 * k},
       {-5. / 12 * h2 * k * (h2 * (3 + k * r) - r), 5. / 18 * (3 * h + h2 * k * (7 - 4 * h1 - 6 * h2 - 3 * h2 * k))}}};
}

bool gg_theory_heat_flux(gg_heat_rates rate, double fading, const double source[2], double flux[2])
{
  const double a = rate.at[0][0] - fading, b = rate.at[0][1], c = rate.at[1][0], d = rate.at[1][1] - fading;
  const double det = a * d - b * c;
  flux[0] = (d * source[0] - b * source[1]) / det;
  flux[1] = (a * source[1] - c * source[0]) / det;
  return det > 0 && a + d > 0;
}

/* Coefficients of grad T and grad theta (second index) in both heat fluxes: kinetic, and collisional. */
static void conductivities(gg_lun_state s, double transfer, double f4[2][2])
{
  const double h1 = s.grain.eta1, h2 = s.grain.eta2, k = 1 / s.grain.K, r = s.ratio, y = s.phi * s.chi;
  const double source[2][2] = {
      {2.5 + 2 * y * (3 * h1 * h1 * (4 * h1 - 3) + h2 * (4 * h1 * h2 * (2 + k * r) - 4 * h1 - 2 * h2)),
       4 * y * h2 * k * (2 * h1 * h2 * (2 + k * r) - 2 * h1 * r - h2)},
      {4 * y * h2 * h2 * k * (2 * h1 - 1), 1.5 + 4 * y * h2 * h2 * k * k * (2 * h1 - 1)}};
  const double carried[2] = {1 + 0.8 * y * (3 * h1 + 2 * h2), 1 + 8. / 3 * y * h2 * k};
  const double direct[2] = {2 * transfer * (h1 + h2), 2 * transfer * h2 * k};
  const gg_heat_rates rate = gg_theory_heat_rates(s.grain, r);
  for (int j = 0; j < 2; j++) {
    double flux[2];
    gg_theory_heat_flux(rate, 0, source[j], flux);
    for (int i = 0; i < 2; i++)
      f4[i][j] = 5 / (16 * sqrt(M_PI) * s.chi) * flux[i] * carried[i] + (i == j ? direct[i] : 0);
  }
}

gg_lun_functions gg_theory_lun_functions_at(gg_lun_state s)
{
  double h1 = s.grain.eta1, h2 = s.grain.eta2, K = s.grain.K, y = s.phi * s.chi, r = s.ratio;
  double N = h1 * (3 * h1 - 2) + h2 * (6 * h1 - 1 - 2 * h2) / 2 - h2 * h2 * r / K;
  double Dn = (h1 + h2) * (2 - h1 - h2) + h2 * h2 * r / (6 * K);
  double loss = 8 * sqrt(M_PI) * s.n * s.n * s.chi, transfer = 12 * s.phi * y / pow(M_PI, 1.5);
  gg_lun_functions f;
  f.f1_kinetic = s.n;
  f.f1_transfer = s.n * 4 * h1 * y;
  f.f1 = f.f1_kinetic + f.f1_transfer;
  f.f2_kinetic = 5 / (16 * sqrt(M_PI) * s.chi) * (1 + 1.6 * y * N) / Dn;
  f.f2_transfer = f.f2_kinetic * 0.8 * y * (2 * h1 + 3 * h2) + transfer * (4 * h1 + 3 * h2) / 5;
  f.f2 = f.f2_kinetic + f.f2_transfer;
  f.f2r = transfer * h2;
  f.f3 = transfer * 4 / 3 * h1;
  f.f5 = loss * (h1 * (1 - h1) + h2 * (1 - h2) - h2 * h2 * r / K);
  f.f5r = loss * h2 / K * (h2 - r * (1 - h2 / K));
  conductivities(s, transfer, f.f4);
  return f;
}

static void answer_coefficients(const gg_model *m, double unit, gg_lun_functions f, gg_theory_answer *a)
{
  a->value[GG_Q_THERMAL_CONDUCTIVITY] = unit * f.f4[0][0];
  if (!m->boltzmann) a->value[GG_Q_BULK_VISCOSITY] = unit * f.f3;
  if (m->rule == GG_SMOOTH) return;
  a->value[GG_Q_THERMAL_CONDUCTIVITY_CROSS] = unit * f.f4[0][1];
  a->value[GG_Q_ROTATIONAL_CONDUCTIVITY_CROSS] = unit * f.f4[1][0];
  a->value[GG_Q_ROTATIONAL_CONDUCTIVITY] = unit * f.f4[1][1];
  if (!m->boltzmann) a->value[GG_Q_ROTATIONAL_VISCOSITY] = unit * f.f2r;
}

gg_status gg_theory_lun_shear(const gg_model *m, double chi, const char *theory, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, theory, err));
  GG_TRY(gg_theory_require_constant_beta(m, theory, err));
  GG_TRY(gg_theory_require_steady_shear(m, theory, err));
  gg_grain grain = gg_theory_grain_of(m);
  gg_lun_state state = {m->density, m->phi, chi, grain, gg_theory_lun_ratio(grain)};
  gg_lun_functions f = gg_theory_lun_functions_at(state);
  const gg_newtonian gas = {chi, state.ratio, f.f1_kinetic, f.f1_transfer, f.f2_kinetic, f.f2_transfer, f.f5};
  gg_theory_answer_newtonian_shear(m, &gas, a);
  answer_coefficients(m, m->stress_unit * sqrt(a->value[GG_Q_TEMPERATURE]), f, a);
  gg_theory_answer_rolling(m, -0.5, a);
  return GG_OK;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return gg_theory_lun_shear(m, m->chi[0], "lun1991", a, err);
}

const gg_theory gg_theory_lun1991 = {
    .name = "lun1991",
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Kinetic theory of slightly inelastic, rough spheres",
    .citation = "C.K.K. Lun, J. Fluid Mech. 233 (1991) 539",
    .answers =
        "temperature rotational_temperature temperature_ratio spin_z pressure compressibility_factor "
        "shear_viscosity N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_TRANSFER GG_ANSWERS_RATES "dissipation " LUN_COEFFICIENTS,
    .assumptions = "Steady uniform shear of one species with constant e and beta. Good near e = 1 with beta = -1 or 1; "
                   "T is tens of percent off for dissipative or half-rough grains. First order in the shear rate (so "
                   "N1 = N2 = 0), first Sonine order, contact value of the scene.",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_quasi_elastic,
};

static const char name_ls[] = "lun1991_lun_savage";

static gg_status evaluate_lun_savage(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  if (m->boltzmann)
    return gg_theory_reject(err, name_ls, "differs from lun1991 only at finite density; this scene has phi = 0");
  if (m->phi >= GG_LUN_SAVAGE_PACKING)
    return gg_theory_reject(err, name_ls, "describes grains below phi = %g; this scene has %g", GG_LUN_SAVAGE_PACKING,
                            m->phi);
  return gg_theory_lun_shear(m, gg_common_contact_value_of(GG_LUN_SAVAGE, m->phi), name_ls, a, err);
}

const gg_theory gg_theory_lun1991_lun_savage = {
    .name = name_ls,
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Lun's theory with the contact value of Lun and Savage",
    .citation =
        "C.K.K. Lun, J. Fluid Mech. 233 (1991) 539; contact value C.K.K. Lun and S.B. Savage, J. Appl. Mech. 54 "
        "(1987) 47",
    .answers =
        "temperature rotational_temperature temperature_ratio spin_z pressure compressibility_factor "
        "shear_viscosity N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_TRANSFER GG_ANSWERS_RATES "dissipation " LUN_COEFFICIENTS,
    .assumptions = "As lun1991, but always with chi = (1 - phi/0.64)^-1.6, which is 11 % above Carnahan-Starling at "
                   "phi = 0.3 and 90 % at 0.5.",
    .evaluate = evaluate_lun_savage,
    .beyond = gg_theory_beyond_quasi_elastic,
};
