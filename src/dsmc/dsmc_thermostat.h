/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The thermostats. They act once in the middle of every step, between two halves of its collisions.
 *
 * Gaussian: the force m zeta C/2 returns exactly the energy lost in collisions (Montanero's review, eqs 8 and 16), so
 * an unsheared gas keeps its temperature and a sheared gas is heated by viscous work alone. It has no torque, but spins
 * exchange energy with the centres: for rough unsheared grains the energy of the centres is kept. White noise:
 * independent kicks of variance xi^2 dt along each axis, the same for every species (van Noije & Ernst, Granular Matter
 * 1 (1998) 57); xi is constant, and such that the gas stays near its initial temperature. */
#ifndef GG_DSMC_THERMOSTAT_H
#define GG_DSMC_THERMOSTAT_H

#include "dsmc/ensemble.h"
#include "dsmc/kernel/pass.h"

/* Return energy in the middle of a step: `missing` or, if `kept` is not 0, the difference of the centres' energy from
 * `kept`; and in advance the expected loss of the second half, if that of the first was `half`, so that steps begin and
 * end at the kept energy. Returns the advance. Velocities are stored with `strain`. */
double gg_dsmc_thermostat_return(gg_dsmc_ensemble *e, double strain, double kept, double missing, double half);
/* Kick every grain with `variance` along each axis. `lanes`: random streams of each segment. */
void gg_dsmc_thermostat_kick(gg_dsmc_ensemble *e, double strain, double variance, gg_dsmc_rng_lanes *lanes);

/* A step of the bath. */
typedef struct gg_dsmc_bath_step {
  double begin;  /* strain at its beginning */
  double strain; /* strain in its middle, with which velocities are stored */
  double dt;     /* length */
} gg_dsmc_bath_step;
/* Apply drag, noise and shear of a step together, exactly (an Ornstein-Uhlenbeck process). Streaming does not change
 * stored velocities; for them drag is a factor, and a kick along y at a later strain is also a kick along x.
 *
 * *centre, the stored velocity of the centre of mass, is removed before; afterwards it is that of the kicks of this
 * step alone, with a variance of at most T/N per component. If it were removed after the drag, it would be
 * overcompensated by 1/d at a decay d, without bound. */
void gg_dsmc_thermostat_bath(gg_dsmc_ensemble *e, const gg_model *model, const gg_dsmc_bath_step *step, gg_vec *centre,
                             gg_dsmc_rng_lanes *lanes);

#endif
