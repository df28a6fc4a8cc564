/* Which kernel a step of the engine calls, and at what rate its candidates come. */
#ifndef GG_DSMC_KERNELS_H
#define GG_DSMC_KERNELS_H

#include "dsmc/kernel/collide_blocks.h"
#include "dsmc/kernel/pairing.h"
#include "dsmc/kernel/sweep.h"
#include "simd/dispatch.h"

/* One pair of grains after another, or two blocks at a time. */
typedef enum gg_path { GG_PATH_PLAIN, GG_PATH_BLOCKS } gg_path;

/* What is compiled once for each set of instructions; by precision (double, single) and rule. */
typedef struct gg_kernel_set {
  const gg_collide_instances *collide[2][GG_FRICTIONAL + 1];
  gg_sweep *sweep[2];
  gg_kicks *kicks;
} gg_kernel_set;

/* Of a set that runs here (simd/dispatch.h). */
const gg_kernel_set *gg_kernels_for(gg_instructions set);
/* The fastest one for a pair of species: plain where either has fewer than a hundred blocks, which would meet again too
 * soon. */
gg_path gg_path_choose(const gg_population *one, const gg_population *two);

/* Candidates (plain) or pairs of blocks (else) for every unit of bound x (chi sigma^2/V) x time. */
double gg_candidates(gg_path path, gg_features f, const gg_population *one, const gg_population *two);
/* The same for a meeting of blocks with blocks, or of blocks with themselves. */
double gg_block_candidates(gg_range one, gg_range two, bool themselves);
/* Largest rate, in the path's measure, of a pair whose relative speed is `speed`. */
double gg_rate_bound(gg_path path, gg_features f, double speed, double shift);

void gg_collide(const gg_kernel_set *kernels, gg_path path, gg_features f, gg_pairing *p, gg_rng_lanes *lanes,
                gg_rng *rng);

#endif
