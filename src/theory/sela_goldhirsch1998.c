/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Normal stress differences of a dilute gas of smooth inelastic spheres at Burnett order: N. Sela & I. Goldhirsch, J.
 * Fluid Mech. 361 (1998) 41, in steady uniform shear (Alam & Luding, J. Fluid Mech. 476 (2003) 69), eps = 1 - e^2:
 *   N1 =  (1.6735 eps - 0.04315 eps^2)/(1.2996 + 0.0966 eps)
 *   N2 = -(0.14189 eps - 0.003659 eps^2)/(1.2996 + 0.0966 eps) */
#include "theory/answer.h"
#include "theory/range.h"
#include "theory/theory_list.h"

static const char name[] = "sela_goldhirsch1998";

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  GG_TRY(gg_theory_require_smooth(m, name, err));
  GG_TRY(gg_theory_require_steady_shear(m, name, err));
  GG_TRY(gg_theory_require_dilute(m, name, err));
  double eps = 1 - m->e[0] * m->e[0], below = 1.2996 + 0.0966 * eps;
  a->value[GG_Q_N1] = (1.6735 - 0.04315 * eps) * eps / below;
  a->value[GG_Q_N2] = -(0.14189 - 0.003659 * eps) * eps / below;
  return GG_OK;
}

const gg_theory gg_theory_sela_goldhirsch1998 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Normal stress differences at Burnett order",
    .citation = "N. Sela and I. Goldhirsch, J. Fluid Mech. 361 (1998) 41",
    .answers = "N1 N2",
    .assumptions =
        "Steady uniform shear of a dilute gas (phi up to 0.05) of smooth spheres of one species; second order "
        "in the shear rate and expanded in 1 - e^2, so for e near 1.",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_quasi_elastic,
};
