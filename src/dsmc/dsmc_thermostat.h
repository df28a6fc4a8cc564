/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The thermostats: they act once in the middle of every step, between two halves of its collisions.
 *
 * Gaussian: the force m zeta C/2 that gives back exactly the energy that collisions destroyed (Montanero's review, eqs
 * 8 and 16), so that an unsheared gas keeps its temperature and a sheared one heats by viscous work alone. Spins, which
 * it does not turn, exchange energy with the centres: of rough unsheared grains that of the centres is kept. White
 * noise: independent kicks of variance xi^2 dt along each axis, the same for every species (van Noije & Ernst, Granular
 * Matter 1 (1998) 57); xi is constant, and such that the gas stays near its initial temperature. */
#ifndef GG_DSMC_THERMOSTAT_H
#define GG_DSMC_THERMOSTAT_H

#include "dsmc/ensemble.h"
#include "dsmc/kernel/pass.h"

/* In the middle of a step: give back the energy that is `missing` (where `kept` is not 0: what centres have less than
 * that) and, in advance, what the second half will destroy if the first destroyed `half`, so that steps begin and end
 * at the kept energy. Returns the advance. Velocities are stored with `strain`. */
double gg_dsmc_thermostat_return(gg_dsmc_ensemble *e, double strain, double kept, double missing, double half);
/* Kick every grain: `variance` along each axis; each segment of the ensemble has `lanes` of its own. */
void gg_dsmc_thermostat_kick(gg_dsmc_ensemble *e, double strain, double variance, gg_dsmc_rng_lanes *lanes);

/* A step of the bath: the strain at its beginning, that in its middle at which velocities are stored, its length. */
typedef struct gg_dsmc_bath_step {
  double begin, strain, dt;
} gg_dsmc_bath_step;
/* What drag, noise and shear do together in the step, exactly (an Ornstein-Uhlenbeck process): in stored velocities,
 * which streaming leaves alone, drag is a factor, and a kick along y at a later strain is one along x as well.
 *
 * `centre`, the stored velocity of the centre of mass, is taken off before; afterwards it is what the kicks of this
 * step alone gave it, at most T/N per component. Taken off after drag has damped it, it would be overcompensated: with
 * a decay d by a factor 1/d, without bound. */
void gg_dsmc_thermostat_bath(gg_dsmc_ensemble *e, const gg_model *model, const gg_dsmc_bath_step *step, gg_vec *centre,
                             gg_dsmc_rng_lanes *lanes);

#endif
