/* Shear viscosity of linear response about a homogeneous state: f = f0 + (shear rate) f1, f1 ~ the functions odd in x
 * and in y. Frequency and temperature are those of the isotropic state (T = 1). */
#ifndef GG_HERMITE_VISCOSITY_H
#define GG_HERMITE_VISCOSITY_H

#include "theory/hermite/isotropic.h"

typedef struct gg_hermite_viscosity {
  double kinetic, total; /* -<stress xy>/(n m shear rate) */
} gg_hermite_viscosity;

/* sigma: 0 in the Boltzmann limit. fading: rate at which f1 changes in time in the frame in which f0 does not: zeta/2
 * in a cooling gas, whose reduced shear rate grows so fast; 0 where the temperature is held. */
gg_status gg_hermite_viscosity_of(gg_hermite_isotropic *state, double sigma, double fading,
                                  gg_hermite_viscosity *viscosity, gg_error *err);

#endif
