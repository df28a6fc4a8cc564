/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smooth grains in a bath, without shear: M.G. Chamorro, F. Vega Reyes & V. Garzo, J. Stat. Mech. (2013) P07013, at
 * first Sonine order. With A = sqrt(2 pi) chi (1 - e^2), x = drag/(n d^2 sqrt(2T)), and the collisional moments of
 * T.P.C. van Noije & M.H. Ernst, Granular Matter 1 (1998) 57,
 *   noise - 2 drag T = zeta T,   zeta = (5/12) nu_0 chi (1 - e^2)(1 + 3 a2/16),
 *   a2 = A (1/2 - e^2)/{A [3/32 (59 + 10 e^2) + 2/(1 - e)] + 15 x}:
 * white noise without drag, the cooling gas where a negative drag heats. */
#include <math.h>

#include "theory/garzo_dufty1999.h"
#include "theory/heating.h"
#include "theory/range.h"
#include "theory/theory_list.h"

static const char name[] = "chamorro_vega_garzo2013";

static double a2_of(const gg_model *m, double T)
{
  const double e = m->e[0], root = sqrt(2 * M_PI) * m->chi[0], A = root * (1 - e * e);
  const double x = m->bath.drag[0] / (m->density * sqrt(2 * T));
  return A * (0.5 - e * e) / (A * 3 / 32 * (59 + 10 * e * e) + 2 * root * (1 + e) + 15 * x);
}

/* Energy from the bath, over the loss by drag and collisions: falls with T. */
static double balance(double log_T, void *context)
{
  const gg_model *m = context;
  const double T = exp(log_T), e = m->e[0], drag = m->bath.drag[0];
  const double zeta = 5. / 12 * gg_common_model_nu0(m, T) * m->chi[0] * (1 - e * e) * (1 + 3. / 16 * a2_of(m, T));
  return m->bath.noise[0] / T - 2 * drag - zeta;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  GG_TRY(gg_theory_require_smooth(m, name, err));
  if (!m->bath.on)
    return gg_theory_reject(err, name,
                            "describes gases in a bath, or heated at a given rate or strength; this scene has "
                            "neither");
  gg_model model = *m;
  const double near = -2 * log(gg_theory_heating_of(m).guess);
  const double T = exp(gg_theory_root_between(balance, &model, near - 1, near + 1));
  if (isnan(T)) return gg_theory_reject(err, name, "finds no temperature");
  gg_theory_answer_sonine(m, T, a2_of(m, T), a);
  return GG_OK;
}

const gg_theory gg_theory_chamorro_vega_garzo2013 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HSS),
    .title = "Smooth grains in a bath: temperature and fourth cumulant",
    .citation = "M.G. Chamorro, F. Vega Reyes and V. Garzo, J. Stat. Mech. (2013) P07013",
    .answers = "temperature pressure compressibility_factor " GG_ANSWERS_RATES GG_ANSWERS_KURTOSES "cooling_rate a2",
    .assumptions = "One species of smooth spheres in a bath of drag and noise, or heated by white noise of a given "
                   "strength or by the Gaussian thermostat of a given rate. Any density with molecular chaos; first "
                   "Sonine order, linear in a2.",
    .baths = true,
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_first_sonine,
};
