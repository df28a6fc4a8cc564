/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Extended kinetic theory: D. Vescovi, D. Berzi, P. Richard & N. Brodu, Phys. Fluids 26 (2014) 053305, after J.T.
 * Jenkins, Granular Matter 10 (2007) 47. Smooth grains of Garzo & Dufty (a_2 = 0); above phi = 0.49 velocities of
 * colliding grains are correlated over a length L, which divides the loss. With G = phi chi and e_eff:
 *   p = 4 rho_p phi G F T,   viscosity = 8 J phi G T^1/2/(5 sqrt(pi)),   loss = 12/sqrt(pi) phi G (1 - e_eff^2) T^3/2/L
 *   F = (1+e)/2 + 1/(4G)
 *   J = (1+e)/2 + (pi/32) [5 + 2(1+e)(3e-1)G][5 + 4(1+e)G]/{[24 - 6(1-e)^2 - 5(1-e^2)] G^2}
 *   L = max(1, f_0 rate/T^1/2),
 *   f_0 = {2J/[15(1-e_eff^2)]}^1/2 {1 + (26/15)(1-e_eff) max[0, (phi-0.49)/(0.64-phi)]}^3/2
 * In steady uniform shear T = rate^2 2JL/[15(1-e_eff^2)], so that L is the last brace to the power 1.
 *
 * Friction: e_eff is that of Jenkins & Zhang 2002, as in J.T. Jenkins & D. Berzi, Granular Matter 12 (2010) 151; else
 * e. The contact value is the scene's; the paper's own is contact_value: vescovi2014. */
#include <math.h>

#include "theory/jenkins_zhang2002.h"
#include "theory/newtonian_shear.h"
#include "theory/range.h"
#include "theory/theory_list.h"

static const char name[] = "vescovi2014";

static double correlation_length(double phi, double e)
{
  return 1 + 26. / 15 * (1 - e) * fmax(0, (phi - 0.49) / (0.64 - phi));
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  const gg_effective_restitution effective = gg_theory_jenkins_zhang_of(m);
  GG_TRY(gg_theory_require_effective_restitution(m, effective.e, name, err));
  gg_newtonian gas = gg_theory_garzo_dufty_gas(m, effective.e);
  gas.ratio = effective.ratio;
  gas.loss /= correlation_length(m->phi, effective.e);
  gg_theory_answer_newtonian_shear(m, &gas, a);
  gg_theory_answer_rolling(m, -0.5, a);
  return GG_OK;
}

static const char *beyond(const gg_model *m)
{
  const char *friction = gg_theory_beyond_little_friction(m);
  return friction ? friction : gg_theory_beyond_linear_anisotropy(m);
}

const gg_theory gg_theory_vescovi2014 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Extended kinetic theory: a correlation length divides the loss",
    .citation = "D. Vescovi, D. Berzi, P. Richard and N. Brodu, Phys. Fluids 26 (2014) 053305; J.T. Jenkins, Granular "
                "Matter 10 (2007) 47; J.T. Jenkins and D. Berzi, Granular Matter 12 (2010) 151",
    .answers = "temperature rotational_temperature temperature_ratio spin_z pressure compressibility_factor "
               "shear_viscosity N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_TRANSFER GG_ANSWERS_RATES "dissipation",
    .assumptions = "Steady uniform shear of one species, smooth or with Coulomb friction (effective restitution of "
                   "jenkins_zhang2002). Viscosity of Garzo and Dufty 1999 with a2 = 0; above phi = 0.49 the loss is "
                   "divided by a correlation length. First order in the shear rate (so N1 = N2 = 0), contact value of "
                   "the scene; the paper's own is contact_value: vescovi2014.",
    .evaluate = evaluate,
    .beyond = beyond,
};
