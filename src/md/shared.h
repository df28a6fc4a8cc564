/* Cells that overlap, for dilute gases: each reaches half a contact distance beyond its faces, and a grain is in every
 * cell whose extended region it is in, one or two along each axis. Two grains that touch share a cell, so a grain looks
 * only at those who share one with it; and there is something new to see only when it comes into another cell, whose
 * members are then looked at: one cell or two where ordinary cells would be nine, and with cells as wide as pays.
 * Leaving a cell is no event: it is done at the grain's next one.
 *
 * node->cell is the lower cell along each axis; bit a of node->neighbours tells whether the grain is in the next one
 * along axis a, too. Under shear: shared_rows.h. */
#ifndef GG_MD_SHARED_H
#define GG_MD_SHARED_H

#include <math.h>

#include "md/axes.h"
#include "md/lists.h"

/* From the lower edges of its lower cells to where a grain is, nearest image. */
GG_INLINE gg_axes gg_depths(const gg_md *e, const gg_node *node, const gg_vec *r)
{
  gg_axes cell = __builtin_convertvector(gg_load_indices(node->cell), gg_axes);
  gg_axes depth = gg_load_axes(&r->x) - cell * gg_load_axes(e->cells.width);
  return depth - gg_load_axes(e->box.edge) * gg_nearest_axes(depth * gg_load_axes(e->box.inverse));
}

/* Cells that a grain may be in: number `index` is up along those axes whose bits are set in that number. `which` has
 * a bit for each that it is in. */
typedef struct gg_members {
  uint32_t index[8], which;
} gg_members;

/* Numbers of which no other bits are set than of n. */
GG_INLINE uint32_t gg_numbers_within(uint32_t n)
{
  static const uint8_t within[8] = {0x01, 0x03, 0x05, 0x0f, 0x11, 0x33, 0x55, 0xff};
  return within[n];
}

GG_INLINE void gg_shared_cells(const gg_md *e, const gg_node *node, gg_members *in)
{
  typedef uint32_t words __attribute__((vector_size(32)));
  const uint32_t *x = e->cells.part[0] + node->cell[0], *y = e->cells.part[1] + node->cell[1],
                 *z = e->cells.part[2] + node->cell[2];
  words up = {0, -1u, 0, -1u, 0, -1u, 0, -1u}, along = {0, 0, -1u, -1u, 0, 0, -1u, -1u};
  words deep = {0, 0, 0, 0, -1u, -1u, -1u, -1u};
  words index = x[0] + y[0] + z[0] + (up & (x[1] - x[0])) + (along & (y[1] - y[0])) + (deep & (z[1] - z[0]));
  memcpy(in->index, &index, sizeof index);
  in->which = gg_numbers_within(node->neighbours);
}

GG_INLINE void gg_shared_leave(gg_md *e, uint32_t i, const gg_members *in, uint32_t which)
{
  size_t stride = e->cells.stride;
  for (; which; which &= which - 1) gg_cell_remove(e->cells.cell + in->index[__builtin_ctz(which)] * stride, i);
}

/* Into those of `in`. False: out of memory. */
GG_INLINE bool gg_shared_enter(gg_md *e, uint32_t i, const gg_members *in)
{
  for (uint32_t which = in->which; which; which &= which - 1) {
    size_t index = in->index[__builtin_ctz(which)];
    uint32_t *cell = e->cells.cell + index * e->cells.stride;
    if (__builtin_expect(cell[0] + 1 == e->cells.stride, 0)) {
      if (!gg_cells_grow(&e->cells)) return false;
      cell = e->cells.cell + index * e->cells.stride;
    }
    cell[++cell[0]] = i;
  }
  return true;
}

/* The cells of a place in the box. */
GG_INLINE void gg_shared_place(const gg_md *e, gg_vec r, gg_node *node)
{
  double half = 0.5 * e->cells.reach;
  gg_md_cell_of(&e->cells, r, node->cell);
  node->neighbours = 0;
  for (int a = 0; a < 3; a++) {
    double depth = gg_along(&r, a) - node->cell[a] * e->cells.width[a];
    if (depth > e->cells.width[a] - half) {
      node->neighbours |= 1u << a;
    } else if (depth < half) {
      node->neighbours |= 1u << a;
      node->cell[a] = node->cell[a] ? node->cell[a] - 1 : e->cells.n[a] - 1;
    }
  }
}

GG_INLINE int32_t gg_cell_after(const gg_md *e, int axis, int32_t cell)
{
  return cell + 1 == e->cells.n[axis] ? 0 : cell + 1;
}

/* To the next cell along an axis; axis 3: nowhere. */
typedef struct gg_step {
  int axis, up;
} gg_step;

/* gg_settle, and into the box along the axis of a step. The record is written as a whole: what is read of it soon after
 * would otherwise wait for its parts to arrive in the cache. */
GG_INLINE gg_grain *gg_settle_step(gg_md *e, uint32_t i, gg_step step)
{
  gg_grain *g = &e->grain[i];
  gg_line *record = (gg_line *)g;
  gg_v8 old = *record;
  gg_axes r = gg_load_axes(&g->r.x) + (e->k.now - g->t) * gg_load_axes(&g->v.x);
  gg_axes wrapped = gg_wrap_axes(r, gg_load_axes(e->box.edge), gg_load_axes(e->box.inverse));
  r = gg_choose_axes(gg_axes_of(1u << step.axis), wrapped, r);
  gg_v8 new = __builtin_shufflevector(r, r, 0, 1, 2, 3, 4, 5, 6, 7);
  new = __builtin_shufflevector(new, old, 0, 1, 2, 11, 12, 13, 14, 15);
  new[6] = e->k.now;
  *record = new;
  return g;
}

/* Out of the cells that the grain is beyond by now, and of those behind the step that it is about to make. `in` are
 * those that are left. Returns what node->cell and neighbours then are: nobody reads them by words before they are
 * written. */
GG_INLINE gg_indices gg_shared_trim(gg_md *e, uint32_t i, gg_step step, gg_members *in)
{
  gg_node *node = &e->node[i];
  gg_axes width = gg_load_axes(e->cells.width), depth = gg_depths(e, node, &e->grain[i].r);
  double half = 0.5 * e->cells.reach;
  uint32_t both = node->neighbours, stepping = 1u << step.axis, rising = (uint32_t)step.up << step.axis;
  uint32_t above = ((gg_axes_bits(depth > width + half) & ~stepping) | rising) & both;
  uint32_t below = ((gg_axes_bits(depth < width - half) & ~stepping) | (stepping ^ rising)) & both;
  gg_shared_cells(e, node, in);
  both &= ~(above | below);
  uint32_t kept = gg_numbers_within(both) << above;
  gg_shared_leave(e, i, in, in->which & ~kept);
  in->which = kept;
  gg_indices cell = gg_load_indices(node->cell) - gg_indices_of(above);
  cell &= cell != gg_load_indices(e->cells.n);
  cell[3] = (int32_t)both;
  return cell;
}

GG_INLINE void gg_store_cell(gg_node *node, gg_indices cell)
{
  *(gg_indices_there *)node->cell = cell;
}

/* When the grain comes into another cell, and along which axis, which way. */
GG_INLINE double gg_shared_next(const gg_md *e, const gg_search *s, int32_t *face)
{
  const gg_node *node = &e->node[s->grain];
  double half = 0.5 * e->cells.reach;
  gg_axes v = gg_load_axes(&s->self->v.x), width = gg_load_axes(e->cells.width);
  gg_axes depth = gg_depths(e, node, &s->self->r), zero = {0}, never = {INFINITY, INFINITY, INFINITY, INFINITY};
  gg_axes upwards = gg_choose_axes(gg_axes_of(node->neighbours), 2 * width, width) - half - depth;
  gg_axes way = gg_choose_axes(v > 0, upwards, depth - half);
  gg_axes delay = way / (gg_axes)((gg_axes_mask)v & INT64_MAX);
  delay = gg_choose_axes(delay > 0, delay, zero); /* at rest: NAN or infinite */
  delay = gg_choose_axes((v != 0) & (gg_axes_mask){-1, -1, -1, 0}, delay, never);
  gg_axes first = gg_least_axes(delay);
  int axis = __builtin_ctz(gg_axes_bits(delay == first));
  *face = 2 * axis + (int)(gg_axes_bits(v > 0) >> axis & 1);
  return e->k.now + first[0];
}

/* The grains of a cell for which there may be no room: those so far are tried first. */
static __attribute__((noinline, cold, unused)) void gg_take_crowded(const gg_md *e, gg_features f, gg_search *s,
                                                                    const uint32_t *cell)
{
  for (uint32_t k = 1; k <= cell[0]; k++) {
    if (s->n_near == GG_MOST_NEAR) {
      gg_scan_near(e, f, s);
      s->n_near = 0;
    }
    s->near[s->n_near++] = cell[k];
  }
}

GG_INLINE void gg_shared_take(const gg_md *e, gg_features f, gg_search *s, const gg_members *in)
{
  const uint32_t *cell = e->cells.cell;
  size_t stride = e->cells.stride;
  if (__builtin_expect(!gg_has_room(e, 8), 0)) {
    for (uint32_t which = in->which; which; which &= which - 1)
      gg_take_crowded(e, f, s, cell + in->index[__builtin_ctz(which)] * stride);
    return;
  }
  uint32_t *end = s->near + s->n_near;
  for (uint32_t which = in->which; which; which &= which - 1)
    end = gg_append_large(end, cell + in->index[__builtin_ctz(which)] * stride);
  s->n_near = (uint32_t)(end - s->near);
}

/* All who share a cell with the grain, after it has been taken out of cells that it has left. */
GG_INLINE void gg_shared_scan(gg_md *e, gg_features f, gg_search *s)
{
  gg_members in;
  gg_store_cell(&e->node[s->grain], gg_shared_trim(e, s->grain, (gg_step){3, 0}, &in));
  gg_shared_take(e, f, s, &in);
}

/* Into the next cell along an axis: those who are there. */
GG_INLINE bool gg_shared_cross(gg_md *e, gg_features f, gg_search *s, gg_step step)
{
  gg_node *node = &e->node[s->grain];
  gg_members in;
  gg_indices cell = gg_shared_trim(e, s->grain, step, &in);
  int32_t at[4];
  memcpy(at, &cell, sizeof at);
  const uint32_t *part = e->cells.part[step.axis] + at[step.axis];
  uint32_t further = part[2 * step.up - 1] - part[0];
  for (int k = 0; k < 8; k++) in.index[k] += further;
  if (!step.up) cell += gg_indices_of(1u << step.axis); /* each is -1 */
  cell += gg_load_indices(e->cells.n) & (cell < 0);
  cell[3] |= 1 << step.axis;
  gg_store_cell(node, cell);
  gg_shared_take(e, f, s, &in);
  return gg_shared_enter(e, s->grain, &in);
}

#endif
