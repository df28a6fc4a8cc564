/* Laws of free flight in a gas of hard spheres with Maxwellian velocities and molecular chaos, to see measured ones
 * beside: a grain of speed c collides nu(c) times a unit of time (Chapman & Cowling, section 5.4), so that flights at
 * c, as many as nu(c) f(c), last longer than t with probability exp(-nu t). Close to exponentials, but not exponential:
 * slow grains collide seldom, and their paths are short all the same. */
#ifndef GG_FREE_FLIGHT_H
#define GG_FREE_FLIGHT_H

#include "measure/curve.h"

/* Probability density at x; the parameter is the mean. */
gg_curve_law gg_free_time_law, gg_free_path_law;

#endif
