/* Random directions made eight at a time and handed out to the lanes that collide, about a quarter of them: a list that
 * is filled by vectors and read by gg_spread. */
#ifndef GG_DSMC_DIRECTIONS_H
#define GG_DSMC_DIRECTIONS_H

#include "dsmc/lanes.h"

enum { GG_DIRECTIONS = 64 };

typedef struct gg_directions {
  double x[GG_DIRECTIONS + 2 * GG_LANES], y[GG_DIRECTIONS + 2 * GG_LANES], z[GG_DIRECTIONS + 2 * GG_LANES];
  unsigned at, n; /* used, made */
} gg_directions;

/* sin and cos on [-pi/4, pi/4], Taylor's series to rounding: no libm, so that every processor has the same bits. */
GG_INLINE void gg_lane_sincos(gg_vd a, gg_vd *sine, gg_vd *cosine)
{
  gg_vd q = a * a;
  gg_vd s = q * (-1. / 1307674368000.) + 1. / 6227020800.;
  s = s * q - 1. / 39916800.;
  s = s * q + 1. / 362880.;
  s = s * q - 1. / 5040.;
  s = s * q + 1. / 120.;
  s = s * q - 1. / 6.;
  *sine = a + a * (q * s);
  gg_vd c = q * (1. / 20922789888000.) - 1. / 87178291200.;
  c = c * q + 1. / 479001600.;
  c = c * q - 1. / 3628800.;
  c = c * q + 1. / 40320.;
  c = c * q - 1. / 720.;
  c = c * q + 1. / 24.;
  *cosine = 1 - (0.5 * q - q * q * c);
}

/* A unit vector in the plane, any angle: an eighth turn either way, turned on by the quarter that two bits choose. */
GG_INLINE void gg_lane_circle(gg_vu r, gg_vd *x, gg_vd *y)
{
  gg_vd s, c;
  gg_lane_sincos((gg_lane_one_to_two(r) - 1.5) * M_PI_2, &s, &c);
  c = (gg_vd)((gg_vu)c ^ (r << 63)); /* and s has either sign by itself */
  gg_mask other = gg_low_bit(r >> 1);
  *x = gg_select(other, s, c);
  *y = gg_select(other, c, s);
}

/* Uniform on the sphere. */
GG_INLINE gg_vd3 gg_lane_uniform(gg_lane_rng *r, int p)
{
  gg_vd3 w;
  gg_lane_circle(gg_lane_next(r, p), &w.x, &w.y);
  w.z = 2 * gg_lane_one_to_two(gg_lane_next(r, p)) - 3;
  gg_vd rho = gg_sqrt(1 - w.z * w.z);
  w.x *= rho;
  w.y *= rho;
  return w;
}

/* Cosine law about the z axis: k_z^2 is uniform. */
GG_INLINE gg_vd3 gg_lane_cosine(gg_lane_rng *r, int p)
{
  gg_vd3 w;
  gg_lane_circle(gg_lane_next(r, p), &w.x, &w.y);
  gg_vd z2 = gg_lane_one_to_two(gg_lane_next(r, p)) - 1, rho = gg_sqrt(1 - z2);
  return (gg_vd3){w.x * rho, w.y * rho, gg_sqrt(z2)};
}

/* Density |k_x k_y| on the sphere: z is the median of three uniform numbers on (-1, 1), density 3/4 (1 - z^2), and the
 * squared sine of the azimuth is uniform. */
GG_INLINE gg_vd3 gg_lane_sheared(gg_lane_rng *r, int p)
{
  gg_vu bits = gg_lane_next(r, p);
  gg_vd a = gg_lane_one_to_two(gg_lane_next(r, p)), b = gg_lane_one_to_two(gg_lane_next(r, p));
  gg_vd c = gg_lane_one_to_two(gg_lane_next(r, p)), q = gg_lane_one_to_two(bits) - 1;
  gg_mask swap = gg_less(b, a);
  gg_vd low = gg_select(swap, b, a), high = gg_select(swap, a, b);
  gg_vd median = gg_select(gg_less(c, low), low, gg_select(gg_less(high, c), high, c));
  gg_vd3 k = {.z = 2 * median - 3};
  gg_vd rho2 = 1 - k.z * k.z;
  k.x = (gg_vd)((gg_vu)gg_sqrt(rho2 * q) ^ (bits << 63));
  k.y = (gg_vd)((gg_vu)gg_sqrt(rho2 * (1 - q)) ^ (bits >> 1 << 63));
  return k;
}

typedef enum gg_law { GG_UNIFORM, GG_COSINE, GG_SHEARED } gg_law;

GG_INLINE gg_vd3 gg_lane_direction(gg_law law, gg_lane_rng *r, int p)
{
  switch (law) {
  case GG_UNIFORM: return gg_lane_uniform(r, p);
  case GG_COSINE: return gg_lane_cosine(r, p);
  default: return gg_lane_sheared(r, p);
  }
}

/* At least eight in stock; `law` is constant. */
GG_INLINE void gg_directions_stock(gg_directions *d, gg_lane_rng *r, gg_law law)
{
  if (__builtin_expect(d->n - d->at >= GG_LANES, 1)) return;
  unsigned left = d->n - d->at;
  for (unsigned i = 0; i < left; i++) {
    d->x[i] = d->x[d->at + i];
    d->y[i] = d->y[d->at + i];
    d->z[i] = d->z[d->at + i];
  }
  for (unsigned i = left; i < left + GG_DIRECTIONS; i += GG_LANES)
    for (int p = 0; p < GG_PARTS; p++) {
      gg_vd3 w = gg_lane_direction(law, r, p);
      __builtin_memcpy(&d->x[i + (unsigned)p * GG_WIDTH], &w.x, sizeof w.x);
      __builtin_memcpy(&d->y[i + (unsigned)p * GG_WIDTH], &w.y, sizeof w.y);
      __builtin_memcpy(&d->z[i + (unsigned)p * GG_WIDTH], &w.z, sizeof w.z);
    }
  d->at = 0;
  d->n = left + GG_DIRECTIONS;
}

/* One for each lane of the mask; the others hold anything finite. */
GG_INLINE gg_vd3 gg_directions_take(gg_directions *d, gg_mask m)
{
  gg_vd3 w = {gg_spread(m, d->x + d->at), gg_spread(m, d->y + d->at), gg_spread(m, d->z + d->at)};
  d->at += (unsigned)__builtin_popcount(gg_bits(m));
  return w;
}

#endif
