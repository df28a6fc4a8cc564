/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plane across one of the axes. */
#ifndef GG_SURFACE_PLANE_H
#define GG_SURFACE_PLANE_H

#include <math.h>

#include "common/surface/surface.h"

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

GG_INLINE double gg_plane_clearance(const gg_surface *s, const gg_vec *r, double radius)
{
  return s->side * s->place - radius - s->side * gg_along(r, s->axis);
}

GG_INLINE gg_vec gg_plane_normal(const gg_surface *s, const gg_vec *r)
{
  (void)r;
  return (gg_vec){s->axis == 0 ? s->side : 0, s->axis == 1 ? s->side : 0, s->axis == 2 ? s->side : 0};
}

GG_INLINE double gg_plane_delay(const gg_surface *s, const gg_flight *f, const gg_region *where)
{
  (void)where;
  return gg_fall_delay(gg_plane_clearance(s, f->r, f->radius), s->side * gg_along(f->v, s->axis),
                       s->side * gg_along(f->g, s->axis));
}

GG_INLINE void gg_plane_put_outside(const gg_surface *s, double radius, gg_vec *r)
{
  double nearest = s->place - s->side * radius;
  if (s->side * gg_along(r, s->axis) > s->side * nearest) *gg_component(r, s->axis) = nearest;
}

GG_INLINE double gg_plane_height(const gg_surface *s)
{
  (void)s;
  return 0;
}

#endif
