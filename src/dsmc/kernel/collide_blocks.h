/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block kernels: one source, compiled for several sets of instructions, of which an engine chooses one. */
#ifndef GG_DSMC_COLLIDE_BLOCKS_H
#define GG_DSMC_COLLIDE_BLOCKS_H

#include "dsmc/kernel/pass.h"
#include "simd/compiled_sets.h"

/* s0 = (8/3 pi) sigma rate: integral of |k_x k_y| over the sphere, over pi. */
#define GG_DSMC_SHEAR_SHARE (8 / (3 * M_PI))

typedef void gg_dsmc_collide_blocks(gg_dsmc_pass *pass, gg_dsmc_rng_lanes *lanes, gg_rng *rng);

/* Instances of one collision rule, by shear, sums and whether both grains are of one species; NULL: none. */
typedef struct gg_dsmc_instances {
  gg_dsmc_collide_blocks *of[GG_DSMC_SHEARED_DENSE + 1][GG_DSMC_STRESS + 1][2];
} gg_dsmc_instances;

/* One object for each rule, precision and set of instructions (meson.build). */
#define GG_DSMC_DECLARE_PRECISION(precision, name)                                                                     \
  extern const gg_dsmc_instances gg_dsmc_collide_##precision##_smooth_##name,                                          \
      gg_dsmc_collide_##precision##_rough_##name, gg_dsmc_collide_##precision##_frictional_##name,                     \
      gg_dsmc_collide_##precision##_smooth_own_##name, gg_dsmc_collide_##precision##_frictional_own_##name;
#define GG_DSMC_DECLARE_COLLIDE(set, name)                                                                             \
  GG_DSMC_DECLARE_PRECISION(double, name) GG_DSMC_DECLARE_PRECISION(single, name)
GG_EACH_COMPILED_SET(GG_DSMC_DECLARE_COLLIDE)

#endif
