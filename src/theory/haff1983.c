/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Haff's law of free cooling, P.K. Haff, J. Fluid Mech. 134 (1983) 401: since zeta grows as sqrt(T),
 *   T(t) = T_0/(1 + zeta_0 t/2)^2,   collisions per grain = (2 nu_0/zeta_0) ln(1 + zeta_0 t/2) */
#include "theory/haff1983.h"

#include <math.h>

#include "theory/answer.h"
#include "theory/theory_list.h"

static const char name[] = "haff1983";

double gg_theory_haff_temperature(double T0, double zeta0, double t)
{
  double slower = 1 + zeta0 * t / 2;
  return T0 / (slower * slower);
}

double gg_theory_haff_collisions(double nu0, double zeta0, double t)
{
  return zeta0 > 0 ? 2 * nu0 / zeta0 * log1p(zeta0 * t / 2) : nu0 * t;
}

/* zeta = (nu/3)(1-e^2) of a Maxwellian. */
static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  GG_TRY(gg_theory_require_smooth(m, name, err));
  double T = m->temperature0;
  gg_theory_answer_temperature(m, T, NAN, a);
  gg_theory_answer_collisions_one(m, T, a);
  double zeta = a->value[GG_Q_COLLISION_RATE] / 3 * (1 - m->e[0] * m->e[0]);
  a->value[GG_Q_COOLING_RATE] = zeta / gg_common_model_nu0(m, T);
  return GG_OK;
}

const gg_theory gg_theory_haff1983 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS),
    .title = "Haff's law of free cooling",
    .citation = "P.K. Haff, J. Fluid Mech. 134 (1983) 401",
    .answers = "temperature " GG_ANSWERS_RATES "cooling_rate",
    .assumptions = "Free cooling of smooth grains of one species in boxes too small for clusters: T = T_0/(1 + zeta "
                   "t/2)^2. The cooling rate is within 2 % down to e = 0.5. Maxwellian velocities.",
    .evaluate = evaluate,
};
