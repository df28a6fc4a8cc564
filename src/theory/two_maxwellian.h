/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rough grains with Maxwellian velocities and Maxwellian spins: exchange between translation and rotation. */
#ifndef GG_TWO_MAXWELLIAN_H
#define GG_TWO_MAXWELLIAN_H

#include "theory/answer.h"

/* Changes of translational and rotational energy in one collision of two grains, in units of m T: dT/dt = nu dE_tr
 * T/3, dtheta/dt = nu dE_rot T/3. `ratio` is theta/T; mu = INFINITY: constant beta. */
typedef struct gg_exchange {
  double translation, rotation;
} gg_exchange;
gg_exchange gg_theory_exchange_at(gg_grain grain, double mu, double ratio);

/* -dE_tr in free cooling, which equals -dE_rot/r. The larger of both is used: spins that hardly cool return nearly
 * all the energy that translation loses. */
double gg_theory_cooling_at(gg_grain grain, double mu, double ratio);

/* Friction as a constant beta that does the same work, <J_t g_t>/<g_t^2>: that eta_2. */
double gg_theory_mean_grip(gg_grain grain, double mu, double ratio);

/* Fraction of collisions that slide. */
double gg_theory_sliding_fraction(gg_grain grain, double mu, double ratio);

/* theta/T at which rotation neither gains nor loses energy (translation driven), or at which both cool alike (free
 * cooling); NaN if there is none. */
double gg_theory_ratio_driven(gg_grain grain, double mu);
double gg_theory_ratio_cooling(gg_grain grain, double mu);

#endif
