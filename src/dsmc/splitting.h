/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric (Strang) splitting over species pairs: they collide one after another, 11, 12, 22, then in the reverse
 * order, and so on, so that errors of the first order cancel.
 *
 * Substeps are much shorter than a step, which with nothing but collisions and streaming in it is only how long rates
 * hold: the splitting error goes with the square of the time in which all pairs have had theirs, in both orders. */
#ifndef GG_DSMC_SPLITTING_H
#define GG_DSMC_SPLITTING_H

#include <stdbool.h>

#include "dsmc/time_step.h"

/* All pairs once in their order, or once in the reverse order, or in both as often as it takes. */
typedef enum gg_dsmc_splitting { GG_DSMC_FORWARD, GG_DSMC_BACKWARD, GG_DSMC_SYMMETRIC } gg_dsmc_splitting;

enum { GG_DSMC_MAX_SWEEPS = 32, GG_DSMC_MAX_SUBSTEPS = 1 + (GG_PAIRS - 1) * GG_DSMC_MAX_SWEEPS };

/* Collisions of one species pair; begin and length in sweeps, each of which has one substep of every pair. */
typedef struct gg_dsmc_substep {
  int pair, begin, length;
} gg_dsmc_substep;

/* Strains over which speed bounds are to hold from the beginning of a substep on, `span` being that of a sweep: those
 * of the longest substep. Of one species or two they follow the strain instead, from candidate to candidate. There and
 * back again for each of many pairs would let them grow without end. */
double gg_dsmc_strains_to_hold(int n_species, double span);
/* How many sweeps an interval `dt` takes; in each of so many equal parts of it. */
int gg_dsmc_sweeps_of(const gg_dsmc_time_step *step, gg_dsmc_splitting splitting, double dt);
int gg_dsmc_sweeps_of_part(const gg_dsmc_time_step *step, gg_dsmc_splitting splitting, double dt, int parts);
/* The substeps of so many sweeps, every second of them in the reverse order; two in a row of one pair are joined.
 * Returns how many there are. */
int gg_dsmc_list_substeps(int pairs, gg_dsmc_splitting splitting, int sweeps,
                          gg_dsmc_substep substep[GG_DSMC_MAX_SUBSTEPS]);

#endif
