/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of the kernel of a step, and the rate of its candidates. */
#ifndef GG_DSMC_KERNELS_H
#define GG_DSMC_KERNELS_H

#include "dsmc/kernel/collide_blocks.h"
#include "dsmc/kernel/pass.h"
#include "dsmc/kernel/synchronise.h"
#include "simd/dispatch.h"

typedef enum gg_dsmc_path {
  GG_DSMC_PLAIN, /* one pair of grains after another */
  GG_DSMC_BLOCKS /* two blocks at a time */
} gg_dsmc_path;

/* Kernels of one set of instructions, by precision (double, single), contact of its own (without, with) and rule. NULL:
 * not compiled for this set. */
typedef struct gg_dsmc_kernels {
  const gg_dsmc_instances *collide[2][2][GG_FRICTIONAL + 1];
  gg_dsmc_synchronise_blocks *synchronise[2];
  gg_dsmc_kick_blocks *kick;
} gg_dsmc_kernels;

/* Kernels of a set that this processor can run (simd/dispatch.h). */
const gg_dsmc_kernels *gg_dsmc_kernels_for(gg_instructions set);
/* Fastest path for a pair of species: plain if either has fewer than a hundred blocks, which would be paired again too
 * soon. */
gg_dsmc_path gg_dsmc_choose_path(const gg_dsmc_population *one, const gg_dsmc_population *two);

/* Number of candidates (plain path) or block pairs per unit of majorant x (chi sigma^2/V) x time. */
double gg_dsmc_candidates_per_unit(gg_dsmc_path path, gg_dsmc_features features, const gg_dsmc_population *one,
                                   const gg_dsmc_population *two);
/* The same for two ranges of blocks, or for a range with itself. */
double gg_dsmc_block_pairs_per_unit(gg_dsmc_range one, gg_dsmc_range two, bool themselves);
/* Safe majorant: the largest rate, in the measure of the path, at this relative speed. */
double gg_dsmc_sure_majorant(gg_dsmc_path path, gg_dsmc_features features, double speed, double shift);

void gg_dsmc_collide_pass(const gg_dsmc_kernels *kernels, gg_dsmc_path path, gg_dsmc_features features,
                          gg_dsmc_pass *pass, gg_dsmc_rng_lanes *lanes, gg_rng *rng);

#endif
