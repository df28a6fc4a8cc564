/* When will two grains touch? The contact quadratic |dr + dv t|^2 = sigma^2 with dr, dv at the present time. */
#ifndef GG_MD_PREDICT_H
#define GG_MD_PREDICT_H

#include <math.h>

#include "common/vec.h"

/* Time until contact, INFINITY if there is none. With b = dr.dv and c = dr^2 - sigma^2 the earlier root is
 * (-b - sqrt(b^2 - a c))/a = c/(-b + sqrt(b^2 - a c)): no cancellation, since b < 0 for every contact to come. So
 *   receding pairs (b >= 0), overlapping by rounding or not, are let go;
 *   touching or slightly overlapping pairs that approach (c <= 0) collide now: the root is <= 0 and is taken as 0;
 *   grazing pairs (discriminant near 0) collide or not by its sign; either way the momentum exchanged is negligible. */
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

#endif
