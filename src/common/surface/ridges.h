/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Half cylinders side by side on a wall, across the flow: their axes are along z at y = place, x = (k + 1/2) 2 radius.
 * They touch each other, so the wall between them is out of reach, and a grain touches the one that is nearest along x:
 * the others are farther away. A grain under gravity meets a cylinder at a root of a quartic. */
#ifndef GG_SURFACE_RIDGES_H
#define GG_SURFACE_RIDGES_H

#include <stdbool.h>
#include <stdint.h>

#include "common/surface/surface.h"

/* A polynomial of degree 4, lowest coefficient first, at t; and its slope. */
GG_INLINE double gg_quartic_at(const double c[5], double t)
{
  return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
}
GG_INLINE double gg_quartic_slope(const double c[5], double t)
{
  return c[1] + t * (2 * c[2] + t * (3 * c[3] + t * 4 * c[4]));
}
GG_INLINE double gg_quartic_curvature(const double c[5], double t)
{
  return 2 * c[2] + t * (6 * c[3] + t * 12 * c[4]);
}

/* Root of the quartic (or of its slope) between two times at which its signs differ: Newton's steps, and bisection
 * where they leave the interval. */
GG_INLINE double gg_quartic_root(const double c[5], bool of_slope, double from, double to)
{
  bool rises = (of_slope ? gg_quartic_slope(c, to) : gg_quartic_at(c, to)) > 0;
  double t = 0.5 * (from + to);
  for (int k = 0; k < 200 && t > from && t < to; k++) {
    double f = of_slope ? gg_quartic_slope(c, t) : gg_quartic_at(c, t);
    double slope = of_slope ? gg_quartic_curvature(c, t) : gg_quartic_slope(c, t), next = t - f / slope;
    if ((f > 0) == rises)
      to = t;
    else
      from = t;
    if (next == t) break;
    t = next > from && next < to ? next : 0.5 * (from + to);
  }
  return t;
}

/* Times after 0 at which the slope is 0, in order: at most three. Its own turns divide time into pieces on which it
 * rises or falls. */
GG_INLINE int gg_quartic_turns(const double c[5], double turn[3])
{
  double discriminant = 9 * c[3] * c[3] - 24 * c[4] * c[2], root = sqrt(discriminant > 0 ? discriminant : 0);
  double end = 1 + (fabs(c[1]) + 2 * fabs(c[2]) + 3 * fabs(c[3])) / (4 * c[4]); /* behind all roots */
  double edge[4] = {0, (-3 * c[3] - root) / (12 * c[4]), (-3 * c[3] + root) / (12 * c[4]), end};
  int n = 0;
  for (int k = 0; k < 3; k++) {
    double from = edge[k] > 0 ? edge[k] : 0, to = edge[k + 1];
    if (!(to > from)) continue;
    if ((gg_quartic_slope(c, from) > 0) != (gg_quartic_slope(c, to) > 0))
      turn[n++] = gg_quartic_root(c, true, from, to);
  }
  return n;
}

/* First time at which |p + q t + a t^2|, in the plane of x and y, falls below S. Closer than that by rounding: now if
 * it approaches, else when it comes back. */
GG_INLINE double gg_arc_delay(gg_vec p, gg_vec q, gg_vec a, double S)
{
  const double c[5] = {gg_dot(p, p) - S * S, 2 * gg_dot(p, q), gg_dot(q, q) + 2 * gg_dot(p, a), 2 * gg_dot(q, a),
                       gg_dot(a, a)};
  double before = 0, height = c[0], turn[3];
  if (c[0] <= 0 && (c[1] < 0 || (c[1] == 0 && c[2] < 0))) return 0;
  if (c[4] == 0) {
    double b = 0.5 * c[1], discriminant = b * b - c[2] * c[0];
    return b >= 0 || discriminant < 0 ? INFINITY : c[0] / (sqrt(discriminant) - b);
  }
  int n = gg_quartic_turns(c, turn);
  for (int k = 0; k < n; k++) {
    double after = gg_quartic_at(c, turn[k]);
    if (height > 0 && after <= 0) return gg_quartic_root(c, false, before, turn[k]);
    if (k == 0 && height <= 0 && after <= 0 && after >= height) return turn[k]; /* a hop within rounding */
    before = turn[k], height = after;
  }
  return INFINITY;
}

/* From the axis of cylinder k to a centre, in the plane across it. */
GG_INLINE gg_vec gg_ridge_from_axis(const gg_surface *s, double k, const gg_vec *r)
{
  return (gg_vec){r->x - (k + 0.5) * 2 * s->radius, r->y - s->place, 0};
}

/* x of the axis of the cylinder that is nearest along x. */
GG_INLINE double gg_ridge_at(const gg_surface *s, double x)
{
  double k = x / (2 * s->radius), whole = (double)(int64_t)k;
  return whole > k ? whole - 1 : whole;
}

GG_INLINE double gg_ridges_delay(const gg_surface *s, const gg_flight *f, const gg_region *where)
{
  double first = INFINITY, last = gg_ridge_at(s, where->to[0] + 1e-9);
  const gg_vec q = {f->v->x, f->v->y, 0}, a = {0.5 * f->g->x, 0.5 * f->g->y, 0};
  for (double k = gg_ridge_at(s, where->from[0] - 1e-9); k <= last; k++) {
    double t = gg_arc_delay(gg_ridge_from_axis(s, k, f->r), q, a, s->radius + f->radius);
    first = t < first ? t : first;
  }
  return first;
}

GG_INLINE gg_vec gg_ridges_normal(const gg_surface *s, const gg_vec *r)
{
  gg_vec p = gg_ridge_from_axis(s, gg_ridge_at(s, r->x), r);
  return gg_scale(-1 / sqrt(gg_dot(p, p)), p);
}

GG_INLINE double gg_ridges_clearance(const gg_surface *s, const gg_vec *r, double radius)
{
  gg_vec p = gg_ridge_from_axis(s, gg_ridge_at(s, r->x), r);
  return sqrt(gg_dot(p, p)) - s->radius - radius;
}

/* Away from the wall, to where the grain stands on its cylinder. */
GG_INLINE void gg_ridges_put_outside(const gg_surface *s, double radius, gg_vec *r)
{
  gg_vec p = gg_ridge_from_axis(s, gg_ridge_at(s, r->x), r);
  double S = s->radius + radius, height = sqrt(S * S - p.x * p.x);
  if (-s->side * p.y < height) r->y = s->place - s->side * height;
}

GG_INLINE double gg_ridges_height(const gg_surface *s)
{
  return s->radius;
}

#endif
