/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces of a grain's own cell: which does it reach next, and when? */
#ifndef GG_MD_SEARCH_FACES_H
#define GG_MD_SEARCH_FACES_H

#include "common/surface/plane.h"
#include "md/search/search.h"
#include "simd/axes.h"

/* Faces that are walls are not crossed. */
GG_INLINE bool gg_md_is_wall_above(const gg_md *e, const int32_t *cell)
{
  return IS_WALLED && cell[1] == e->cells.n[1] - 1;
}

GG_INLINE bool gg_md_is_wall_below(const gg_md *e, const int32_t *cell)
{
  (void)e; /* sheared */
  return IS_WALLED && cell[1] == 0;
}

/* When a grain on a parabola leaves its cell along one axis, and through which face. */
GG_INLINE double gg_md_fall_out(const gg_md *e, const gg_md_search *s, int axis, int32_t *face)
{
  double x = gg_along(&s->self->r, axis), v = gg_along(&s->self->v, axis), width = e->cells.width[axis];
  const int32_t *cell = e->node[s->grain].cell;
  bool bottom = axis == 1 && gg_md_is_wall_below(e, cell), top = axis == 1 && gg_md_is_wall_above(e, cell);
  double w = gg_along(&e->gravity, axis);
  double down = bottom ? INFINITY : gg_fall_delay(x - cell[axis] * width, -v, -w);
  double up = top ? INFINITY : gg_fall_delay((cell[axis] + 1) * width - x, v, w);
  *face = 2 * axis + (up < down);
  return up < down ? up : down;
}

GG_INLINE double gg_md_first_fall_out(const gg_md *e, const gg_md_search *s, int32_t *face)
{
  int32_t other;
  double first = gg_md_fall_out(e, s, 0, face);
  for (int axis = 1; axis < 3; axis++) {
    double delay = gg_md_fall_out(e, s, axis, &other);
    *face = delay < first ? other : *face;
    first = delay < first ? delay : first;
  }
  return first;
}

/* The same on a straight line. Rounding may have left the grain outside by a digit: then at once. */
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
