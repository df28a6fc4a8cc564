/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heat flux of linear response about the cooling state of smooth grains of one species, T = m = 1:
 *   f = f0 + A . grad ln T + B . grad ln n,   q = -kappa grad T - mu grad n.
 * Equations for A and B: J.J. Brey, J.W. Dufty, C.S. Kim and A. Santos, Phys. Rev. E 58 (1998) 4638 (dilute); V. Garzo
 * and J.W. Dufty, Phys. Rev. E 59 (1999) 5895 (Enskog), here without their first Sonine approximation. */
#ifndef GG_HERMITE_HEAT_H
#define GG_HERMITE_HEAT_H

#include "theory/hermite/isotropic.h"

typedef struct gg_hermite_heat {
  double conductivity, conductivity_kinetic; /* kappa/n, in units of v^2/frequency at T = m = 1 */
  double diffusive, diffusive_kinetic;       /* mu/T */
} gg_hermite_heat;

/* Density dependence: phi chi, and d ln chi/d ln n. Both 0 in the Boltzmann limit. */
typedef struct gg_hermite_density {
  double phi_chi, slope;
} gg_hermite_density;

/* A and B up to degree N + 1, where N is that of the cooling state. */
gg_status gg_hermite_heat_of(const gg_hermite_isotropic *cooling, gg_hermite_density density, gg_hermite_heat *heat,
                             gg_error *err);

#endif
