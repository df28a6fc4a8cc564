/* The block kernels: one source, compiled for several sets of instructions, chosen when an engine is made. */
#ifndef GG_DSMC_COLLIDE_BLOCKS_H
#define GG_DSMC_COLLIDE_BLOCKS_H

#include "dsmc/kernel/pairing.h"
#include "simd/compiled_sets.h"

/* s0 = (8/3 pi) sigma rate: integral of |k_x k_y| over the sphere, over pi. */
#define GG_SHEAR_SHARE (8 / (3 * M_PI))

typedef void gg_collide_blocks(gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng);

/* The instances of one collision rule, by shear, tap and whether both grains are of one species; NULL where there is
 * no such thing. */
typedef struct gg_collide_instances {
  gg_collide_blocks *of[GG_SHEARED_DENSE + 1][GG_TAP_STRESS + 1][2];
} gg_collide_instances;

/* One object for each rule, precision and set of instructions (meson.build). */
#define GG_DECLARE_COLLIDE(set, name)                                                                                  \
  extern const gg_collide_instances gg_collide_double_smooth_##name, gg_collide_double_rough_##name,                   \
      gg_collide_double_frictional_##name, gg_collide_single_smooth_##name, gg_collide_single_rough_##name,            \
      gg_collide_single_frictional_##name;
GG_EACH_COMPILED_SET(GG_DECLARE_COLLIDE)

#endif
