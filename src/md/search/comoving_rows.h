/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neighbour search under shear: each row of cells along x moves with the mean flow at its middle, so the flow carries
 * no grain through cells, however large the box, and the sheared boundary is a boundary of rows like any other.
 *
 * The row above a row moves by the fractional shift f (row_motion.c), from 0 to a cell's width w, then begins again one
 * cell further: the rows shift. In between, contact distances are at most w, so grains of a cell can touch grains in
 * four cells of the row above and in four of the row below:
 *
 *   above:  -2 -1  0 +1     ahead by f
 *   own:       -1  0 +1
 *   below:     -1  0 +1 +2  behind by f
 *
 * In reversed shear f falls from w to 0, and the rows shift back by a cell.
 *
 * A grain that enters another cell searches the cells that are new to it. When the rows shift, every grain searches the
 * cells above that come within reach (-2; +1 after a shift back). So of two grains in cells within reach one has always
 * tested the other. */
#ifndef GG_MD_SEARCH_COMOVING_ROWS_H
#define GG_MD_SEARCH_COMOVING_ROWS_H

#include "md/search/features.h"

enum {
  ROWS_SHIFT = true,
  ROWS_MOVE = true,
  KNOWS_IMAGES = true,
  FEW_MEET = false,
  HAS_COPIES = false,
  CACHED = 6000,
  SMALL_CELLS = true,
  PREDICTS_IN_PLACE = false
};

#include "md/row_motion.h"
#include "md/search/candidates.h"
#include "md/search/faces.h"
#include "md/search/neighbour_search.h"
#include "md/search/pair.h"
#include "md/search/prefetch_partner.h"
#include "md/search/simd_pairs.h"

/* Cells to search, from [0] to [1] relative to the grain's own cell: in its row, in the rows above and below, and
 * layers along z. [0] > [1]: none. */
typedef struct gg_md_window {
  int own[2], above[2], below[2], deep[2];
} gg_md_window;

/* Search cells range[0] to range[1] of a row. x: terms of the cell index. In SIMD kernels their grains become
 * candidates as far as there is room. */
GG_INLINE void gg_md_try_row(const gg_md *e, gg_md_search *s, const uint32_t *row, const uint32_t *x,
                             const int range[2])
{
  for (int k = range[0]; k <= range[1]; k++) {
    const uint32_t *cell = row + (size_t)x[k] * e->cells.stride;
    if (IS_SIMD && gg_md_take_cell(s, cell)) continue;
    uint32_t found[GG_MD_MOST_IN_SMALL];
    const uint32_t *who = gg_md_cell_members(&e->cells, cell, found);
    for (uint32_t m = 0; m < cell[0]; m++)
      if (who[m] != s->grain) gg_md_try_nearest(e, s, who[m]);
  }
}

/* Terms of the cell index for the rows of a window. */
typedef struct gg_md_window_rows {
  const uint32_t *own, *above, *below, *y, *z;
} gg_md_window_rows;

/* Gather the cells of one row in all layers. Row by row there are so few addresses that all are in registers. */
GG_INLINE void gg_md_take_row(gg_md_gathered *found, const gg_md_cells *c, const uint32_t *row,
                              const uint32_t *const layer[3], const uint32_t *x, const int range[2], const int deep[2],
                              size_t stride, gg_md_cell_size size)
{
  size_t step[4];
  for (int k = range[0]; k <= range[1]; k++) step[k - range[0]] = x[k] * stride;
  for (int m = deep[0]; m <= deep[1]; m++)
    for (int k = 0; k <= range[1] - range[0]; k++)
      gg_md_gather_cell(found, c, layer[m + 1] + (size_t)*row * stride + step[k], size);
}

/* Gather all cells of a window, for which there is room. Constants are in local variables (gg_md_take_rows). */
GG_INLINE bool gg_md_take_window(const gg_md *e, gg_md_search *s, const gg_md_window_rows *rows, const gg_md_window *w,
                                 size_t stride, gg_md_cell_size size)
{
  const gg_md_cells *c = &e->cells;
  const uint32_t *z = rows->z, y[3] = {rows->y[-1], rows->y[0], rows->y[1]}, *layer[3];
  for (int m = w->deep[0]; m <= w->deep[1]; m++) layer[m + 1] = c->cell + z[m] * stride;
  gg_md_gathered found = {s->candidates, s->n_candidates, 0};
  gg_md_take_row(&found, c, y + 1, layer, rows->own, w->own, w->deep, stride, size);
  gg_md_take_row(&found, c, y + 2, layer, rows->above, w->above, w->deep, stride, size);
  gg_md_take_row(&found, c, y, layer, rows->below, w->below, w->deep, stride, size);
  return gg_md_keep_gathered(s, &found);
}

static __attribute__((noinline, cold, unused)) void
gg_md_take_overfull_window(const gg_md *e, gg_md_search *s, const gg_md_window_rows *rows, const gg_md_window *w)
{
  gg_md_take_window(e, s, rows, w, GG_MD_SMALL_CELL, GG_MD_OVERFULL_CELLS);
}

GG_INLINE void gg_md_take_small_window(const gg_md *e, gg_md_search *s, const gg_md_window_rows *rows,
                                       const gg_md_window *w)
{
  if (!gg_md_take_window(e, s, rows, w, GG_MD_SMALL_CELL, GG_MD_SMALL_CELLS)) gg_md_take_overfull_window(e, s, rows, w);
}

/* The same for large cells: a call, because they are rare. */
static __attribute__((noinline, unused)) void
gg_md_take_large_window(const gg_md *e, gg_md_search *s, const gg_md_window_rows *rows, const gg_md_window *w)
{
  gg_md_take_window(e, s, rows, w, e->cells.stride, GG_MD_LARGE_CELLS);
}

/* Search the cells of a window one by one: on the reference path, and where there may be no room for all. */
static __attribute__((noinline)) void gg_md_scan_one_by_one(const gg_md *e, gg_md_search *s,
                                                            const gg_md_window_rows *rows, const gg_md_window *w)
{
  for (int m = w->deep[0]; m <= w->deep[1]; m++) {
    const uint32_t *layer = e->cells.cell + (size_t)rows->z[m] * e->cells.stride;
    gg_md_try_row(e, s, layer + (size_t)rows->y[0] * e->cells.stride, rows->own, w->own);
    gg_md_try_row(e, s, layer + (size_t)rows->y[1] * e->cells.stride, rows->above, w->above);
    gg_md_try_row(e, s, layer + (size_t)rows->y[-1] * e->cells.stride, rows->below, w->below);
  }
}

GG_INLINE void gg_md_scan_window(const gg_md *e, gg_md_search *s, gg_md_window window)
{
  const gg_md_cells *c = &e->cells;
  const int32_t *at = e->node[s->grain].cell;
  const gg_md_row *row = &e->search.rows.row[at[1]];
  gg_md_window_rows rows = {.own = c->part[0] + at[0],
                            .above = c->part[0] + gg_md_index_in_row(e, at[0] - row->above),
                            .below = c->part[0] + gg_md_index_in_row(e, at[0] + row->below),
                            .y = c->part[1] + at[1],
                            .z = c->part[2] + at[2]};
  uint32_t layers = (uint32_t)c->n[1] - 2, deep = (uint32_t)c->n[2] - 2;
  s->regular = (uint32_t)(at[1] - 1) < layers;
  s->inside = s->regular & ((uint32_t)(at[2] - 1) < deep);
  if (!IS_SIMD || !gg_md_has_room(e, 33))
    gg_md_scan_one_by_one(e, s, &rows, &window);
  else if (c->stride == GG_MD_SMALL_CELL)
    gg_md_take_small_window(e, s, &rows, &window);
  else if (c->stride == 8)
    gg_md_take_window(e, s, &rows, &window, 8, GG_MD_EIGHT_WORDS);
  else
    gg_md_take_large_window(e, s, &rows, &window);
}

GG_INLINE void gg_md_search_all(gg_md *e, gg_md_search *s)
{
  gg_md_scan_window(e, s, (gg_md_window){{-1, 1}, {-2, 1}, {-1, 2}, {-1, 1}});
  if (IS_SIMD) gg_md_try_candidates(e, s);
}

/* Search the cells that are new after a step along x or z. */
GG_INLINE void gg_md_scan_window_ahead(const gg_md *e, gg_md_search *s, int axis, int step)
{
  gg_md_window w = {{-1, 1}, {-2, 1}, {-1, 2}, {-1, 1}};
  if (axis == 2)
    w.deep[0] = w.deep[1] = step;
  else {
    w.own[0] = w.own[1] = step;
    w.above[0] = w.above[1] = step > 0 ? 1 : -2;
    w.below[0] = w.below[1] = step > 0 ? 2 : -1;
  }
  gg_md_scan_window(e, s, w);
}

/* Move a grain into the row above (step 1) or below (-1), into one of two cells, by its position. Returns the cells to
 * search: all of the next row, and the end of the old row that was out of reach. */
GG_INLINE gg_md_window gg_md_change_row(gg_md *e, uint32_t i, int step)
{
  gg_md_node *node = &e->node[i];
  gg_md_grain *g = &e->grain[i];
  const gg_md_row *old = &e->search.rows.row[node->cell[1]];
  int32_t first = gg_md_index_in_row(e, node->cell[0] + (step > 0 ? -old->above - 1 : old->below));
  int32_t y = node->cell[1] + step, side = y < 0 ? -1 : y >= e->cells.n[1] ? 1 : 0;
  node->cell[1] = y - side * e->cells.n[1];
  if (side) {
    g->r.y -= side * e->box.edge[1];
    g->r.x -= side * gg_md_offset(&e->box, e->k.now);
    g->v.x -= side * e->box.image_velocity;
  }
  g->r.x = gg_wrap(g->r.x, e->box.edge[0], e->box.inverse[0]);
  double beyond = g->r.x - gg_md_row_begins(e, node->cell[1]) - (first + 1) * e->cells.width[0];
  beyond -= e->box.edge[0] * gg_nearest(beyond * e->box.inverse[0]);
  int second = beyond >= 0, low = step > 0 ? -1 : -2, end = second ? low + 3 : low;
  node->cell[0] = gg_md_index_in_row(e, first + second);
  gg_md_window w = {{0, -1}, {-2, 1}, {-1, 2}, {-1, 1}};
  if (step > 0)
    w.below[0] = w.below[1] = end;
  else
    w.above[0] = w.above[1] = end;
  return w;
}

/* Make position and velocity relative to the grain's row, in the image that is in its cell. */
GG_INLINE void gg_md_relative_to_row(const gg_md *e, const int32_t *cell, gg_axes *r, gg_axes *v)
{
  double x = (*r)[0] - gg_md_row_begins(e, cell[1]), depth = x - cell[0] * e->cells.width[0];
  (*r)[0] = x - e->box.edge[0] * gg_nearest(depth * e->box.inverse[0]);
  (*v)[0] -= e->search.rows.row[cell[1]].speed;
}

GG_INLINE double gg_md_next_crossing(const gg_md *e, const gg_md_search *s, int32_t *face)
{
  const int32_t *cell = e->node[s->grain].cell;
  gg_axes r = gg_load_axes(&s->self->r.x), v = gg_load_axes(&s->self->v.x);
  gg_md_relative_to_row(e, cell, &r, &v);
  return e->k.now + gg_md_first_exit(e, cell, r, v, face);
}

GG_INLINE void gg_md_cross(gg_md *e, uint32_t i)
{
  gg_md_node *node = &e->node[i];
  gg_md_search s = {.candidates = e->candidates};
  gg_md_begin_search(&s, i, gg_md_synchronise(e, i), node->collision, node->partner);
  gg_md_grain *g = &e->grain[i];
  const gg_vec was = g->r;
  int axis = node->face >> 1, step = node->face & 1 ? 1 : -1;
  gg_md_leave_cell(e, i);
  if (axis == 1) {
    gg_md_window window = gg_md_change_row(e, i, step);
    if (e->image) gg_md_count_image(e, i, was);
    gg_md_enter_cell(e, i);
    gg_md_scan_window(e, &s, window);
  } else {
    int32_t at = node->cell[axis] + step, n = e->cells.n[axis], side = at < 0 ? -1 : at >= n ? 1 : 0;
    node->cell[axis] = at - side * n;
    *gg_component(&g->r, axis) -= side * e->box.edge[axis];
    if (e->image && side) gg_md_count_image(e, i, was);
    gg_md_enter_cell(e, i);
    gg_md_scan_window_ahead(e, &s, axis, step);
  }
  if (IS_SIMD) gg_md_try_candidates(e, &s);
  gg_md_schedule(e, &s, true);
}

/* Shift the rows by a cell: every grain searches the cells above that come within reach. For most grains this does not
 * change the next event, and nothing is written. */
static __attribute__((noinline)) void gg_md_search_shifted_rows(gg_md *e)
{
  e->k.now = e->search.rows.next_shift;
  const bool forwards = e->model.shear_rate > 0;
  const int come = forwards ? -2 : 1;
  gg_md_shift_rows_by_a_cell(e, forwards ? 1 : -1);
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_md_node *node = &e->node[i];
    gg_md_search s = {.candidates = e->candidates};
    gg_md_grain here = e->grain[i];
    here.r = gg_md_position(e, HAS_GRAVITY, &here, e->k.now);
    gg_md_begin_search(&s, i, &here, node->collision, node->partner);
    gg_md_scan_window(e, &s, (gg_md_window){{0, -1}, {come, come}, {0, -1}, {-1, 1}});
    if (IS_SIMD) gg_md_try_candidates(e, &s);
    if (s.collision < node->collision) gg_md_schedule(e, &s, false);
  }
}

GG_INLINE void gg_md_shift_all(gg_md *e)
{
  gg_md_search_shifted_rows(e);
}

/* Prefetch the cells around. Three neighbours along x are on two cache lines, four on three. */
GG_INLINE void gg_md_prefetch_ahead(const gg_md *e, uint32_t i)
{
  if (e->n <= 40000) return;
  const int32_t *at = e->node[i].cell;
  const gg_md_cells *c = &e->cells;
  const gg_md_row *own = &e->search.rows.row[at[1]];
  const uint32_t *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  const uint32_t *x[3] = {c->part[0] + gg_md_index_in_row(e, at[0] + own->below), c->part[0] + at[0],
                          c->part[0] + gg_md_index_in_row(e, at[0] - own->above)};
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++) {
      const uint32_t *row = c->cell + (size_t)(z[m] + y[l]) * c->stride;
      __builtin_prefetch(row + (size_t)x[l + 1][-1] * c->stride);
      __builtin_prefetch(row + (size_t)x[l + 1][1] * c->stride);
      if (l) __builtin_prefetch(row + (size_t)x[l + 1][-2 * l] * c->stride);
    }
}

#endif
