/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which kernel a step of the engine calls, and at what rate its candidates come. */
#ifndef GG_DSMC_KERNELS_H
#define GG_DSMC_KERNELS_H

#include "dsmc/kernel/collide_blocks.h"
#include "dsmc/kernel/pass.h"
#include "dsmc/kernel/synchronise.h"
#include "simd/dispatch.h"

/* One pair of grains after another, or two blocks at a time. */
typedef enum gg_dsmc_path { GG_DSMC_PLAIN, GG_DSMC_BLOCKS } gg_dsmc_path;

/* What is compiled once for each set of instructions; by precision (double, single), with a law of restitution, and
 * rule. */
typedef struct gg_dsmc_kernels {
  const gg_dsmc_instances *collide[2][2][GG_FRICTIONAL + 1];
  gg_dsmc_synchronise_blocks *synchronise[2];
  gg_dsmc_kick_blocks *kick;
} gg_dsmc_kernels;

/* Of a set that runs here (simd/dispatch.h). */
const gg_dsmc_kernels *gg_dsmc_kernels_for(gg_instructions set);
/* The fastest one for a pair of species: plain where either has fewer than a hundred blocks, which would be paired
 * again too soon. */
gg_dsmc_path gg_dsmc_choose_path(const gg_dsmc_population *one, const gg_dsmc_population *two);

/* Candidates (plain) or pairs of blocks (else) for every unit of majorant x (chi sigma^2/V) x time. */
double gg_dsmc_candidates_per_unit(gg_dsmc_path path, gg_dsmc_features features, const gg_dsmc_population *one,
                                   const gg_dsmc_population *two);
/* The same for two ranges of blocks, or a range with itself. */
double gg_dsmc_block_pairs_per_unit(gg_dsmc_range one, gg_dsmc_range two, bool themselves);
/* A majorant that holds for sure: the largest rate, in the path's measure, at this relative speed. */
double gg_dsmc_sure_majorant(gg_dsmc_path path, gg_dsmc_features features, double speed, double shift);

void gg_dsmc_collide_pass(const gg_dsmc_kernels *kernels, gg_dsmc_path path, gg_dsmc_features features,
                          gg_dsmc_pass *pass, gg_dsmc_rng_lanes *lanes, gg_rng *rng);

#endif
