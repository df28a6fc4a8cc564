/* Cells under shear: a grid in which each row of cells along x moves with the mean flow at its middle, so that the flow
 * carries nobody through cells, however large the box, and the sheared boundary is a boundary of rows like any other.
 *
 * The row above a row moves on by `lean` (rows.c), from 0 to a cell's width w, then begins again one cell further: the
 * rows slip. In between, a cell with contact distances of at most w sees what it can touch in four cells of the row
 * above and in four of the row below:
 *
 *   above:  -2 -1  0 +1     ahead by `lean`
 *   own:       -1  0 +1
 *   below:     -1  0 +1 +2  behind by `lean`
 *
 * Who comes into another cell looks at the cells that are new to it; and when the rows slip, everybody looks at the
 * cells above that come within reach (-2): thus of two grains in cells that see each other one has always looked at the
 * other. */
#ifndef GG_MD_ROWS_H
#define GG_MD_ROWS_H

#include "md/scan.h"

/* Fewest cells along x, in which the nearest image of all that a cell sees is the one that is looked at. */
enum { GG_FEWEST_DRIFTING = 7 };

/* Cells to look at: those from..to relative to the grain's own, in its own row and in those above and below, in layers
 * from..to along z. From above to: none. */
typedef struct gg_window {
  int own[2], above[2], below[2], deep[2];
} gg_window;

/* Index of a cell, up to n cells off. */
GG_INLINE int32_t gg_drifting_index(const gg_md *e, int32_t x)
{
  int32_t n = e->cells.n[0];
  return x < 0 ? x + n : x >= n ? x - n : x;
}

GG_INLINE void gg_try_nearest(const gg_md *e, gg_features f, gg_search *s, uint32_t j)
{
  const gg_grain *one = s->self, *two = &e->grain[j];
  gg_vec dr = gg_sub(gg_position(e, f.gravity, two, e->k.now), one->r);
  gg_vec dv = gg_sub(gg_velocity(e, f.gravity, two, e->k.now), one->v);
  gg_nearest_image(&e->box, f.sheared, e->k.now, &dr, &dv);
  gg_try_separated(e, f, s, j, dr, dv);
}

/* Cells from..to of a row, whose shares of the cell's number are `x`; in wide kernels as far as there is room. */
GG_INLINE void gg_drift_row(const gg_md *e, gg_features f, gg_search *s, const uint32_t *row, const uint32_t *x,
                            const int range[2])
{
  for (int k = range[0]; k <= range[1]; k++) {
    const uint32_t *cell = row + (size_t)x[k] * e->cells.stride;
    if (f.wide && gg_take_cell(s, cell)) continue;
    for (uint32_t m = 1; m <= cell[0]; m++)
      if (cell[m] != s->grain) gg_try_nearest(e, f, s, cell[m]);
  }
}

/* A window's rows, and their cells' shares of the cell's number. */
typedef struct gg_rows_seen {
  const uint32_t *own, *above, *below, *y, *z;
} gg_rows_seen;

/* Cells x[from..to] of the rows that begin with `row` in each layer. Row by row there are so few addresses that all are
 * in registers. */
GG_INLINE uint32_t gg_take_row(uint32_t *near, uint32_t n, const uint32_t *row, const uint32_t *const layer[3],
                               const uint32_t *x, const int range[2], const int deep[2], size_t stride)
{
  size_t step[4];
  for (int k = range[0]; k <= range[1]; k++) step[k - range[0]] = x[k] * stride;
  for (int m = deep[0]; m <= deep[1]; m++)
    for (int k = 0; k <= range[1] - range[0]; k++) {
      const uint32_t *cell = layer[m + 1] + (size_t)*row * stride + step[k];
      n = stride == 8 ? gg_append_small(near, n, cell) : gg_append_cell(near, n, cell);
    }
  return n;
}

/* All of a window, for which there is room: what does not change is in local variables (gg_take_rows). */
GG_INLINE void gg_take_window(const gg_md *e, gg_search *s, const gg_rows_seen *seen, const gg_window *w, size_t stride)
{
  const uint32_t *z = seen->z, y[3] = {seen->y[-1], seen->y[0], seen->y[1]}, *layer[3];
  for (int m = w->deep[0]; m <= w->deep[1]; m++) layer[m + 1] = e->cells.cell + z[m] * stride;
  uint32_t n = s->n_near;
  n = gg_take_row(s->near, n, y + 1, layer, seen->own, w->own, w->deep, stride);
  n = gg_take_row(s->near, n, y + 2, layer, seen->above, w->above, w->deep, stride);
  n = gg_take_row(s->near, n, y, layer, seen->below, w->below, w->deep, stride);
  s->n_near = n;
}

GG_INLINE void gg_drift_scan(const gg_md *e, gg_features f, gg_search *s, gg_window window)
{
  const gg_cells *c = &e->cells;
  const int32_t *at = e->node[s->grain].cell;
  const gg_row *row = &e->row[at[1]];
  gg_rows_seen seen = {.own = c->part[0] + at[0],
                       .above = c->part[0] + gg_drifting_index(e, at[0] - row->above),
                       .below = c->part[0] + gg_drifting_index(e, at[0] + row->below),
                       .y = c->part[1] + at[1],
                       .z = c->part[2] + at[2]};
  uint32_t layers = (uint32_t)c->n[1] - 2, deep = (uint32_t)c->n[2] - 2;
  s->regular = (uint32_t)(at[1] - 1) < layers;
  s->inside = s->regular & ((uint32_t)(at[2] - 1) < deep);
  if (f.wide && gg_has_room(e, 33)) {
    if (c->stride == 8)
      gg_take_window(e, s, &seen, &window, 8);
    else
      gg_take_window(e, s, &seen, &window, c->stride);
    return;
  }
  for (int m = window.deep[0]; m <= window.deep[1]; m++) {
    const uint32_t *layer = c->cell + (size_t)seen.z[m] * c->stride;
    gg_drift_row(e, f, s, layer + (size_t)seen.y[0] * c->stride, seen.own, window.own);
    gg_drift_row(e, f, s, layer + (size_t)seen.y[1] * c->stride, seen.above, window.above);
    gg_drift_row(e, f, s, layer + (size_t)seen.y[-1] * c->stride, seen.below, window.below);
  }
}

/* All that a grain can touch from its cell. */
GG_INLINE void gg_drift_around(const gg_md *e, gg_features f, gg_search *s)
{
  gg_drift_scan(e, f, s, (gg_window){{-1, 1}, {-2, 1}, {-1, 2}, {-1, 1}});
}

/* What is new after a step along x or z. */
GG_INLINE void gg_drift_ahead(const gg_md *e, gg_features f, gg_search *s, int axis, int step)
{
  gg_window w = {{-1, 1}, {-2, 1}, {-1, 2}, {-1, 1}};
  if (axis == 2)
    w.deep[0] = w.deep[1] = step;
  else {
    w.own[0] = w.own[1] = step;
    w.above[0] = w.above[1] = step > 0 ? 1 : -2;
    w.below[0] = w.below[1] = step > 0 ? 2 : -1;
  }
  gg_drift_scan(e, f, s, w);
}

/* Into the row above (step 1) or below (-1), where the grain is in one of two cells: into which is seen from where it
 * is. It looks at all of the next row, and at that end of the row that it comes from which it did not see before. */
GG_INLINE gg_window gg_change_row(gg_md *e, uint32_t i, int step)
{
  gg_node *node = &e->node[i];
  gg_grain *g = &e->grain[i];
  const gg_row *old = &e->row[node->cell[1]];
  int32_t first = gg_drifting_index(e, node->cell[0] + (step > 0 ? -old->above - 1 : old->below));
  int32_t y = node->cell[1] + step, side = y < 0 ? -1 : y >= e->cells.n[1] ? 1 : 0;
  node->cell[1] = y - side * e->cells.n[1];
  if (side) {
    g->r.y -= side * e->box.edge[1];
    g->r.x -= side * gg_offset(&e->box, e->k.now);
    g->v.x -= side * e->box.slide;
  }
  g->r.x = gg_wrap(g->r.x, e->box.edge[0], e->box.inverse[0]);
  double beyond = g->r.x - gg_row_begins(e, node->cell[1]) - (first + 1) * e->cells.width[0];
  beyond -= e->box.edge[0] * gg_nearest(beyond * e->box.inverse[0]);
  int second = beyond >= 0, low = step > 0 ? -1 : -2, end = second ? low + 3 : low;
  node->cell[0] = gg_drifting_index(e, first + second);
  gg_window w = {{0, -1}, {-2, 1}, {-1, 2}, {-1, 1}};
  if (step > 0)
    w.below[0] = w.below[1] = end;
  else
    w.above[0] = w.above[1] = end;
  return w;
}

#endif
