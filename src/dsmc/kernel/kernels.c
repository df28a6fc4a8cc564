/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/kernel/kernels.h"

#include <math.h>

#include "dsmc/parallel/schedule.h"

/* Kernels of one precision in a set: of every rule, or of rough grains alone (GG_DSMC_SINGLE_... of quick sets). */
#define EVERY_RULE(precision, name)                                                                                    \
  {                                                                                                                    \
    {&gg_dsmc_collide_##precision##_smooth_##name, &gg_dsmc_collide_##precision##_rough_##name,                        \
     &gg_dsmc_collide_##precision##_frictional_##name},                                                                \
    {                                                                                                                  \
      [GG_SMOOTH] = &gg_dsmc_collide_##precision##_smooth_own_##name,                                                  \
      [GG_FRICTIONAL] = &gg_dsmc_collide_##precision##_frictional_own_##name                                           \
    }                                                                                                                  \
  }
#define ROUGH_ALONE(precision, name)                                                                                   \
  {                                                                                                                    \
    {                                                                                                                  \
      [GG_ROUGH] = &gg_dsmc_collide_##precision##_rough_##name                                                         \
    }                                                                                                                  \
  }
#ifdef GG_DOUBLE_ALONE
#define KERNELS(set, name)                                                                                             \
  [set] = {.collide = {EVERY_RULE(double, name)},                                                                      \
           .synchronise = {gg_dsmc_synchronise_##name},                                                                \
           .kick = gg_dsmc_kick_##name},
#else
#define KERNELS(set, name)                                                                                             \
  [set] = {.collide = {EVERY_RULE(double, name), GG_DSMC_SINGLE_##name(single, name)},                                 \
           .synchronise = {gg_dsmc_synchronise_##name, gg_dsmc_synchronise_single_##name},                             \
           .kick = gg_dsmc_kick_##name},
#endif

const gg_dsmc_kernels *gg_dsmc_kernels_for(gg_instructions set)
{
  static const gg_dsmc_kernels sets[GG_INSTRUCTION_SETS] = {GG_EACH_COMPILED_SET(KERNELS)};
  return &sets[set];
}

gg_dsmc_path gg_dsmc_choose_path(const gg_dsmc_population *one, const gg_dsmc_population *two)
{
  return one->n_blocks < 100 || two->n_blocks < 100 ? GG_DSMC_PLAIN : GG_DSMC_BLOCKS;
}

double gg_dsmc_candidates_per_unit(gg_dsmc_path path, gg_dsmc_features features, const gg_dsmc_population *one,
                                   const gg_dsmc_population *two)
{
  if (path == GG_DSMC_PLAIN) {
    double n = (double)one->n, pairs = features.same ? 0.5 * n * (n - 1) : n * (double)two->n;
    return 4 * M_PI * pairs;
  }
  return gg_dsmc_block_pairs_per_unit(gg_dsmc_all_blocks(one), gg_dsmc_all_blocks(two), features.same);
}

/* A draw of two blocks is a candidate of each pair of their grains with probability 1/8. Blocks of one range are drawn
 * in either order. */
double gg_dsmc_block_pairs_per_unit(gg_dsmc_range one, gg_dsmc_range two, bool themselves)
{
  return M_PI * 8 * (themselves ? 0.5 : 1) * ((double)one.n * (double)two.n);
}

double gg_dsmc_sure_majorant(gg_dsmc_path path, gg_dsmc_features features, double speed, double shift)
{
  if (features.shear != GG_DSMC_SHEARED_DENSE) return speed;
  return speed + (path == GG_DSMC_PLAIN ? 0.5 : GG_DSMC_SHEAR_SHARE) * fabs(shift); /* |k_x k_y| <= 1/2 */
}

void gg_dsmc_collide_pass(const gg_dsmc_kernels *kernels, gg_dsmc_path path, gg_dsmc_features features,
                          gg_dsmc_pass *pass, gg_dsmc_rng_lanes *lanes, gg_rng *rng)
{
  if (path == GG_DSMC_PLAIN)
    gg_dsmc_collide_plain(features, pass, rng);
  else
    kernels->collide[pass->one->single][features.own][features.rule]->of[features.shear][features.sums][features.same](
        pass, lanes, rng);
}
