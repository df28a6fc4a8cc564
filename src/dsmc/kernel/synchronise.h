/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Synchronisation of the blocks of a species: stored velocities are mapped, summed, and their speed bounds set.
 * Compiled for several sets of instructions like the block kernels; it works lane by lane, so that all sets leave the
 * same bits. */
#ifndef GG_DSMC_SYNCHRONISE_H
#define GG_DSMC_SYNCHRONISE_H

#include "dsmc/kernel/pass.h"
#include "simd/compiled_sets.h"

typedef struct gg_dsmc_block_sums {
  gg_dsmc_block c;                                  /* sum of C */
  double c2[GG_DSMC_LANES], fastest[GG_DSMC_LANES]; /* sum and largest of C^2 */
} gg_dsmc_block_sums;

/* Map full blocks (of the precision in the name) by C = scale (x - strain y, y, z) - centre, and add to the sums. Speed
 * bounds are in units of `bound_scale`. */
typedef void gg_dsmc_synchronise_blocks(void *c, float *speed_bound, size_t n, double strain, double scale,
                                        gg_vec centre, double bound_scale, gg_dsmc_block_sums *sums);

/* Kick: x = factor x + size (widening n_x + lean n_y), y and z = factor (y, z) + size (n_y, n_z), all + drift, with
 * normal random numbers n. */
typedef struct gg_dsmc_kick_map {
  double factor, size, widening, lean;
  gg_vec drift;
} gg_dsmc_kick_map;

/* Kick full blocks that are stored with `strain`, and add their vectors to `sum` lane by lane. speed_bound (NULL: none)
 * is in units of `bound_scale`. Computed in double. */
typedef void gg_dsmc_kick_blocks(void *c, bool single, float *speed_bound, size_t n, double strain,
                                 const gg_dsmc_kick_map *map, double bound_scale, gg_dsmc_rng_lanes *lanes,
                                 gg_dsmc_block *sum);

#define GG_DSMC_DECLARE_SYNCHRONISE(set, name)                                                                         \
  gg_dsmc_synchronise_blocks gg_dsmc_synchronise_##name, gg_dsmc_synchronise_single_##name;                            \
  gg_dsmc_kick_blocks gg_dsmc_kick_##name;
GG_EACH_COMPILED_SET(GG_DSMC_DECLARE_SYNCHRONISE)

#endif
