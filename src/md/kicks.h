/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kicks: random changes of velocity by a schedule of their own, between the events of the queue. Only kicked grains are
 * re-predicted.
 *
 * White noise adds xi^2 t to the variance of each component of a velocity. The kick schedule gives each grain a slot at
 * regular intervals; the slots of all grains are distributed evenly in time and space, so T is steady. In a slot two
 * grains of a species get opposite kicks, or none: momentum stays zero. The effect of a finite interval on the
 * distribution of velocities is of second order. */
#ifndef GG_MD_KICKS_H
#define GG_MD_KICKS_H

#include "md/md_state.h"

/* True if the thermostat kicks grains; kicks at contact are another thing (common/collision.h). In a slot of a bath
 * both grains undergo the drag and noise of the whole interval, with opposite kicks. */
static inline bool gg_md_has_kicks(const gg_md *e)
{
  return e->heat == GG_HEAT_KICKS || e->heat == GG_HEAT_BATHES;
}

/* Under shear the Gaussian thermostat has no exact map, since the flow sets the clock. There it returns the energy that
 * collisions took from the velocities every half mean free time, by one factor for all peculiar velocities. In between
 * T is lower by up to a sixth (e = 0), which the reduced stress -P_xy/(n T) does not feel in first order. */
static inline bool gg_md_compensates(const gg_md *e)
{
  return e->heat == GG_HEAT_SCALES && e->model.linear_response;
}
/* Time to the next return; all grains at the same time. */
double gg_md_compensation_interval(const gg_md *e);

/* Make the kick schedule; it follows from the model and the species of the grains. */
gg_status gg_md_kicks_make(gg_md *e, gg_error *err);
/* Set the first slot of each species at a start. */
void gg_md_kicks_begin(gg_md *e);
/* Shift the times of the schedule by an epoch of this length. */
void gg_md_kicks_move(gg_md *e, double span);
/* Shorten the intervals if a gas in a bath has become too hot for them. */
void gg_md_kicks_follow(gg_md *e, double temperature);
/* Run the slot that is due at the present time, k.next_kick. */
void gg_md_kick(gg_md *e);

#endif
