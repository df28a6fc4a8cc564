/* The time step, from the collision and shear rates at the present temperature. */
#ifndef GG_DSMC_TIMESTEP_H
#define GG_DSMC_TIMESTEP_H

#include "common/model.h"

typedef struct gg_time_step {
  double length; /* model units */
  double settle; /* time after which to look at the ensemble again */
  double turns;  /* time in which all pairs of species take their turns, there and back */
  int64_t split; /* streaming and collisions taken in turns (Strang), rather than streaming followed exactly: a truth,
                  * as wide as its neighbours, for states are saved and compared as bytes */
  double bias;   /* estimated relative bias of the temperature */
} gg_time_step;

/* At temperature T (sum m C^2/3N). A step given by the scene (in mean free times) is split symmetrically; by default
 * the gas streams continuously between its collisions, and the step is only how often rates are looked at again, or the
 * thermostat has its turn. */
gg_time_step gg_time_step_choose(const gg_model *model, double T);

#endif
