/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of eight grains, and bounds of their speeds.
 *
 * A block holds eight grains as a structure of arrays, one cache line a component, for kernels that work lane by lane;
 * the logical width is eight on every processor. The last block of a species may have empty lanes, always 0. In single
 * precision a component has half a line, and a block two lines. Only the block kernels compute in single precision; all
 * other code reads such grains as double (gg_dsmc_block_get, gg_dsmc_blocks_in_double).
 *
 * Each block has an upper bound of its speeds, by which kernels draw pairs of blocks: C^2 <= speed_bound x bound_scale
 * in all lanes at the strain for which `bound_scale` was set. Streaming over a strain of `delta` stretches speeds by at
 * most exp(delta/2) (the larger singular value of a shear is exp(asinh(delta/2))), so bound_scale can be adjusted in
 * place of all speed bounds. */
#ifndef GG_DSMC_BLOCK_H
#define GG_DSMC_BLOCK_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/vec.h"

enum { GG_DSMC_LANES = 8 };

typedef struct gg_dsmc_block {
  double x[GG_DSMC_LANES], y[GG_DSMC_LANES], z[GG_DSMC_LANES];
} __attribute__((aligned(64))) gg_dsmc_block;

enum { GG_DSMC_COMPONENTS = sizeof(gg_dsmc_block) / sizeof(double) }; /* numbers in a block */

typedef struct gg_dsmc_block_single {
  float x[GG_DSMC_LANES], y[GG_DSMC_LANES], z[GG_DSMC_LANES];
} __attribute__((aligned(32))) gg_dsmc_block_single;

/* The grains of one species. */
typedef struct gg_dsmc_population {
  int64_t n;
  size_t n_blocks;
  double mass, inertia; /* m; K = 4I/(m d^2) */
  bool single;          /* blocks are gg_dsmc_block_single; false: gg_dsmc_block */
  void *c, *s;          /* blocks of peculiar velocities and of surface spins; s NULL: smooth grains */
  float *speed_bound;   /* of each block */
} gg_dsmc_population;

/* Upper bound of exp(|delta|) for |delta| <= 1. */
GG_INLINE double gg_dsmc_bound_growth(double delta)
{
  return 1 + fabs(delta) + delta * delta;
}

/* Slightly more than 1/bound_scale, so that rounding to float violates no bound. */
GG_INLINE double gg_dsmc_per_bound(double bound_scale)
{
  return (1 + 1e-6) / bound_scale;
}

GG_INLINE size_t gg_dsmc_block_size(const gg_dsmc_population *p)
{
  return p->single ? sizeof(gg_dsmc_block_single) : sizeof(gg_dsmc_block);
}

/* Pointer to block `first` of p->c or p->s. */
GG_INLINE void *gg_dsmc_blocks_at(const gg_dsmc_population *p, void *blocks, size_t first)
{
  return (char *)blocks + first * gg_dsmc_block_size(p);
}

/* Vector of grain i in p->c or p->s. */
GG_INLINE gg_vec gg_dsmc_block_get(const gg_dsmc_population *p, const void *blocks, uint32_t i)
{
  const uint32_t at = i / GG_DSMC_LANES, l = i % GG_DSMC_LANES;
  if (p->single) {
    const gg_dsmc_block_single *b = (const gg_dsmc_block_single *)blocks + at;
    return (gg_vec){b->x[l], b->y[l], b->z[l]};
  }
  const gg_dsmc_block *b = (const gg_dsmc_block *)blocks + at;
  return (gg_vec){b->x[l], b->y[l], b->z[l]};
}

GG_INLINE void gg_dsmc_block_set(const gg_dsmc_population *p, void *blocks, uint32_t i, gg_vec v)
{
  const uint32_t at = i / GG_DSMC_LANES, l = i % GG_DSMC_LANES;
  if (p->single) {
    gg_dsmc_block_single *b = (gg_dsmc_block_single *)blocks + at;
    b->x[l] = (float)v.x, b->y[l] = (float)v.y, b->z[l] = (float)v.z;
    return;
  }
  gg_dsmc_block *b = (gg_dsmc_block *)blocks + at;
  b->x[l] = v.x, b->y[l] = v.y, b->z[l] = v.z;
}

/* `n` blocks of p->c or p->s from `first`, in double: in place, or converted into `room`. */
const gg_dsmc_block *gg_dsmc_blocks_in_double(const gg_dsmc_population *p, const void *blocks, size_t first, size_t n,
                                              gg_dsmc_block *room);

#endif
