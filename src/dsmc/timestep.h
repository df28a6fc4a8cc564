/* The time step, from the collision and shear rates at the present temperature. */
#ifndef GG_DSMC_TIMESTEP_H
#define GG_DSMC_TIMESTEP_H

#include "common/model.h"

typedef struct gg_time_step {
  double length; /* model units */
  double settle; /* time after which to look at the ensemble again */
  double turns;  /* time in which all that takes turns has had them, there and back: no more than the length */
  int64_t split; /* streaming and collisions taken in turns (Strang), rather than streaming followed exactly: a truth,
                  * as wide as its neighbours, for states are saved and compared as bytes */
  double bias;   /* estimated relative bias of the temperature */
} gg_time_step;

/* At temperature T (sum m C^2/3N). Under shear a step given by the scene (in mean free times) is split; by default
 * the gas streams continuously between its collisions, and the step is only how often rates are looked at again, or the
 * thermostat has its turn. */
gg_time_step gg_time_step_choose(const gg_model *model, double T);

#endif
