/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frictional grains by fits to soft-sphere simulations: S. Chialvo & S. Sundaresan, Phys. Fluids 25 (2013) 070603.
 * Smooth grains of Garzo & Dufty (a_2 = 0) with an effective restitution in the loss, and a least T near the critical
 * density phi_c, at which the grains jam:
 *
 *   e_eff = e - (3/2) mu exp(-3 mu),   T = rate^2 max[viscosity/loss(e_eff), 0.06/(phi_c - phi)^1/2]
 *
 * (eqs 24, 26, 27, 30 of the paper). phi_c is 0.636 for smooth grains and falls with mu. Its values for frictional
 * grains are not in graingas, so that these have an answer only where the first term is the larger for any phi_c above
 * LOOSEST. The paper multiplies the shear stress of frictional grains by another fit, of which we know no certain form:
 * they have no shear stress here. */
#include <math.h>

#include "theory/newtonian_shear.h"
#include "theory/range.h"
#include "theory/theory_list.h"

static const char name[] = "chialvo_sundaresan2013";

/* Density at which smooth spheres jam. */
#define SMOOTH_CRITICAL 0.636
/* Loosest packing of frictional spheres: G.Y. Onoda & E.G. Liniger, Phys. Rev. Lett. 64 (1990) 2727. */
#define LOOSEST 0.555
/* Highest density of the inertial regime, for which the shear stress is that of kinetic theory. */
#define INERTIAL 0.49

static double effective_restitution(const gg_model *m)
{
  const double mu = m->rule == GG_SMOOTH ? 0 : m->mu[0];
  return m->e[0] - 1.5 * mu * exp(-3 * mu);
}

/* Least T/rate^2 of dense grains. */
static double dense_temperature(const gg_model *m, double critical)
{
  if (m->boltzmann) return 0;
  return m->phi < critical ? 0.06 / sqrt(critical - m->phi) : INFINITY;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  const double effective = effective_restitution(m);
  GG_TRY(gg_theory_require_effective_restitution(m, effective, name, err));
  const gg_newtonian gas = gg_theory_garzo_dufty_gas(m, effective);
  const bool smooth = m->rule == GG_SMOOTH;
  const double inertial = gg_theory_newtonian_temperature(m, &gas);
  const double dense = m->shear_rate * m->shear_rate * dense_temperature(m, smooth ? SMOOTH_CRITICAL : LOOSEST);
  if (!smooth && inertial < dense)
    return gg_theory_reject(err, name, "depends on the critical density of frictional grains here, which is not known");
  if (smooth && m->phi <= INERTIAL && inertial >= dense) {
    gg_theory_answer_newtonian_shear(m, &gas, a);
    return GG_OK;
  }
  const double T = fmax(inertial, dense);
  gg_theory_answer_temperature(m, T, NAN, a);
  gg_theory_answer_pressure(m, T, T * gas.pressure_kinetic, T * gas.pressure_transfer, a);
  gg_theory_answer_collisions_one(m, T, a);
  return GG_OK;
}

const gg_theory gg_theory_chialvo_sundaresan2013 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Frictional grains by fits to soft-sphere simulations",
    .citation = "S. Chialvo and S. Sundaresan, Phys. Fluids 25 (2013) 070603",
    .answers =
        "temperature pressure compressibility_factor shear_viscosity N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_TRANSFER
            GG_ANSWERS_RATES "dissipation",
    .assumptions = "Steady uniform shear of one species, smooth or with Coulomb friction. Garzo and Dufty 1999 with "
                   "a2 = 0 and an effective restitution in the loss of energy, a fit that leaves out beta; T has a "
                   "lower bound in dense grains. Shear stress for smooth grains up to phi = 0.49. Contact value of the "
                   "scene; the paper's own is contact_value: chialvo_sundaresan2013.",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_linear_anisotropy,
};
