/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/kernel/synchronise.h"

#include "dsmc/kernel/kernel_lanes.h"

#ifdef GG_SINGLE_LANES
#define NAME_OF(instructions) gg_dsmc_synchronise_single_##instructions
enum { RUN = 16 }; /* blocks summed in single precision before they go into double sums */
#else
#define NAME_OF(instructions) gg_dsmc_synchronise_##instructions
#define RUN SIZE_MAX
#endif
#define NAME(instructions) NAME_OF(instructions)

/* The map, in the precision of the lanes. */
typedef struct affine_map {
  gg_real strain, scale, x, y, z, per_scale;
} affine_map;

/* Synchronise lanes from `at` of n blocks. */
GG_INLINE void synchronise(gg_dsmc_real_block *c, float *speed_bound, size_t n, int at, affine_map map,
                           gg_dsmc_block_sums *sums)
{
  gg_vd sx = gg_all(0), sy = sx, sz = sx, s2 = sx, fastest = sx;
  for (gg_dsmc_real_block *b = c; b < c + n; b++) {
    gg_vd y = gg_load(b->y + at), x = map.scale * (gg_load(b->x + at) - map.strain * y) - map.x;
    gg_vd z = map.scale * gg_load(b->z + at) - map.z;
    y = map.scale * y - map.y;
    gg_vd c2 = x * x + y * y + z * z;
    gg_store(b->x + at, x);
    gg_store(b->y + at, y);
    gg_store(b->z + at, z);
    sx += x;
    sy += y;
    sz += z;
    s2 += c2;
    fastest = gg_larger(fastest, c2);
    gg_dsmc_set_speed_bound(&speed_bound[b - c], at, c2, map.per_scale);
  }
  for (int l = 0; l < GG_WIDTH; l++) {
    sums->c.x[at + l] += sx[l];
    sums->c.y[at + l] += sy[l];
    sums->c.z[at + l] += sz[l];
    sums->c2[at + l] += s2[l];
    if (fastest[l] > sums->fastest[at + l]) sums->fastest[at + l] = fastest[l];
  }
}

void NAME(GG_INSTRUCTIONS)(void *blocks, float *speed_bound, size_t n, double strain, double scale, gg_vec centre,
                           double bound_scale, gg_dsmc_block_sums *sums)
{
  gg_dsmc_real_block *c = blocks;
  const affine_map map = {(gg_real)strain,   (gg_real)scale,    (gg_real)centre.x,
                          (gg_real)centre.y, (gg_real)centre.z, (gg_real)gg_dsmc_per_bound(bound_scale)};
  for (int at = 0; at < GG_DSMC_LANES; at += GG_WIDTH)
    for (size_t first = 0; first < n; first += RUN) {
      synchronise(c + first, speed_bound + first, n - first < RUN ? n - first : RUN, at, map, sums);
      if (n - first <= RUN) break;
    }
}
