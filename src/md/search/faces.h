/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crossings: the face of its own cell that a grain reaches next, and the time. */
#ifndef GG_MD_SEARCH_FACES_H
#define GG_MD_SEARCH_FACES_H

#include "md/search/search.h"
#include "simd/axes.h"

/* True if the upper face of this cell is a wall, which is not crossed. */
GG_INLINE bool gg_md_is_wall_above(const gg_md *e, const int32_t *cell)
{
  return IS_WALLED && cell[1] == e->cells.n[1] - 1;
}

GG_INLINE bool gg_md_is_wall_below(const gg_md *e, const int32_t *cell)
{
  (void)e; /* sheared */
  return IS_WALLED && cell[1] == 0;
}

/* Times until a grain on a parabola reaches a face along each axis, by distance (INFINITY: a wall), velocity and
 * acceleration away from it: gg_fall_delay of three faces at once. Lane 3 has none. */
GG_INLINE gg_axes gg_md_fall_delays(gg_axes h, gg_axes u, gg_axes w)
{
  const gg_axes zero = {0}, never = {INFINITY, INFINITY, INFINITY, INFINITY};
  gg_axes discriminant = u * u + 2 * w * h,
          root = gg_sqrt_axes(gg_choose_axes(discriminant > zero, discriminant, zero));
  gg_axes_mask towards = u > zero, there = h <= zero;
  gg_axes_mask meets = (towards | (w > zero)) & (there | (discriminant >= zero)) & (h < never);
  gg_axes delay = gg_choose_axes(towards, 2 * h, root - u) / gg_choose_axes(towards, u + root, w);
  delay = gg_choose_axes(delay > zero, delay, zero);
  return gg_choose_axes(meets & (gg_axes_mask){-1, -1, -1, 0}, delay, never);
}

/* Time until a grain on a parabola reaches the first of the faces below and above along each axis, by their distances;
 * of equal times the face with the smallest number. */
GG_INLINE double gg_md_fall_to_face(const gg_md *e, gg_axes below, gg_axes above, gg_axes v, int32_t *face)
{
  const gg_axes g = {e->gravity.x, e->gravity.y, e->gravity.z, 0};
  const gg_axes down = gg_md_fall_delays(below, -v, -g), up = gg_md_fall_delays(above, v, g);
  const gg_axes first = gg_least_axes(gg_choose_axes(down < up, down, up));
  const uint32_t lower = gg_axes_bits(down <= first), axis = (uint32_t)__builtin_ctz(lower | gg_axes_bits(up <= first));
  *face = (int32_t)(2 * axis + !(lower >> axis & 1));
  return first[0];
}

/* Time until a grain on a parabola leaves its cell, and the face. */
GG_INLINE double gg_md_first_fall_out(const gg_md *e, const gg_md_search *s, int32_t *face)
{
  const int32_t *cell = e->node[s->grain].cell;
  gg_axes lower = __builtin_convertvector(gg_load_indices(cell), gg_axes), width = gg_load_axes(e->cells.width);
  gg_axes r = gg_load_axes(&s->self->r.x), below = r - lower * width, above = (lower + 1) * width - r;
  if (gg_md_is_wall_below(e, cell)) below[1] = INFINITY;
  if (gg_md_is_wall_above(e, cell)) above[1] = INFINITY;
  return gg_md_fall_to_face(e, below, above, gg_load_axes(&s->self->v.x), face);
}

/* The same on a straight path. If rounding has left the grain outside by a last digit, the time is 0. */
GG_INLINE double gg_md_first_exit(const gg_md *e, const int32_t *cell, gg_axes r, gg_axes v, int32_t *face)
{
  gg_axes zero = {0}, one = {1, 1, 1, 1};
  gg_axes never = {INFINITY, INFINITY, INFINITY, INFINITY};
  gg_axes_mask up = v > 0, open = (v != 0) & (gg_axes_mask){-1, -1, -1, 0};
  if (gg_md_is_wall_below(e, cell)) open &= up | (gg_axes_mask){-1, 0, -1, 0};
  if (gg_md_is_wall_above(e, cell)) open &= ~up | (gg_axes_mask){-1, 0, -1, 0};
  gg_axes ahead = __builtin_convertvector(gg_load_indices(cell), gg_axes) + gg_choose_axes(up, one, zero);
  gg_axes delay = (ahead * gg_load_axes(e->cells.width) - r) / v;
  delay = gg_choose_axes(open, gg_choose_axes(delay > 0, delay, zero), never);
  gg_axes first = gg_least_axes(delay);
  int axis = __builtin_ctz(gg_axes_bits(delay == first));
  *face = 2 * axis + (int)(gg_axes_bits(up) >> axis & 1);
  return first[0];
}

#endif
