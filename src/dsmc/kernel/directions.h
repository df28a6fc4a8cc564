/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random directions for the lanes that collide, about half of all. They are sampled eight at a time, ahead of their
 * use, into a list that gg_pack fills and gg_spread reads. */
#ifndef GG_DSMC_DIRECTIONS_H
#define GG_DSMC_DIRECTIONS_H

#include "dsmc/kernel/lane_random.h"

enum {
  GG_DSMC_DIRECTIONS_FROM = 64, /* fewer: sample more */
  GG_DSMC_DIRECTIONS = 256,     /* most directions when sixteen block pairs begin */
  /* and room for those sampled during sixteen block pairs, and for the width of a register */
  GG_DSMC_DIRECTIONS_ROOM = GG_DSMC_DIRECTIONS + 17 * GG_DSMC_LANES
};

typedef struct gg_dsmc_directions {
  gg_real *x;     /* x, y, z: three lists of GG_DSMC_DIRECTIONS_ROOM, separate so that the rest stays in registers */
  unsigned at, n; /* used, sampled */
} gg_dsmc_directions;

/* Sample a point (u, v) uniform in the unit disc, s = u^2 + v^2, in the lanes of the returned mask. Directions follow
 * from it without trigonometry (Marsaglia, Ann. Math. Stat. 43 (1972) 645). */
GG_INLINE gg_mask gg_dsmc_lane_disc(gg_dsmc_lane_rng *rng, int part, gg_vd *u, gg_vd *v, gg_vd *s)
{
  gg_vu first, second;
  gg_dsmc_lane_two(rng, part, &first, &second);
  *u = gg_dsmc_lane_two_to_four(first) - 3;
  *v = gg_dsmc_lane_two_to_four(second) - 3;
  *s = *u * *u + *v * *v;
  return gg_less(*s, gg_all(1));
}

/* Sample a direction uniform on the sphere. */
GG_INLINE gg_mask gg_dsmc_lane_uniform(gg_dsmc_lane_rng *rng, int part, gg_vd3 *w)
{
  gg_vd u, v, s;
  gg_mask in = gg_dsmc_lane_disc(rng, part, &u, &v, &s);
  gg_vd factor = 2 * gg_sqrt(gg_where(in, 1 - s));
  *w = (gg_vd3){u * factor, v * factor, 1 - 2 * s};
  return in;
}

/* Sample the cosine law about the z axis: the projection of the direction on the plane is uniform in the disc. */
GG_INLINE gg_mask gg_dsmc_lane_cosine(gg_dsmc_lane_rng *rng, int part, gg_vd3 *w)
{
  gg_vd s;
  gg_mask in = gg_dsmc_lane_disc(rng, part, &w->x, &w->y, &s);
  w->z = gg_sqrt(gg_where(in, 1 - s));
  return in;
}

/* Sample the density |k_x k_y| on the sphere: z is the median of three uniform numbers on (-1, 1), with density
 * 3/4 (1 - z^2), and the squared sine of the azimuth is uniform. */
GG_INLINE gg_mask gg_dsmc_lane_sheared(gg_dsmc_lane_rng *rng, int part, gg_vd3 *k)
{
  gg_vu word[4];
  gg_dsmc_lane_two(rng, part, &word[0], &word[1]);
  gg_dsmc_lane_two(rng, part, &word[2], &word[3]);
  gg_vd a = gg_dsmc_lane_one_to_two(word[0]), b = gg_dsmc_lane_one_to_two(word[1]);
  gg_vd c = gg_dsmc_lane_one_to_two(word[2]), q = gg_dsmc_lane_one_to_two(word[3]) - 1;
  gg_vd median = gg_larger(gg_smaller(a, b), gg_smaller(gg_larger(a, b), c));
  k->z = 2 * median - 3;
  gg_vd rho2 = 1 - k->z * k->z;
  k->x = (gg_vd)((gg_vu)gg_sqrt(rho2 * q) ^ (word[2] << (GG_REAL_BITS - 1)));
  k->y = (gg_vd)((gg_vu)gg_sqrt(rho2 * (1 - q)) ^ (word[2] >> 1 << (GG_REAL_BITS - 1)));
  return gg_less(gg_all(0), gg_all(1));
}

typedef enum gg_dsmc_law { GG_DSMC_UNIFORM, GG_DSMC_COSINE, GG_DSMC_SHEAR_LAW } gg_dsmc_law;

GG_INLINE gg_mask gg_dsmc_lane_direction(gg_dsmc_law law, gg_dsmc_lane_rng *rng, int part, gg_vd3 *w)
{
  switch (law) {
  case GG_DSMC_UNIFORM: return gg_dsmc_lane_uniform(rng, part, w);
  case GG_DSMC_COSINE: return gg_dsmc_lane_cosine(rng, part, w);
  default: return gg_dsmc_lane_sheared(rng, part, w);
  }
}

/* Move the unused directions to the front, whole registers at a time. */
GG_INLINE void gg_dsmc_directions_move_up(gg_dsmc_directions *directions)
{
  for (unsigned i = 0; i < directions->n - directions->at; i += GG_WIDTH)
    for (int k = 0; k < 3; k++) {
      gg_real *list = directions->x + k * GG_DSMC_DIRECTIONS_ROOM;
      gg_vd some;
      __builtin_memcpy(&some, list + directions->at + i, sizeof some);
      __builtin_memcpy(list + i, &some, sizeof some);
    }
  directions->n -= directions->at;
  directions->at = 0;
}

/* Prepare for sixteen block pairs. Returns whether more directions must be sampled meanwhile. */
GG_INLINE bool gg_dsmc_directions_begin(gg_dsmc_directions *directions)
{
  if (__builtin_expect(directions->n > GG_DSMC_DIRECTIONS, 0)) gg_dsmc_directions_move_up(directions);
  return directions->n - directions->at < GG_DSMC_DIRECTIONS_FROM;
}

/* Sample up to eight more directions; `law` is constant. */
GG_INLINE void gg_dsmc_directions_make(gg_dsmc_directions *directions, gg_dsmc_lane_rng *rng, gg_dsmc_law law)
{
  for (int part = 0; part < GG_PARTS; part++) {
    gg_vd3 w;
    gg_mask made = gg_dsmc_lane_direction(law, rng, part, &w);
    gg_real *to = directions->x + directions->n;
    gg_pack(to, made, w.x);
    gg_pack(to + GG_DSMC_DIRECTIONS_ROOM, made, w.y);
    gg_pack(to + 2 * GG_DSMC_DIRECTIONS_ROOM, made, w.z);
    directions->n += (unsigned)__builtin_popcount(gg_bits(made));
  }
}

/* Ensure that at least eight directions are ready. */
GG_INLINE void gg_dsmc_directions_ensure(gg_dsmc_directions *directions, gg_dsmc_lane_rng *rng, gg_dsmc_law law)
{
  if (__builtin_expect(directions->n - directions->at >= GG_DSMC_LANES, 1)) return;
  gg_dsmc_directions_move_up(directions);
  while (directions->n < GG_DSMC_DIRECTIONS_FROM) gg_dsmc_directions_make(directions, rng, law);
}

/* Take a direction for each lane of the mask; the other lanes are finite. */
GG_INLINE gg_vd3 gg_dsmc_directions_take(gg_dsmc_directions *directions, gg_mask mask)
{
  const gg_real *from = directions->x + directions->at;
  gg_vd3 w = {gg_spread(mask, from), gg_spread(mask, from + GG_DSMC_DIRECTIONS_ROOM),
              gg_spread(mask, from + 2 * GG_DSMC_DIRECTIONS_ROOM)};
  directions->at += (unsigned)__builtin_popcount(gg_bits(mask));
  return w;
}

#endif
