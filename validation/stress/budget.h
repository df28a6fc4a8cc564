/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Balances from collision to collision: the energy against the losses and the work of shear, walls and gravity; each
 * collision against the collision rule and the conservation of momentum and angular momentum. */
#ifndef STRESS_BUDGET_H
#define STRESS_BUDGET_H

#include "sample.h"

typedef struct budget {
  double energy; /* largest |change - (work - losses)| over the largest energy; NAN: this flow's heating is not known */
  double energy_allowed; /* rounding; of sheared Monte Carlo, whose work is read at the ends of steps, more */
  double rule;           /* largest departure of a collision from its rule, over the speeds in it */
  bool in_time;          /* no step took negative time, none a collision too many */
} budget;

/* Go on by `steps` collisions, one at a time. */
gg_status budget_follow(gg_simulation *g, sample *before, sample *after, int steps, budget *b, gg_error *err);

#endif
