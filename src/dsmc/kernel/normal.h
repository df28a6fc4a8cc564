/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Normal random numbers in lanes (Box & Muller 1958), without libm, so that every processor has the same bits. */
#ifndef GG_DSMC_NORMAL_H
#define GG_DSMC_NORMAL_H

#include "dsmc/kernel/directions.h"

/* Sine and cosine on [-pi/4, pi/4], by Taylor series to rounding. */
GG_INLINE void gg_dsmc_lane_sincos(gg_vd a, gg_vd *sine, gg_vd *cosine)
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

/* Random unit vector in the plane: an angle up to pi/4 either way, then rotated by a multiple of pi/2 from two bits. */
GG_INLINE void gg_dsmc_lane_circle(gg_vu word, gg_vd *x, gg_vd *y)
{
  gg_vd s, c;
  gg_dsmc_lane_sincos((gg_dsmc_lane_one_to_two(word) - 1.5) * M_PI_2, &s, &c);
  c = (gg_vd)((gg_vu)c ^ (word << 63)); /* s has a random sign already */
  gg_mask other = gg_low_bit(word >> 1);
  *x = gg_select(other, s, c);
  *y = gg_select(other, c, s);
}

/* ln u for 0 < u <= 1: u = 2^e f with f in [sqrt(1/2), sqrt(2)), ln f = 2 artanh((f-1)/(f+1)) by its series. */
GG_INLINE gg_vd gg_dsmc_lane_log(gg_vd u)
{
  gg_vu bits = (gg_vu)u,
        above = bits + (0x3ff0000000000000u - 0x3fe6a09e667f3bcdu); /* exponent relative to sqrt(1/2) */
  gg_vd e = (gg_vd)((above >> 52) | 0x4330000000000000u) - (0x1p52 + 1023);
  gg_vd f = (gg_vd)((above & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu);
  gg_vd s = (f - 1) / (f + 1), q = s * s, sum = gg_all(1. / 21);
  for (int k = 19; k >= 1; k -= 2) sum = sum * q + 1. / k;
  return e * M_LN2 + 2 * s * sum;
}

/* Draw two independent normal numbers a lane. */
GG_INLINE void gg_dsmc_lane_normal(gg_dsmc_lane_rng *rng, int part, gg_vd *a, gg_vd *b)
{
  gg_vd radius = gg_sqrt(-2 * gg_dsmc_lane_log(2 - gg_dsmc_lane_one_to_two(gg_dsmc_lane_next(rng, part))));
  gg_dsmc_lane_circle(gg_dsmc_lane_next(rng, part), a, b);
  *a *= radius;
  *b *= radius;
}

#endif
