/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/newtonian_shear.h"

#include <math.h>

double gg_theory_newtonian_temperature(const gg_model *m, const gg_newtonian *gas)
{
  return m->shear_rate * m->shear_rate * (gas->viscosity_kinetic + gas->viscosity_transfer) / gas->loss;
}

/* Collision rate and free path of Maxwellians at T for another contact value than the scene's. */
static void answer_collisions(const gg_model *m, double chi, double T, gg_theory_answer *a)
{
  gg_theory_answer_collisions_one(m, T, a);
  a->value[GG_Q_COLLISION_RATE] *= chi / m->chi[0];
  a->value[GG_Q_MEAN_FREE_PATH] *= m->chi[0] / chi;
  a->value[GG_Q_KNUDSEN] *= m->chi[0] / chi;
}

void gg_theory_answer_newtonian_shear(const gg_model *m, const gg_newtonian *gas, gg_theory_answer *a)
{
  const double T = gg_theory_newtonian_temperature(m, gas), rate = m->shear_rate;
  const double pk = T * gas->pressure_kinetic, pc = T * gas->pressure_transfer;
  const double shear_k = -sqrt(T) * gas->viscosity_kinetic * rate, shear_c = -sqrt(T) * gas->viscosity_transfer * rate;
  gg_theory_answer_temperature(m, T, gas->ratio, a);
  gg_theory_answer_stress(m, T, (gg_stress){pk, pk, pk, shear_k, shear_k}, (gg_stress){pc, pc, pc, shear_c, shear_c},
                          a);
  answer_collisions(m, gas->chi, T, a);
  a->value[GG_Q_DISSIPATION] = m->stress_unit * pow(T, 1.5) * gas->loss;
}

gg_newtonian gg_theory_garzo_dufty_gas(const gg_model *m, double e_loss)
{
  const double e = m->e[0], n = m->density, chi = m->chi[0], y = gg_theory_phi_chi(m), eta0 = 5 / (16 * sqrt(M_PI));
  const double relaxation = chi * (1 - (1 - e) * (1 - e) / 4 - 5. / 24 * (1 - e * e));
  const double kinetic = eta0 * (1 - 0.4 * (1 + e) * (1 - 3 * e) * y) / relaxation;
  const double direct = eta0 * 384 / (25 * M_PI) * (1 + e) * m->phi * y;
  return (gg_newtonian){.chi = chi,
                        .ratio = NAN,
                        .pressure_kinetic = n,
                        .pressure_transfer = n * 2 * (1 + e) * y,
                        .viscosity_kinetic = kinetic,
                        .viscosity_transfer = kinetic * 0.8 * (1 + e) * y + direct,
                        .loss = 2 * sqrt(M_PI) * n * n * chi * (1 - e_loss * e_loss)};
}

gg_status gg_theory_require_effective_restitution(const gg_model *m, double effective, const char *theory,
                                                  gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, theory, err));
  GG_TRY(gg_theory_require_steady_shear(m, theory, err));
  if (m->rule == GG_ROUGH)
    return gg_theory_reject(err, theory,
                            "describes smooth or frictional grains; grains of this scene have constant beta");
  if (effective >= 0) return GG_OK;
  return gg_theory_reject(err, theory, "has no effective restitution: friction costs more than e = 0");
}
