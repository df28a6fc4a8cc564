/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prediction of contacts by the contact quadratic |dr + dv t|^2 = sigma^2, with dr and dv at the present time. */
#ifndef GG_MD_PREDICT_H
#define GG_MD_PREDICT_H

#include <math.h>

#include "common/vec.h"
#include "md/md_state.h"
#include "simd/eight.h"

/* Time until contact; INFINITY: none. With b = dr.dv and c = dr^2 - sigma^2 the earlier root is
 * (-b - sqrt(b^2 - a c))/a = c/(-b + sqrt(b^2 - a c)), without cancellation, since b < 0 for every future contact. So
 *   receding pairs (b >= 0) have no contact, even if they overlap by rounding;
 *   touching or slightly overlapping pairs that approach (c <= 0) collide now: the root is <= 0 and is taken as 0;
 *   grazing pairs (discriminant near 0) collide by the sign of the discriminant; the exchanged momentum is negligible.
 */
GG_INLINE double gg_md_contact_delay(gg_vec dr, gg_vec dv, double sigma2)
{
  double b = gg_dot(dr, dv);
  if (b >= 0) return INFINITY;
  double a = gg_dot(dv, dv), c = gg_dot(dr, dr) - sigma2;
  double discriminant = b * b - a * c;
  if (discriminant < 0) return INFINITY;
  double delay = c / (sqrt(discriminant) - b);
  return delay > 0 ? delay : 0;
}

/* Records of eight grains as columns: r, v, t, and the bits of (species, counter). Eight predictions use the same
 * operations in the same order as one, so that each delay is the same bit for bit. */
typedef struct gg_md_batch {
  gg_v8 x, y, z, vx, vy, vz, t, tag;
} gg_md_batch;

/* Load the records of eight grains, a cache line each, and transpose them. */
GG_INLINE gg_md_batch gg_md_gather(const gg_md_grain *grain, const uint32_t *index)
{
  const gg_half *front[GG_BATCH], *back[GG_BATCH];
  gg_v8 one[4], two[4];
  for (int k = 0; k < GG_BATCH; k++) {
    front[k] = (const gg_half *)(grain + index[k]);
    back[k] = front[k] + 1;
  }
  gg_columns(front, one);
  gg_columns(back, two);
  return (gg_md_batch){one[0], one[1], one[2], one[3], two[0], two[1], two[2], two[3]};
}

/* gg_md_contact_delay for eight pairs in two steps: first an estimate of 1/delay, without the square root and the
 * division, which take longer than everything else; then the exact delay of the earliest pair. */
#define GG_MD_ABOUT 0x1p-12         /* relative error of the estimate */
#define GG_MD_SOON_AT_ALL 0x1p-1000 /* smaller estimates: no contact */
#define GG_MD_AT_ONCE 0x1p800       /* larger estimates: already in contact, and the order of pairs is unknown */

typedef struct gg_md_quadratic {
  gg_v8 b, c, discriminant;
} gg_md_quadratic;

GG_INLINE gg_md_quadratic gg_md_contact_quadratic8(gg_v8 x, gg_v8 y, gg_v8 z, gg_v8 vx, gg_v8 vy, gg_v8 vz,
                                                   gg_v8 sigma2)
{
  gg_v8 b = x * vx + y * vy + z * vz, a = vx * vx + vy * vy + vz * vz;
  gg_v8 c = x * x + y * y + z * z - sigma2;
  return (gg_md_quadratic){b, c, b * b - a * c};
}

/* Pairs that will touch: they approach, and their discriminant is not negative. */
GG_INLINE gg_k8 gg_md_meets8(gg_md_quadratic q)
{
  return gg_less8(q.b, gg_all8(0)) & gg_not_above8(gg_all8(0), q.discriminant);
}

/* Estimate of 1/delay with relative error GG_MD_ABOUT: the largest is the earliest; 0: never. The two approximate
 * inverses are independent, so the processor computes them at the same time. */
GG_INLINE gg_v8 gg_md_how_soon8(gg_md_quadratic q)
{
  gg_v8 tiny = gg_all8(0x1p-1000), d = gg_larger8(q.discriminant, tiny);
  gg_v8 soon = (d * gg_about_inverse_root8(d) - q.b) * gg_about_inverse8(gg_larger8(q.c, tiny));
  return gg_choose8(gg_md_meets8(q), soon, gg_all8(0));
}

GG_INLINE gg_v8 gg_md_contact_delay8(gg_md_quadratic q)
{
  gg_v8 delay = q.c / (gg_sqrt8(q.discriminant) - q.b);
  delay = gg_choose8(gg_less8(gg_all8(0), delay), delay, gg_all8(0));
  return gg_choose8(gg_md_meets8(q), delay, gg_all8(INFINITY));
}

#endif
