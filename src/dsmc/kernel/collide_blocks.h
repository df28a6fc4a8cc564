/* The block kernels: one source, compiled for several sets of instructions, chosen when an engine is made. */
#ifndef GG_DSMC_COLLIDE_BLOCKS_H
#define GG_DSMC_COLLIDE_BLOCKS_H

#include "dsmc/kernel/pairing.h"

/* s0 = (8/3 pi) sigma rate: integral of |k_x k_y| over the sphere, over pi. */
#define GG_SHEAR_SHARE (8 / (3 * M_PI))

typedef void gg_collide_blocks(gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng);

/* The kernel for these features, from each set of instructions. NULL where there is no such thing. */
gg_collide_blocks *gg_collide_blocks_baseline(gg_features f);
gg_collide_blocks *gg_collide_blocks_avx2(gg_features f);
gg_collide_blocks *gg_collide_blocks_avx512(gg_features f);
/* For ensembles kept in single precision. */
gg_collide_blocks *gg_collide_blocks_single_baseline(gg_features f);
gg_collide_blocks *gg_collide_blocks_single_avx2(gg_features f);
gg_collide_blocks *gg_collide_blocks_single_avx512(gg_features f);

#endif
