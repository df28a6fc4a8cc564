/* One pass through the blocks of a species: what settling needs of all grains, done at once. Compiled for several
 * sets of instructions like the block kernels; lane by lane, so that all leave the same bits. */
#ifndef GG_DSMC_SWEEP_H
#define GG_DSMC_SWEEP_H

#include "dsmc/kernel/pairing.h"

typedef struct gg_sums {
  gg_block c;                             /* sum of C */
  double c2[GG_LANES], fastest[GG_LANES]; /* sum and largest of C^2 */
} gg_sums;

/* C = scale (x - drift y, y, z) - centre for full blocks (of the precision in the name), summing as it goes; tops in
 * `unit`. */
typedef void gg_sweep(void *c, float *top, size_t n, double drift, double scale, gg_vec centre, double unit,
                      gg_sums *sums);
gg_sweep gg_sweep_baseline, gg_sweep_avx2, gg_sweep_avx512;
gg_sweep gg_sweep_single_baseline, gg_sweep_single_avx2, gg_sweep_single_avx512;

/* C += size (n_x, n_y, n_z) with normal n, for full blocks stored with `drift`; tops in `unit`. Computed in double. */
typedef void gg_kicks(void *c, bool single, float *top, size_t n, double drift, double size, double unit,
                      gg_rng_lanes *lanes);
gg_kicks gg_kicks_baseline, gg_kicks_avx2, gg_kicks_avx512;

/* By this processor's best. */
void gg_sweep_blocks(void *c, bool single, float *top, size_t n, double drift, double scale, gg_vec centre, double unit,
                     gg_sums *sums);
gg_kicks gg_kick_blocks;

#endif
