/* Which kernel a step of the engine calls, and at what rate its candidates come. */
#ifndef GG_DSMC_KERNELS_H
#define GG_DSMC_KERNELS_H

#include "dsmc/kernel/pairing.h"

typedef enum gg_path {
  GG_PATH_PLAIN,
  GG_PATH_BASELINE, /* blocks, with the instructions that every processor has */
  GG_PATH_AVX2,
  GG_PATH_AVX512,
  GG_PATHS
} gg_path;

/* Can this processor take it? */
bool gg_path_runs_here(gg_path path);
/* The fastest one for a pair of species: plain where either has fewer than a hundred blocks, which would meet again too
 * soon. */
gg_path gg_path_choose(const gg_population *one, const gg_population *two);

/* Candidates (plain) or pairs of blocks (else) for every unit of bound x (chi sigma^2/V) x time. */
double gg_candidates(gg_path path, gg_features f, const gg_population *one, const gg_population *two);
/* The same for a meeting of blocks with blocks, or of blocks with themselves. */
double gg_block_candidates(gg_range one, gg_range two, bool themselves);
/* Largest rate, in the path's measure, of a pair whose relative speed is `speed`. */
double gg_rate_bound(gg_path path, gg_features f, double speed, double shift);

void gg_collide(gg_path path, gg_features f, gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng);

#endif
