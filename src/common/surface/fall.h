/* When does a point on a parabola reach a plane? */
#ifndef GG_SURFACE_FALL_H
#define GG_SURFACE_FALL_H

#include <math.h>

#include "common/vec.h"

/* Time until a grain has covered the distance h towards a plane, at speed u and acceleration w towards it: the earlier
 * root of h = u t + w t^2/2, without cancellation. Touching or behind by rounding (h <= 0): now if it approaches, else
 * when it falls back. */
GG_INLINE double gg_fall_delay(double h, double u, double w)
{
  double discriminant = u * u + 2 * w * h, s = sqrt(discriminant > 0 ? discriminant : 0);
  if (h <= 0) return u > 0 ? 0 : w > 0 ? (s - u) / w : INFINITY;
  if (discriminant < 0) return INFINITY;
  if (u > 0) return 2 * h / (u + s);
  return w > 0 ? (s - u) / w : INFINITY;
}

#endif
