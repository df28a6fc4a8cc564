/* One pass through the blocks of a species: what settling needs of all grains, done at once. Compiled for several
 * sets of instructions like the block kernels; lane by lane, so that all leave the same bits. */
#ifndef GG_DSMC_SWEEP_H
#define GG_DSMC_SWEEP_H

#include "dsmc/kernel/pairing.h"
#include "simd/compiled_sets.h"

typedef struct gg_sums {
  gg_block c;                             /* sum of C */
  double c2[GG_LANES], fastest[GG_LANES]; /* sum and largest of C^2 */
} gg_sums;

/* C = scale (x - drift y, y, z) - centre for full blocks (of the precision in the name), summing as it goes; tops in
 * `unit`. */
typedef void gg_sweep(void *c, float *top, size_t n, double drift, double scale, gg_vec centre, double unit,
                      gg_sums *sums);

/* C += size (n_x, n_y, n_z) with normal n, for full blocks stored with `drift`; tops in `unit`. Computed in double. */
typedef void gg_kicks(void *c, bool single, float *top, size_t n, double drift, double size, double unit,
                      gg_rng_lanes *lanes);

#define GG_DECLARE_SWEEPS(set, name)                                                                                   \
  gg_sweep gg_sweep_##name, gg_sweep_single_##name;                                                                    \
  gg_kicks gg_kicks_##name;
GG_EACH_COMPILED_SET(GG_DECLARE_SWEEPS)

#endif
