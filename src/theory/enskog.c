/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elastic hard spheres at rest: Enskog's equation (Chapman & Cowling, The Mathematical Theory of Non-Uniform Gases, ch.
 * 16) at the contact value of the scene.
 *   Z = p/(nT) = 1 + (2 pi/3) n sum_ij x_i x_j sigma_ij^3 chi_ij        (= 1 + 4 phi chi for one species)
 *   eta/eta_0 = (1 + 8/5 phi chi)^2/chi + 768/(25 pi) phi^2 chi,   eta_0 = 5/(16 d^2) sqrt(m T/pi)
 *   kappa/kappa_0 = (1 + 12/5 phi chi)^2/chi + 512/(25 pi) phi^2 chi,   eta_b/eta_0 = 256/(5 pi) phi^2 chi
 * (first Sonine order; two species: the equations of garzo_montanero2003.c at e = 1; of more no viscosity). */
#include <math.h>

#include "theory/answer.h"
#include "theory/garzo_montanero2003.h"
#include "theory/theory_list.h"

static const char name[] = "enskog";

/* Z - 1 */
static double excess(const gg_model *m)
{
  double sum = 0;
  if (m->boltzmann) return 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++)
      sum +=
          gg_theory_fraction(m, i) * gg_theory_fraction(m, j) * pow(m->sigma[gg_pair(i, j)], 3) * m->chi[gg_pair(i, j)];
  return 2 * M_PI / 3 * m->density * sum;
}

/* <v_x^4>/<v_x^2>^2 of a velocity component of all grains: Maxwellians of unlike masses. */
static double kurtosis(const gg_model *m)
{
  double second = 0, fourth = 0;
  for (int i = 0; i < m->n_species; i++) {
    second += gg_theory_fraction(m, i) / m->mass[i];
    fourth += 3 * gg_theory_fraction(m, i) / (m->mass[i] * m->mass[i]);
  }
  return fourth / (second * second);
}

static void answer_transport(const gg_model *m, double T, gg_theory_answer *a)
{
  if (m->n_species == 1) {
    double y = gg_theory_phi_chi(m), kinetic = 1 + 1.6 * y;
    a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = kinetic / m->chi[0];
    a->value[GG_Q_VISCOSITY_REDUCED] = kinetic * kinetic / m->chi[0] + 768 / (25 * M_PI) * m->phi * y;
    kinetic = 1 + 2.4 * y;
    a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC] = kinetic / m->chi[0];
    a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] = kinetic * kinetic / m->chi[0] + 512 / (25 * M_PI) * m->phi * y;
    a->value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] = 0;
    if (!m->boltzmann) a->value[GG_Q_BULK_VISCOSITY_REDUCED] = gg_theory_bulk_viscosity(m, 1);
    return;
  }
  if (m->n_species > 2) return;
  gg_mixture_state rest = {.a = {T / m->mass[0], T / m->mass[1]}};
  gg_mixture_viscosity v = gg_theory_mixture_viscosity_of(m, &rest, 0);
  double unit = gg_common_model_nu0(m, T) / (m->density * T);
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = v.kinetic * unit;
  a->value[GG_Q_VISCOSITY_REDUCED] = v.total * unit;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  if (!m->elastic) return gg_theory_reject(err, name, "describes elastic grains; collisions of this scene lose energy");
  double T = m->temperature0, p = m->density * T, pc = p * excess(m);
  gg_theory_answer_temperature(m, T, 1, a);
  gg_theory_answer_pressure(m, T, p, pc, a);
  gg_theory_answer_collisions_one(m, T, a);
  if (m->rule == GG_SMOOTH) answer_transport(m, T, a);
  a->value[GG_Q_KURTOSIS_CX] = a->value[GG_Q_KURTOSIS_CY] = a->value[GG_Q_KURTOSIS_CZ] = kurtosis(m);
  a->value[GG_Q_A2] = 0;
  return GG_OK;
}

const gg_theory gg_theory_enskog = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_EQUILIBRIUM),
    .title = "Elastic hard spheres in equilibrium",
    .citation =
        "D. Enskog, K. Svenska Vetensk. Akad. Handl. 63 (1922) no. 4; N.F. Carnahan and K.E. Starling, J. Chem. "
        "Phys. 51 (1969) 635",
    .answers = "temperature rotational_temperature temperature_ratio pressure compressibility_factor " GG_ANSWERS_RATES
        GG_ANSWERS_KURTOSES "a2 " GG_ANSWERS_VISCOSITY GG_ANSWERS_HEAT "bulk_viscosity_reduced",
    .assumptions =
        "Equilibrium of any number of species of elastic spheres, at the contact value of the scene (within 0.3 % "
        "of simulations up to phi = 0.49 for Carnahan-Starling); viscosity of one or two and conductivity "
        "of one at first Sonine order.",
    .evaluate = evaluate,
};
