/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neighbour search in overlapping cells (overlapping_members.h). */
#ifndef GG_MD_SEARCH_OVERLAPPING_CELLS_H
#define GG_MD_SEARCH_OVERLAPPING_CELLS_H

#include "md/search/faces.h"
#include "md/search/overlapping.h"

/* A step to the next cell along an axis; axis 3: no step. */
typedef struct gg_md_step {
  int axis, up;
} gg_md_step;

/* Synchronise a grain, and wrap it into the box along the axis of a step. Each half of the record is written by one
 * store: a read soon after several partial stores would wait for them. */
GG_INLINE gg_md_grain *gg_md_synchronise_step(gg_md *e, uint32_t i, gg_md_step step)
{
  gg_md_grain *g = &e->grain[i];
  gg_axes_there *half = (gg_axes_there *)g;
  const double dt = e->k.now - g->t;
  gg_axes v = gg_load_axes(&g->v.x), r = gg_load_axes(&g->r.x) + dt * v;
  if (HAS_GRAVITY) {
    const gg_axes w = {e->gravity.x, e->gravity.y, e->gravity.z, 0};
    r += 0.5 * dt * dt * w;
    v += dt * w;
  }
  const gg_axes was = r;
  gg_axes wrapped = gg_wrap_axes(r, gg_load_axes(e->box.edge), gg_load_axes(e->box.inverse));
  r = gg_choose_axes(gg_axes_of(1u << step.axis), wrapped, r);
  const gg_axes now = {0, 0, e->k.now, half[1][3]};
  half[0] = __builtin_shufflevector(r, v, 0, 1, 2, 4);
  half[1] = __builtin_shufflevector(v, now, 1, 2, 6, 7);
  if (e->image) gg_md_count_image(e, i, (gg_vec){was[0], was[1], was[2]});
  return g;
}

/* Remove the grain from the cells that it has left, and from the cells behind its step. *in: the remaining cells.
 * Returns the new node->cell and neighbours, which the caller stores together. */
GG_INLINE gg_indices gg_md_leave_behind(gg_md *e, uint32_t i, gg_md_step step, gg_md_members *in)
{
  gg_md_node *node = &e->node[i];
  gg_axes width = gg_load_axes(e->cells.width), depth = gg_md_depths(e, node, &e->grain[i].r);
  double half = 0.5 * e->cells.reach;
  uint32_t both = node->neighbours, stepping = 1u << step.axis, rising = (uint32_t)step.up << step.axis;
  uint32_t above = ((gg_axes_bits(depth > width + half) & ~stepping) | rising) & both;
  uint32_t below = ((gg_axes_bits(depth < width - half) & ~stepping) | (stepping ^ rising)) & both;
  gg_md_members_of(e, node, in);
  both &= ~(above | below);
  uint32_t kept = gg_md_numbers_within(both) << above;
  gg_md_members_leave(e, i, in, in->which & ~kept);
  in->which = kept;
  gg_indices cell = gg_load_indices(node->cell) - gg_indices_of(above);
  cell &= cell != gg_load_indices(e->cells.n);
  cell[3] = (int32_t)both;
  return cell;
}

GG_INLINE void gg_md_store_cell(gg_md_node *node, gg_indices cell)
{
  *(gg_indices_there *)node->cell = cell;
}

/* True if the upper or only cell of the grain is the last one below a wall. */
GG_INLINE bool gg_md_is_below_wall(const gg_md *e, const gg_md_node *node)
{
  return IS_WALLED && node->cell[1] + (int32_t)(node->neighbours >> 1 & 1) == e->cells.n[1] - 1;
}

/* Time at which the grain enters another cell; *face: axis and direction. */
GG_INLINE double gg_md_next_crossing(const gg_md *e, const gg_md_search *s, int32_t *face)
{
  const gg_md_node *node = &e->node[s->grain];
  double half = 0.5 * e->cells.reach;
  gg_axes v = gg_load_axes(&s->self->v.x), width = gg_load_axes(e->cells.width);
  gg_axes depth = gg_md_depths(e, node, &s->self->r), zero = {0}, never = {INFINITY, INFINITY, INFINITY, INFINITY};
  gg_axes below = depth - half, above = gg_choose_axes(gg_axes_of(node->neighbours), 2 * width, width) - half - depth;
  if (gg_md_is_wall_below(e, node->cell)) below[1] = INFINITY;
  if (gg_md_is_below_wall(e, node)) above[1] = INFINITY;
  if (HAS_GRAVITY) return e->k.now + gg_md_fall_to_face(e, below, above, v, face);
  gg_axes way = gg_choose_axes(v > 0, above, below);
  gg_axes delay = way / (gg_axes)((gg_axes_mask)v & INT64_MAX);
  delay = gg_choose_axes(delay > 0, delay, zero); /* NaN or infinite for a grain at rest */
  delay = gg_choose_axes((v != 0) & (gg_axes_mask){-1, -1, -1, 0}, delay, never);
  gg_axes first = gg_least_axes(delay);
  int axis = __builtin_ctz(gg_axes_bits(delay == first));
  *face = 2 * axis + (int)(gg_axes_bits(v > 0) >> axis & 1);
  return e->k.now + first[0];
}

/* Search all grains that share a cell with the grain, after removing it from the cells that it has left. */
GG_INLINE void gg_md_search_all(gg_md *e, gg_md_search *s)
{
  gg_md_members in;
  gg_md_store_cell(&e->node[s->grain], gg_md_leave_behind(e, s->grain, (gg_md_step){3, 0}, &in));
  gg_md_take_members(e, s, &in);
  gg_md_try_candidates(e, s);
}

/* Enter the next cell along an axis, and gather its grains as candidates. False: out of memory. */
GG_INLINE bool gg_md_enter_next(gg_md *e, gg_md_search *s, gg_md_step step)
{
  gg_md_node *node = &e->node[s->grain];
  gg_md_members in;
  gg_indices cell = gg_md_leave_behind(e, s->grain, step, &in);
  int32_t at[4];
  memcpy(at, &cell, sizeof at);
  const uint32_t *part = e->cells.part[step.axis] + at[step.axis];
  uint32_t further = part[2 * step.up - 1] - part[0];
  for (int k = 0; k < 8; k++) in.index[k] += further;
  if (!step.up) cell += gg_indices_of(1u << step.axis); /* each is -1 */
  cell += gg_load_indices(e->cells.n) & (cell < 0);
  cell[3] |= 1 << step.axis;
  gg_md_store_cell(node, cell);
  gg_md_take_members(e, s, &in);
  return gg_md_members_enter(e, s->grain, &in);
}

/* The grain enters another overlapping cell. */
GG_INLINE void gg_md_cross(gg_md *e, uint32_t i)
{
  const gg_md_node *node = &e->node[i];
  gg_md_search s = {.candidates = e->candidates};
  gg_md_step step = {node->face >> 1, node->face & 1};
  gg_md_begin_search(&s, i, gg_md_synchronise_step(e, i, step), node->collision, node->partner);
  gg_md_check_memory(e, gg_md_enter_next(e, &s, step));
  gg_md_try_candidates(e, &s);
  gg_md_schedule(e, &s, true);
}

GG_INLINE bool gg_md_step_of(const gg_md *e, const gg_md_node *node, int *axis, int32_t at[3])
{
  (void)e, (void)node, (void)axis, (void)at;
  return true;
}

/* Prefetch from the outer to the inner level of the cache, if it holds all grains. */
GG_INLINE void gg_md_prefetch_cached(const gg_md *e, uint32_t i)
{
  const gg_md_node *node = &e->node[i];
  const gg_md_cells *c = &e->cells;
  const int32_t *at = node->cell;
  __builtin_prefetch(&e->grain[i]);
  int axis = node->face >> 1, step = 2 * (node->face & 1) - 1;
  const uint32_t *part = c->part[axis] + at[axis];
  uint32_t own = c->part[0][at[0]] + c->part[1][at[1]] + c->part[2][at[2]], next = own + part[step] - part[0];
  __builtin_prefetch(c->cell + (size_t)own * c->stride);
  __builtin_prefetch(c->cell + (size_t)next * c->stride);
}

#endif
