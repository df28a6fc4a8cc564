/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heat flux and shear viscosity of linear response about an isotropic state of rough grains, at T = m = 1:
 *   f = f0 + A . grad ln T + B . grad ln n - C : grad u,
 *   q = -kappa grad T - mu grad n,   P = p - 2 eta (grad u, symmetric, without trace),
 * with theta = r T along grad T. Equations as of smooth grains (hermite/heat.h; for spins G.M. Kremer, A. Santos and V.
 * Garzo, Phys. Rev. E 90 (2014) 022205), without Sonine's approximation. */
#ifndef GG_ROUGH_RESPONSE_H
#define GG_ROUGH_RESPONSE_H

#include "theory/hermite/heat.h"
#include "theory/rough/steady.h"

typedef struct gg_rough_heat { /* of translation, and of rotation */
  double conductivity[2], conductivity_kinetic[2], diffusive[2], diffusive_kinetic[2];
} gg_rough_heat;

/* kappa/n and mu/T in units of v^2/frequency; A and B up to degree N + 1, N that of the cooling state. */
gg_status gg_rough_heat_of(const gg_rough_steady *cooling, gg_hermite_density density, gg_rough_heat *heat,
                           gg_error *err);

/* eta/(n T) in units of 1/frequency; `fading`: decay rate of the response over the rate at which f0 scales: 1/2 in a
 * cooling gas (T^-1/2), 0 if T is constant. */
typedef struct gg_rough_viscosity {
  double total, kinetic;
} gg_rough_viscosity;
gg_status gg_rough_viscosity_of(const gg_rough_steady *state, double phi_chi, double fading,
                                gg_rough_viscosity *viscosity, gg_error *err);

#endif
