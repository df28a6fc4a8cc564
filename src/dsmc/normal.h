/* Normal numbers in lanes (Box & Muller 1958), without libm: the same bits everywhere. */
#ifndef GG_DSMC_NORMAL_H
#define GG_DSMC_NORMAL_H

#include "dsmc/directions.h"

/* ln u for 0 < u <= 1: u = 2^e f with f in [sqrt(1/2), sqrt(2)), ln f = 2 artanh((f-1)/(f+1)) by its series. */
GG_INLINE gg_vd gg_lane_log(gg_vd u)
{
  gg_vu bits = (gg_vu)u,
        above = bits + (0x3ff0000000000000u - 0x3fe6a09e667f3bcdu); /* exponent, as seen from sqrt(1/2) */
  gg_vd e = (gg_vd)((above >> 52) | 0x4330000000000000u) - (0x1p52 + 1023);
  gg_vd f = (gg_vd)((above & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu);
  gg_vd s = (f - 1) / (f + 1), q = s * s, sum = gg_all(1. / 21);
  for (int k = 19; k >= 1; k -= 2) sum = sum * q + 1. / k;
  return e * M_LN2 + 2 * s * sum;
}

/* Two independent normal numbers a lane. */
GG_INLINE void gg_lane_normal(gg_lane_rng *r, int part, gg_vd *a, gg_vd *b)
{
  gg_vd radius = gg_sqrt(-2 * gg_lane_log(2 - gg_lane_one_to_two(gg_lane_next(r, part))));
  gg_lane_circle(gg_lane_next(r, part), a, b);
  *a *= radius;
  *b *= radius;
}

#endif
