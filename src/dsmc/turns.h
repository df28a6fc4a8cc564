/* Pairs of species collide in turns: 11, 12, 22, and backwards, and so on, so that errors of the first order cancel.
 *
 * Turns are much shorter than a step, which with nothing but collisions and streaming in it is only how long rates
 * hold: what taking turns errs by goes with the square of the time in which all pairs have had theirs, there and back.
 */
#ifndef GG_DSMC_TURNS_H
#define GG_DSMC_TURNS_H

#include <stdbool.h>

#include "dsmc/timestep.h"

/* All pairs once in their order, or once in the reverse order, or there and back as often as it takes. */
typedef enum gg_order_of_turns { GG_TURNS_THERE, GG_TURNS_BACK, GG_TURNS_THERE_AND_BACK } gg_order_of_turns;

enum { GG_MOST_SWEEPS = 32, GG_MOST_TURNS = 1 + (GG_PAIRS - 1) * GG_MOST_SWEEPS };

/* Begins and lasts in sweeps, each of which has one turn of all pairs. */
typedef struct gg_turn {
  int pair, begin, length;
} gg_turn;

/* How many sweeps a stretch `dt` takes in this order; in each of so many equal parts of it: all of one kind. */
int gg_sweeps_of(const gg_time_step *step, gg_order_of_turns order, double dt);
int gg_sweeps_of_a_part(const gg_time_step *step, gg_order_of_turns order, double dt, int parts);
/* The turns of so many sweeps, every second of them the other way; a pair that has just had a turn goes on with it.
 * Returns how many there are. */
int gg_list_turns(int pairs, gg_order_of_turns order, int sweeps, gg_turn turn[GG_MOST_TURNS]);

#endif
