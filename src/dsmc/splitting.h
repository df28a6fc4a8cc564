/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric (Strang) splitting over species pairs: they collide one after another, 11, 12, 22, then in the reverse
 * order, and so on, so that errors of the first order cancel.
 *
 * Substeps are much shorter than a step. A step of collisions and streaming only is the time after which rates are
 * renewed; the splitting error is proportional to the square of the time in which all pairs have had their substeps in
 * both orders. */
#ifndef GG_DSMC_SPLITTING_H
#define GG_DSMC_SPLITTING_H

#include <stdbool.h>

#include "dsmc/time_step.h"

typedef enum gg_dsmc_splitting {
  GG_DSMC_FORWARD,  /* all pairs once in their order */
  GG_DSMC_BACKWARD, /* all pairs once in the reverse order */
  GG_DSMC_SYMMETRIC /* both orders, as often as the step needs */
} gg_dsmc_splitting;

enum { GG_DSMC_MAX_SWEEPS = 32, GG_DSMC_MAX_SUBSTEPS = 1 + (GG_PAIRS - 1) * GG_DSMC_MAX_SWEEPS };

/* Collisions of one species pair. begin and length are in sweeps; a sweep has one substep of every pair. */
typedef struct gg_dsmc_substep {
  int pair, begin, length;
} gg_dsmc_substep;

/* Range of strains, from the beginning of a substep, over which speed bounds must hold: that of the longest substep;
 * `span` is the strain of a sweep. 0, for one or two species: the bounds follow the strain from candidate to candidate.
 * With many pairs, following it back and forth would let them grow without bound. */
double gg_dsmc_strains_to_hold(int n_species, double span);
/* Number of sweeps of an interval `dt`. */
int gg_dsmc_sweeps_of(const gg_dsmc_time_step *step, gg_dsmc_splitting splitting, double dt);
/* The same for each of `parts` equal parts of the interval. */
int gg_dsmc_sweeps_of_part(const gg_dsmc_time_step *step, gg_dsmc_splitting splitting, double dt, int parts);
/* List the substeps of so many sweeps, every second sweep in the reverse order; two successive substeps of one pair are
 * joined. Returns their number. */
int gg_dsmc_list_substeps(int pairs, gg_dsmc_splitting splitting, int sweeps,
                          gg_dsmc_substep substep[GG_DSMC_MAX_SUBSTEPS]);

#endif
