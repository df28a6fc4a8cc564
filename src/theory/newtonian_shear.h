/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady uniform shear of theories of first order in the gradients: the pressure is isotropic, and viscous heating
 * balances the loss of energy. */
#ifndef GG_NEWTONIAN_SHEAR_H
#define GG_NEWTONIAN_SHEAR_H

#include "theory/answer.h"

/* Constitutive functions of a gas per volume with m = d = 1:
 *   p = T pressure,   viscosity = T^1/2 viscosity,   dissipation = T^3/2 loss. */
typedef struct gg_newtonian {
  double chi;   /* contact value */
  double ratio; /* theta/T; NaN: no answer */
  double pressure_kinetic, pressure_transfer;
  double viscosity_kinetic, viscosity_transfer;
  double loss;
} gg_newtonian;

/* T = rate^2 viscosity/loss. */
double gg_theory_newtonian_temperature(const gg_model *model, const gg_newtonian *gas);

/* Temperatures, stress, collision rates and dissipation of the steady state. */
void gg_theory_answer_newtonian_shear(const gg_model *model, const gg_newtonian *gas, gg_theory_answer *answer);

/* Smooth grains about the cooling state, V. Garzo & J.W. Dufty, Phys. Rev. E 59 (1999) 5895, with a_2 = 0; the loss is
 * that of grains of restitution e_loss. */
gg_newtonian gg_theory_garzo_dufty_gas(const gg_model *model, double e_loss);

/* Guard of theories of smooth and of frictional grains: one species, steady shear, no constant beta, and an effective
 * restitution with which smooth grains lose as much. */
gg_status gg_theory_require_effective_restitution(const gg_model *model, double effective, const char *theory,
                                                  gg_error *err);

#endif
