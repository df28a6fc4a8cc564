/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shear viscosity of linear response about a homogeneous state: f = f0 + (shear rate) f1, f1 ~ the functions odd in x
 * and in y. Frequencies and temperature are those of the isotropic state (T = 1). */
#ifndef GG_HERMITE_VISCOSITY_H
#define GG_HERMITE_VISCOSITY_H

#include "theory/hermite/operator.h"

typedef struct gg_hermite_viscosity {
  double kinetic, total; /* -<stress xy>/(n shear rate) */
} gg_hermite_viscosity;

/* Linear response about the isotropic states of all species, of this degree, which are steady under streaming and
 * diffusion of the gas. transfer: false in the Boltzmann limit, where there is no flow between centres. fading: rate
 * at which f1 changes in time in the frame in which f0 does not: zeta/2 in a cooling gas, whose reduced shear rate
 * grows so fast; 0 if the temperature is constant. */
gg_status gg_hermite_viscosity_of(const gg_hermite_gas *gas, gg_hermite_state *state, int degree, bool transfer,
                                  double fading, gg_hermite_viscosity *viscosity, gg_error *err);

#endif
