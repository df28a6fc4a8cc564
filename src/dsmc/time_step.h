/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The time step, from the collision and shear rates at the present temperature. */
#ifndef GG_DSMC_TIME_STEP_H
#define GG_DSMC_TIME_STEP_H

#include "common/model.h"

typedef struct gg_dsmc_time_step {
  double length;      /* model units */
  double synchronise; /* time after which stored velocities are synchronised and the temperature is measured */
  double splitting;   /* time of one symmetric splitting over species pairs or with a thermostat; at most the length */
  int64_t split;      /* 1: streaming is split from collisions (Strang); 0: it is exact. As wide as the other members,
                       * since states are saved and compared as bytes */
  double bias;        /* estimated relative bias of the temperature */
} gg_dsmc_time_step;

/* Choose the step at temperature T (sum m C^2/3N). Under shear a step given by the scene (in mean free times) is split.
 * By default the gas streams exactly between its collisions, and the step is only the time after which rates are
 * renewed, or the thermostat acts. */
gg_dsmc_time_step gg_dsmc_time_step_choose(const gg_model *model, double T);

#endif
