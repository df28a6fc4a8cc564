/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of a shape. Each shape is a file with these five functions, and an alternative below; a grain is a sphere
 * of the given radius about r.
 *
 *   delay         time until the grain in flight touches the surface, INFINITY: never. Touching or a little inside by
 *                 rounding: 0 if it approaches, else when it comes back. Only contacts with the centre in the box
 *                 `where` (the grain's cell) count, later ones may be missed.
 *   normal        unit vector from the centre into the surface, at contact
 *   clearance     distance of the grain from the surface; negative inside
 *   put_outside   moves a centre that is too near to where the grain touches
 *   height        how far the surface stands out of its `place` into the gas: grains can touch it with centres up to
 *                 height + radius from there, and nowhere else */
#ifndef GG_SURFACE_SHAPES_H
#define GG_SURFACE_SHAPES_H

#include "common/surface/plane.h"
#include "common/surface/ridges.h"

enum { GG_SHAPE_plane, GG_SHAPE_ridges };

#define GG_BY_SHAPE(function, ...)                                                                                     \
  (s->shape == GG_SHAPE_ridges ? gg_ridges_##function(__VA_ARGS__) : gg_plane_##function(__VA_ARGS__))

GG_INLINE double gg_surface_delay(const gg_surface *s, const gg_flight *f, const gg_region *where)
{
  return GG_BY_SHAPE(delay, s, f, where);
}
GG_INLINE gg_vec gg_surface_normal(const gg_surface *s, const gg_vec *r)
{
  return GG_BY_SHAPE(normal, s, r);
}
GG_INLINE double gg_surface_clearance(const gg_surface *s, const gg_vec *r, double radius)
{
  return GG_BY_SHAPE(clearance, s, r, radius);
}
GG_INLINE void gg_surface_put_outside(const gg_surface *s, double radius, gg_vec *r)
{
  GG_BY_SHAPE(put_outside, s, radius, r);
}
GG_INLINE double gg_surface_height(const gg_surface *s)
{
  return GG_BY_SHAPE(height, s);
}

#endif
