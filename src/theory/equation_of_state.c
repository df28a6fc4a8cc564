/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations of state of elastic hard spheres of one species, independent of the contact value that the scene chose:
 *   N.F. Carnahan & K.E. Starling, J. Chem. Phys. 51 (1969) 635: Z = (1 + phi + phi^2 - phi^3)/(1 - phi)^3
 *   J. Kolafa, S. Labik & A. Malijevsky, Phys. Chem. Chem. Phys. 6 (2004) 2335, a series in x = phi/(1-phi)
 *   S. Pieprzyk, M.N. Bannerman, A.C. Branka, M. Chudak & D.M. Heyes, Phys. Chem. Chem. Phys. 21 (2019) 6886, its
 *   refit
 * Mixtures: enskog.c, by contact values. */
#include "theory/equation_of_state.h"

#include <math.h>
#include <stddef.h>

#include "common/contact_value.h"
#include "theory/answer.h"
#include "theory/theory_list.h"

/* Contact values chi = (Z - 1)/(4 phi), exact for elastic spheres. Z - 1 is x times a series: the difference itself
 * would be lost to rounding in a dilute gas. */
static double kolafa(double phi)
{
  static const double low[] = {4, 6, 2.3647684, -0.8698551, 1.1062803, -1.095049, 0.637614};
  double x = phi / (1 - phi), sum = 0;
  for (size_t i = sizeof low / sizeof *low; i-- > 0;) sum = sum * x + low[i];
  sum += -0.2279397 * pow(x, 9) + 0.1098948 * pow(x, 13) - 0.00906797 * pow(x, 21);
  return sum / (4 * (1 - phi));
}

static double carnahan_starling(double phi)
{
  return gg_common_contact_value_of(GG_CARNAHAN_STARLING, phi);
}
static double pieprzyk(double phi)
{
  return gg_common_contact_value_of(GG_KOLAFA, phi);
}

double gg_theory_compressibility_kolafa2004(double phi)
{
  return 1 + 4 * phi * kolafa(phi);
}

/* p = n T Z and the collision rate, both from chi. */
static gg_status answer_with(double (*chi_of)(double), const char *name, const gg_model *m, gg_theory_answer *a,
                             gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  if (!m->elastic) return gg_theory_reject(err, name, "describes elastic grains; collisions of this scene lose energy");
  if (m->boltzmann) return gg_theory_reject(err, name, "describes dense fluids; this scene has phi = 0");
  if (m->phi > GG_FREEZING_PHI)
    return gg_theory_reject(err, name, "describes the fluid, stable up to phi = %g; this scene has %g", GG_FREEZING_PHI,
                            m->phi);
  double T = m->temperature0, p = m->density * T, chi = chi_of(m->phi);
  gg_theory_answer_pressure(m, T, p, p * 4 * m->phi * chi, a);
  gg_theory_answer_collisions_one(m, T, a);
  a->value[GG_Q_COLLISION_RATE] *= chi / m->chi[0];
  a->value[GG_Q_MEAN_FREE_PATH] *= m->chi[0] / chi;
  a->value[GG_Q_KNUDSEN] *= m->chi[0] / chi;
  return GG_OK;
}

static gg_status evaluate_carnahan_starling(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return answer_with(carnahan_starling, gg_theory_carnahan_starling1969.name, m, a, err);
}

static gg_status evaluate_kolafa(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return answer_with(kolafa, gg_theory_kolafa2004.name, m, a, err);
}

static gg_status evaluate_pieprzyk(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return answer_with(pieprzyk, gg_theory_pieprzyk2019.name, m, a, err);
}

const gg_theory gg_theory_carnahan_starling1969 = {
    .name = "carnahan_starling1969",
    .flows = GG_FLOW_BIT(GG_EQUILIBRIUM),
    .title = "Equation of state of elastic hard spheres",
    .citation = "N.F. Carnahan and K.E. Starling, J. Chem. Phys. 51 (1969) 635",
    .answers = "pressure compressibility_factor " GG_ANSWERS_RATES,
    .assumptions =
        "Equilibrium fluid of one species, phi up to 0.494; 0.03 % low at phi = 0.1, 0.25 % at 0.3, 0.21 % at "
        "0.45.",
    .evaluate = evaluate_carnahan_starling,
};

const gg_theory gg_theory_kolafa2004 = {
    .name = "kolafa2004",
    .flows = GG_FLOW_BIT(GG_EQUILIBRIUM),
    .title = "Accurate equation of state of elastic hard spheres",
    .citation = "J. Kolafa, S. Labik and A. Malijevsky, Phys. Chem. Chem. Phys. 6 (2004) 2335",
    .answers = "pressure compressibility_factor " GG_ANSWERS_RATES,
    .assumptions = "Equilibrium fluid of one species, phi up to 0.494.",
    .evaluate = evaluate_kolafa,
};

const gg_theory gg_theory_pieprzyk2019 = {
    .name = "pieprzyk2019",
    .flows = GG_FLOW_BIT(GG_EQUILIBRIUM),
    .title = "Accurate equation of state of elastic hard spheres, refitted",
    .citation = "S. Pieprzyk, M.N. Bannerman, A.C. Branka, M. Chudak and D.M. Heyes, Phys. Chem. Chem. Phys. 21 (2019) "
                "6886",
    .answers = "pressure compressibility_factor " GG_ANSWERS_RATES,
    .assumptions = "Equilibrium fluid of one species, phi up to 0.494.",
    .evaluate = evaluate_pieprzyk,
};
