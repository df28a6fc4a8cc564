#include "dsmc/kernel/kernels.h"

#include "dsmc/parallel/segments.h"

#define KERNELS(set, name)                                                                                             \
  [set] = {.collide = {{&gg_collide_double_smooth_##name, &gg_collide_double_rough_##name,                             \
                        &gg_collide_double_frictional_##name},                                                         \
                       {&gg_collide_single_smooth_##name, &gg_collide_single_rough_##name,                             \
                        &gg_collide_single_frictional_##name}},                                                        \
           .sweep = {gg_sweep_##name, gg_sweep_single_##name},                                                         \
           .kicks = gg_kicks_##name},

const gg_kernel_set *gg_kernels_for(gg_instructions set)
{
  static const gg_kernel_set sets[GG_INSTRUCTION_SETS] = {GG_EACH_COMPILED_SET(KERNELS)};
  return &sets[set];
}

gg_path gg_path_choose(const gg_population *one, const gg_population *two)
{
  return one->n_blocks < 100 || two->n_blocks < 100 ? GG_PATH_PLAIN : GG_PATH_BLOCKS;
}

double gg_candidates(gg_path path, gg_features f, const gg_population *one, const gg_population *two)
{
  if (path == GG_PATH_PLAIN) {
    double n = (double)one->n, pairs = f.same ? 0.5 * n * (n - 1) : n * (double)two->n;
    return 4 * M_PI * pairs;
  }
  return gg_block_candidates(gg_all_blocks(one), gg_all_blocks(two), f.same);
}

/* A draw of two blocks gives each of the pairs between them 1/8; among themselves they come in either order. */
double gg_block_candidates(gg_range one, gg_range two, bool themselves)
{
  return M_PI * 8 * (themselves ? 0.5 : 1) * ((double)one.n * (double)two.n);
}

double gg_rate_bound(gg_path path, gg_features f, double speed, double shift)
{
  if (f.shear != GG_SHEARED_DENSE) return speed;
  return speed + (path == GG_PATH_PLAIN ? 0.5 : GG_SHEAR_SHARE) * shift; /* |k_x k_y| <= 1/2 */
}

void gg_collide(const gg_kernel_set *kernels, gg_path path, gg_features f, gg_pairing *p, gg_rng_lanes *lanes,
                gg_rng *rng)
{
  if (path == GG_PATH_PLAIN)
    gg_collide_plain(f, p, rng);
  else
    kernels->collide[p->one->single][f.rule]->of[f.shear][f.tap][f.same](p, lanes, rng);
}
