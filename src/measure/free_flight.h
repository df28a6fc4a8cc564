/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws of free flight in a gas of hard spheres with Maxwellian velocities and molecular chaos, for comparison with
 * measured flights. A grain of speed c collides nu(c) times a unit of time (Chapman & Cowling, section 5.4), so that
 * flights at c, whose number is nu(c) f(c), last longer than t with probability exp(-nu t). The laws are close to
 * exponentials, but not exponential: slow grains collide seldom, and their paths are still short. */
#ifndef GG_FREE_FLIGHT_H
#define GG_FREE_FLIGHT_H

#include "common/model.h"
#include "measure/curve.h"

/* Parameters of the laws: the mean, to be set, and nu at the speeds of their integral, in any unit. In mixtures
 * every species has its own law: heavy grains are slow among light ones, which collide with them at a constant rate.
 * All species have one temperature. */
enum { GG_FLIGHT_SPEEDS = 60, GG_FLIGHT_MEAN = 0, GG_FLIGHT_LAW = 1 + GG_FLIGHT_SPEEDS };
void gg_measure_free_flight_of(const gg_model *model, int species, double law[GG_FLIGHT_LAW]);

/* Probability density at x. */
gg_curve_law gg_measure_free_time_law, gg_measure_free_path_law;

#endif
