/* What a shape can be asked. Each shape is a file with these five functions, and a row here; a grain is a sphere of the
 * given radius about r.
 *
 *   delay        time until the grain in flight touches the surface, INFINITY: never; touching or a little inside by
 *                rounding: 0 if it approaches, else when it comes back. Only contacts with the centre in the box
 * `where` (the grain's cell) are asked for, later ones may be missed normal       unit vector from the centre into the
 * surface, at contact clearance    distance of the grain from the surface; negative inside put_outside  a centre that
 * is too near is moved to where it touches height       how far the surface stands out of its `place` into the gas:
 * grains can touch it with centres up to height + radius from there, and nowhere else */
#ifndef GG_SURFACE_SHAPES_H
#define GG_SURFACE_SHAPES_H

#include "common/surface/plane.h"
#include "common/surface/ridges.h"

#define GG_EACH_SHAPE(X) X(plane) X(ridges)

#define GG_SHAPE(name) GG_SHAPE_##name,
enum { GG_EACH_SHAPE(GG_SHAPE) GG_SHAPES };
#undef GG_SHAPE

/* The calls below, by shape. */
#define GG_SHAPE_DELAY(name)                                                                                           \
  case GG_SHAPE_##name: return gg_##name##_delay(s, f, where);
GG_INLINE double gg_surface_delay(const gg_surface *s, const gg_flight *f, const gg_region *where)
{
  switch (s->shape) {
    GG_EACH_SHAPE(GG_SHAPE_DELAY)
  default: return INFINITY;
  }
}

#define GG_SHAPE_NORMAL(name)                                                                                          \
  case GG_SHAPE_##name: return gg_##name##_normal(s, r);
GG_INLINE gg_vec gg_surface_normal(const gg_surface *s, const gg_vec *r)
{
  switch (s->shape) {
    GG_EACH_SHAPE(GG_SHAPE_NORMAL)
  default: return (gg_vec){0, 0, 0};
  }
}

#define GG_SHAPE_CLEARANCE(name)                                                                                       \
  case GG_SHAPE_##name: return gg_##name##_clearance(s, r, radius);
GG_INLINE double gg_surface_clearance(const gg_surface *s, const gg_vec *r, double radius)
{
  switch (s->shape) {
    GG_EACH_SHAPE(GG_SHAPE_CLEARANCE)
  default: return INFINITY;
  }
}

#define GG_SHAPE_PUT_OUTSIDE(name)                                                                                     \
  case GG_SHAPE_##name: gg_##name##_put_outside(s, radius, r); break;
GG_INLINE void gg_surface_put_outside(const gg_surface *s, double radius, gg_vec *r)
{
  switch (s->shape) {
    GG_EACH_SHAPE(GG_SHAPE_PUT_OUTSIDE)
  default: break;
  }
}

#define GG_SHAPE_HEIGHT(name)                                                                                          \
  case GG_SHAPE_##name: return gg_##name##_height(s);
GG_INLINE double gg_surface_height(const gg_surface *s)
{
  switch (s->shape) {
    GG_EACH_SHAPE(GG_SHAPE_HEIGHT)
  default: return 0;
  }
}

#endif
