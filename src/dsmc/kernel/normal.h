/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Normal random numbers in lanes (Box & Muller 1958), without libm, so that every processor has the same bits. */
#ifndef GG_DSMC_NORMAL_H
#define GG_DSMC_NORMAL_H

#include "dsmc/kernel/directions.h"

/* Registers of which series are computed at once. Each step of a series waits for the one before; in the meantime the
 * other registers take the same step. */
enum { GG_NORMAL_PARTS = GG_PARTS == 1 ? 1 : 2, GG_NORMALS = 2 * GG_NORMAL_PARTS };

/* sum = c[0] q^(terms-1) + ... + c[terms-1] in n registers. n and `terms` are constant. */
GG_INLINE void gg_dsmc_lane_series(int n, int terms, const double *c, const gg_vd *q, gg_vd *sum)
{
  for (int i = 0; i < n; i++) sum[i] = gg_all(c[0]);
  for (int k = 1; k < terms; k++)
    for (int i = 0; i < n; i++) sum[i] = sum[i] * q[i] + c[k];
}

/* Sines and cosines of n registers on [-pi/4, pi/4], by Taylor series to rounding. */
GG_INLINE void gg_dsmc_lane_sincos_of(int n, const gg_vd *a, gg_vd *sine, gg_vd *cosine)
{
  static const double sines[] = {-1. / 1307674368000., 1. / 6227020800., -1. / 39916800., 1. / 362880.,
                                 -1. / 5040.,          1. / 120.,        -1. / 6.};
  static const double cosines[] = {1. / 20922789888000., -1. / 87178291200., 1. / 479001600., -1. / 3628800.,
                                   1. / 40320.,          -1. / 720.,         1. / 24.};
  gg_vd q[GG_NORMALS], s[GG_NORMALS], c[GG_NORMALS];
  for (int i = 0; i < n; i++) q[i] = a[i] * a[i];
  gg_dsmc_lane_series(n, 7, sines, q, s);
  gg_dsmc_lane_series(n, 7, cosines, q, c);
  for (int i = 0; i < n; i++) {
    sine[i] = a[i] + a[i] * (q[i] * s[i]);
    cosine[i] = 1 - (0.5 * q[i] - q[i] * q[i] * c[i]);
  }
}
GG_INLINE void gg_dsmc_lane_sincos(gg_vd a, gg_vd *sine, gg_vd *cosine)
{
  gg_dsmc_lane_sincos_of(1, &a, sine, cosine);
}

/* Random unit vectors in the plane: angles up to pi/4 either way, then rotated by a multiple of pi/2 from two bits. */
GG_INLINE void gg_dsmc_lane_circle(int n, const gg_vu *word, gg_vd *x, gg_vd *y)
{
  gg_vd angle[GG_NORMALS], s[GG_NORMALS], c[GG_NORMALS];
  for (int i = 0; i < n; i++) angle[i] = (gg_dsmc_lane_one_to_two(word[i]) - 1.5) * M_PI_2;
  gg_dsmc_lane_sincos_of(n, angle, s, c);
  for (int i = 0; i < n; i++) {
    c[i] = (gg_vd)((gg_vu)c[i] ^ (word[i] << 63)); /* s has a random sign already */
    gg_mask other = gg_low_bit(word[i] >> 1);
    x[i] = gg_select(other, s[i], c[i]);
    y[i] = gg_select(other, c[i], s[i]);
  }
}

/* ln u for 0 < u <= 1: u = 2^e f with f in [sqrt(1/2), sqrt(2)), ln f = 2 artanh((f-1)/(f+1)) by its series. */
GG_INLINE void gg_dsmc_lane_log(int n, const gg_vd *u, gg_vd *ln)
{
  static const double series[] = {1. / 21, 1. / 19, 1. / 17, 1. / 15, 1. / 13, 1. / 11,
                                  1. / 9,  1. / 7,  1. / 5,  1. / 3,  1};
  gg_vd e[GG_NORMALS], s[GG_NORMALS], q[GG_NORMALS], sum[GG_NORMALS];
  for (int i = 0; i < n; i++) {
    gg_vu bits = (gg_vu)u[i],
          above = bits + (0x3ff0000000000000u - 0x3fe6a09e667f3bcdu); /* exponent relative to sqrt(1/2) */
    e[i] = (gg_vd)((above >> 52) | 0x4330000000000000u) - (0x1p52 + 1023);
    gg_vd f = (gg_vd)((above & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu);
    s[i] = (f - 1) / (f + 1);
    q[i] = s[i] * s[i];
  }
  gg_dsmc_lane_series(n, 11, series, q, sum);
  for (int i = 0; i < n; i++) ln[i] = e[i] * M_LN2 + 2 * s[i] * sum[i];
}

/* Draw four independent normal numbers a lane of each of GG_NORMAL_PARTS parts, from part `first`: a and b of registers
 * 2i and 2i + 1 belong to part first + i. */
GG_INLINE void gg_dsmc_lane_normals(gg_dsmc_lane_rng *rng, int first, gg_vd a[GG_NORMALS], gg_vd b[GG_NORMALS])
{
  gg_vd radius[GG_NORMALS];
  gg_vu word[GG_NORMALS];
  for (int i = 0; i < GG_NORMALS; i++) {
    radius[i] = 2 - gg_dsmc_lane_one_to_two(gg_dsmc_lane_next(rng, first + i / 2));
    word[i] = gg_dsmc_lane_next(rng, first + i / 2);
  }
  gg_dsmc_lane_log(GG_NORMALS, radius, radius);
  gg_dsmc_lane_circle(GG_NORMALS, word, a, b);
  for (int i = 0; i < GG_NORMALS; i++) {
    radius[i] = gg_sqrt(-2 * radius[i]);
    a[i] *= radius[i];
    b[i] *= radius[i];
  }
}

#endif
