/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kicks: random changes of velocity at times of their own, between the events of the queue, after which those grains
 * alone are predicted anew.
 *
 * White noise adds xi^2 t to the variance of each component of a velocity. Each grain has a turn at regular intervals,
 * the turns of all evenly in time and space: T is steady. At a turn two grains of a species get opposite kicks, or
 * none: momentum stays zero. What is left of the interval in the distribution of velocities is of second order in it.
 */
#ifndef GG_MD_KICKS_H
#define GG_MD_KICKS_H

#include "md/md_state.h"

/* A bath does at each turn what drag and noise would have done since the last one (an Ornstein-Uhlenbeck process, exact
 * for a grain that has not collided since); the two grains get opposite Gaussian kicks. */
static inline bool gg_md_has_kicks(const gg_md *e)
{
  return e->thermostat == GG_WHITE_NOISE || e->thermostat == GG_BATH;
}

/* Who has a turn when; all of it follows from the model and the grains. */
gg_status gg_md_kicks_make(gg_md *e, gg_error *err);
/* At a start: everybody's first turn is to come. */
void gg_md_kicks_begin(gg_md *e);
/* An epoch of this length is over. */
void gg_md_kicks_move(gg_md *e, double span);
/* More frequent turns where a gas in a bath has become hotter than they are made for. */
void gg_md_kicks_follow(gg_md *e, double temperature);
/* The turn that is due at the present time, k.next_kick. */
void gg_md_kick(gg_md *e);

#endif
