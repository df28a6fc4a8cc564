/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kicks of white noise and baths: a random kick for every grain, computed in double for blocks of either precision. */
#include "dsmc/kernel/synchronise.h"

#include "dsmc/kernel/normal.h"

#define NAME_OF(name, instructions) name##_##instructions
#define NAME(name, instructions) NAME_OF(name, instructions)

/* Load lanes from `at` of block b; `single` is constant. */
GG_INLINE gg_vd3 load(const void *blocks, bool single, size_t b, int at)
{
  if (single) {
    const gg_dsmc_block_single *block = (const gg_dsmc_block_single *)blocks + b;
    return (gg_vd3){gg_dsmc_load_single(block->x + at), gg_dsmc_load_single(block->y + at),
                    gg_dsmc_load_single(block->z + at)};
  }
  const gg_dsmc_block *block = (const gg_dsmc_block *)blocks + b;
  return (gg_vd3){gg_load(block->x + at), gg_load(block->y + at), gg_load(block->z + at)};
}

/* Store lanes, and return their rounded values. */
GG_INLINE gg_vd3 store(void *blocks, bool single, size_t b, int at, gg_vd3 v)
{
  if (single) {
    gg_dsmc_block_single *block = (gg_dsmc_block_single *)blocks + b;
    return (gg_vd3){gg_dsmc_store_single(block->x + at, v.x), gg_dsmc_store_single(block->y + at, v.y),
                    gg_dsmc_store_single(block->z + at, v.z)};
  }
  gg_dsmc_block *block = (gg_dsmc_block *)blocks + b;
  gg_store(block->x + at, v.x);
  gg_store(block->y + at, v.y);
  gg_store(block->z + at, v.z);
  return v;
}

GG_INLINE void kick(void *c, bool single, float *speed_bound, size_t n, double strain, gg_dsmc_kick_map map,
                    double bound_scale, gg_dsmc_rng_lanes *lanes, gg_dsmc_block *sum)
{
  const double per_scale = gg_dsmc_per_bound(bound_scale);
  gg_vd3 all[GG_PARTS];
  for (int part = 0; part < GG_PARTS; part++) all[part] = load(sum, false, 0, part * GG_WIDTH);
  gg_dsmc_lane_rng rng;
  gg_dsmc_lane_rng_load(&rng, lanes);
  for (size_t b = 0; b < n; b++) {
    gg_vd fastest = gg_all(0);
    for (int first = 0; first < GG_PARTS; first += GG_NORMAL_PARTS) {
      gg_vd one[GG_NORMALS], other[GG_NORMALS];
      gg_dsmc_lane_normals(&rng, first, one, other);
      for (int i = 0; i < GG_NORMAL_PARTS; i++) {
        const int part = first + i, at = part * GG_WIDTH;
        const gg_vd x = one[2 * i], y = other[2 * i], z = one[2 * i + 1];
        gg_vd3 v = load(c, single, b, at);
        v.x = map.factor * v.x + map.size * (map.widening * x + map.lean * y) + map.drift.x;
        v.y = map.factor * v.y + map.size * y + map.drift.y;
        v.z = map.factor * v.z + map.size * z + map.drift.z;
        v = store(c, single, b, at, v);
        all[part] = (gg_vd3){all[part].x + v.x, all[part].y + v.y, all[part].z + v.z};
        v.x -= strain * v.y;
        fastest = gg_larger(fastest, gg_vd3_dot(v, v));
      }
    }
    if (speed_bound) gg_dsmc_set_speed_bound(&speed_bound[b], 0, fastest, per_scale);
  }
  for (int part = 0; part < GG_PARTS; part++) store(sum, false, 0, part * GG_WIDTH, all[part]);
  gg_dsmc_lane_rng_save(&rng, lanes);
}

void NAME(gg_dsmc_kick, GG_INSTRUCTIONS)(void *c, bool single, float *speed_bound, size_t n, double strain,
                                         const gg_dsmc_kick_map *map, double bound_scale, gg_dsmc_rng_lanes *lanes,
                                         gg_dsmc_block *sum)
{
  if (single)
    kick(c, true, speed_bound, n, strain, *map, bound_scale, lanes, sum);
  else
    kick(c, false, speed_bound, n, strain, *map, bound_scale, lanes, sum);
}
