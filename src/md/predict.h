/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prediction of contacts by the contact quadratic |dr + dv t|^2 = sigma^2, with dr and dv at the present time. */
#ifndef GG_MD_PREDICT_H
#define GG_MD_PREDICT_H

#include <math.h>

#include "common/vec.h"
#include "md/md_state.h"
#include "simd/batch.h"

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

/* Records of a batch of grains as columns: r, v, t, and the bits of (species, counter). Predictions of a batch use the
 * same operations in the same order as one, so that each delay is the same bit for bit. */
typedef struct gg_md_batch {
  gg_vd x, y, z, vx, vy, vz, t, tag;
} gg_md_batch;

/* Load the records of a batch of grains, a cache line each, and transpose them. */
GG_INLINE gg_md_batch gg_md_gather(const gg_md_grain *grain, const uint32_t *index)
{
  const gg_row *front[GG_WIDTH], *back[GG_WIDTH];
  gg_vd one[4], two[4];
  for (int k = 0; k < GG_WIDTH; k++) {
    front[k] = (const gg_row *)(grain + index[k]);
    back[k] = front[k] + 4;
  }
  gg_batch_columns(front, one);
  gg_batch_columns(back, two);
  return (gg_md_batch){one[0], one[1], one[2], one[3], two[0], two[1], two[2], two[3]};
}

/* gg_md_contact_delay for a batch of pairs in two steps: first an estimate of 1/delay, without the square root and the
 * division, which take longer than everything else; then the exact delay of the earliest pair. */
#define GG_MD_ABOUT 0x1p-12         /* relative error of the estimate */
#define GG_MD_SOON_AT_ALL 0x1p-1000 /* smaller estimates: no contact */
#define GG_MD_AT_ONCE 0x1p800       /* larger estimates: already in contact, and the order of pairs is unknown */

typedef struct gg_md_quadratic {
  gg_vd b, c, discriminant;
} gg_md_quadratic;

GG_INLINE gg_md_quadratic gg_md_batch_quadratic(gg_vd x, gg_vd y, gg_vd z, gg_vd vx, gg_vd vy, gg_vd vz, gg_vd sigma2)
{
  gg_vd b = x * vx + y * vy + z * vz, a = vx * vx + vy * vy + vz * vz;
  gg_vd c = x * x + y * y + z * z - sigma2;
  return (gg_md_quadratic){b, c, b * b - a * c};
}

/* Pairs that will touch: they approach, and their discriminant is not negative. */
GG_INLINE gg_mask gg_md_batch_meets(gg_md_quadratic q)
{
  return gg_and(gg_less(q.b, gg_all(0)), gg_not_above(gg_all(0), q.discriminant));
}

/* Estimate of 1/delay with relative error GG_MD_ABOUT: the largest is the earliest; 0: never. The two approximate
 * inverses are independent, so the processor computes them at the same time. */
GG_INLINE gg_vd gg_md_batch_how_soon(gg_md_quadratic q)
{
  gg_vd tiny = gg_all(0x1p-1000), d = gg_larger(q.discriminant, tiny);
  gg_vd soon = (d * gg_about_inverse_root(d) - q.b) * gg_about_inverse(gg_larger(q.c, tiny));
  return gg_select(gg_md_batch_meets(q), soon, gg_all(0));
}

GG_INLINE gg_vd gg_md_batch_delay(gg_md_quadratic q)
{
  gg_vd delay = q.c / (gg_sqrt(q.discriminant) - q.b);
  delay = gg_select(gg_less(gg_all(0), delay), delay, gg_all(0));
  return gg_select(gg_md_batch_meets(q), delay, gg_all(INFINITY));
}

#endif
