/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nearly elastic spheres of little friction: J.T. Jenkins & C. Zhang, Phys. Fluids 14 (2002) 1228. The theory of smooth
 * grains, with an effective restitution in the loss of translational energy alone; stress and viscosity keep e. Spins
 * are in the steady state of translation, and the mean spin follows the vorticity.
 *
 * With mu_0 = mu eta_1/eta_2 (contacts stick below this tangent of the angle of impact), q = mu/mu_0,
 * A = pi/2 - atan(mu_0):
 *   a_1 = q [2 A mu_0 + 2 mu_0^2/(1 + mu_0^2) (1 - 2q)],   a_2 = (q/K) [A mu_0 + (mu_0^2 - mu_0^4)/(1 + mu_0^2)^2]
 *   b_1 = q^2 mu_0^2/(1 + mu_0^2),                         b_2 = (q/2) [A mu_0 + mu_0^2/(1 + mu_0^2)]
 *   theta/T = b_1/b_2,   e_eff = e - a_1/2 + (a_2/2) b_1/b_2
 * Two Maxwellians exchange this energy (two_maxwellian.h), to first order in theta/T and with e = 1 but in mu_0; 1/K is
 * 5/2 in the paper. Smooth grains: C.K.K. Lun, S.B. Savage, D.J. Jeffrey & N. Chepurniy, J. Fluid Mech. 140 (1984) 223,
 * which to the order of the paper is its own theory. */
#include "theory/jenkins_zhang2002.h"

#include <math.h>

#include "theory/lun1991.h"
#include "theory/newtonian_shear.h"
#include "theory/theory_list.h"

static const char name[] = "jenkins_zhang2002";

gg_effective_restitution gg_theory_jenkins_zhang(gg_grain g, double mu)
{
  const double e = 2 * g.eta1 - 1, q = g.eta2 / g.eta1, mu0 = mu / q, A = atan(q / mu), s = mu0 * mu0;
  const double a1 = q * (2 * A * mu0 + 2 * s / (1 + s) * (1 - 2 * q));
  const double a2 = q / g.K * (A * mu0 + s * (1 - s) / ((1 + s) * (1 + s)));
  const double ratio = 2 * q * s / (A * mu0 * (1 + s) + s);
  return (gg_effective_restitution){e - a1 / 2 + a2 / 2 * ratio, ratio};
}

gg_effective_restitution gg_theory_jenkins_zhang_of(const gg_model *m)
{
  if (m->rule == GG_SMOOTH) return (gg_effective_restitution){m->e[0], NAN};
  return gg_theory_jenkins_zhang(gg_theory_grain_of(m), m->mu[0]);
}

const char *gg_theory_beyond_little_friction(const gg_model *m)
{
  if (m->rule == GG_SMOOTH || (m->e[0] >= 0.95 && m->mu[0] <= 0.1)) return NULL;
  return "the effective restitution is made for nearly elastic grains (e from 0.95) of little friction (mu up to 0.1)";
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  const gg_effective_restitution effective = gg_theory_jenkins_zhang_of(m);
  GG_TRY(gg_theory_require_effective_restitution(m, effective.e, name, err));
  const gg_grain smooth = {(1 + m->e[0]) / 2, 0, m->inertia[0]};
  const gg_lun_state state = {m->density, m->phi, m->chi[0], smooth, 0};
  const gg_lun_functions f = gg_theory_lun_functions_at(state);
  const double loss = 2 * sqrt(M_PI) * m->density * m->density * m->chi[0] * (1 - effective.e * effective.e);
  const gg_newtonian gas = {m->chi[0], effective.ratio, f.f1_kinetic, f.f1_transfer, f.f2_kinetic, f.f2_transfer, loss};
  gg_theory_answer_newtonian_shear(m, &gas, a);
  gg_theory_answer_rolling(m, -0.5, a);
  return GG_OK;
}

static const char *beyond(const gg_model *m)
{
  if (m->e[0] < 0.95) return "made for nearly elastic grains (e from 0.95)";
  return gg_theory_beyond_little_friction(m);
}

const gg_theory gg_theory_jenkins_zhang2002 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Nearly elastic spheres of little friction",
    .citation = "J.T. Jenkins and C. Zhang, Phys. Fluids 14 (2002) 1228",
    .answers = "temperature rotational_temperature temperature_ratio spin_z pressure compressibility_factor "
               "shear_viscosity N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_TRANSFER GG_ANSWERS_RATES "dissipation",
    .assumptions = "Steady uniform shear of one species, smooth or with Coulomb friction, made for e near 1 and small "
                   "mu. The theory of smooth grains (lun1991) with an effective restitution in the loss of energy "
                   "alone. First order in the shear rate (so N1 = N2 = 0), contact value of the scene. No stress from "
                   "tangential impulses.",
    .evaluate = evaluate,
    .beyond = beyond,
};
