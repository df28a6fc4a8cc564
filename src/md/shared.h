/* Cells that overlap, for dilute gases: each reaches half a contact distance beyond its faces, and a grain is in every
 * cell whose extended region it is in, one or two along each axis. Two grains that touch share a cell, so a grain looks
 * only at those who share one with it; and there is something new to see only when it comes into another cell, whose
 * members are then looked at: one cell or two where ordinary cells would be nine, and with cells as wide as pays.
 * Leaving a cell is no event: it is done at the grain's next one.
 *
 * node->cell is the lower cell along each axis; bit a of node->neighbours tells whether the grain is in the next one
 * along axis a, too. Nobody is in cells across a sheared boundary: who is near it searches a window beyond it. */
#ifndef GG_MD_SHARED_H
#define GG_MD_SHARED_H

#include <math.h>

#include "md/lists.h"

/* From the lower edge of its lower cell to where a grain is, nearest image. */
GG_INLINE double gg_depth(const gg_md *e, const gg_node *node, int axis, double x)
{
  double depth = x - node->cell[axis] * e->cells.width[axis];
  return depth - e->box.edge[axis] * gg_nearest(depth * e->box.inverse[axis]);
}

/* Is there no cell beyond, upwards or downwards? */
GG_INLINE bool gg_is_last(const gg_md *e, gg_features f, int axis, int32_t cell, int up)
{
  return f.sheared && axis == 1 && cell == (up ? e->cells.n[1] - 1 : 0);
}

/* Every cell that a grain is in: its index, for each of up to eight; returns how many. Restricted to the cells `only`
 * along `axis`, if that is not negative. */
GG_INLINE uint32_t gg_shared_cells(const gg_md *e, const gg_node *node, int axis, int32_t only, size_t index[8])
{
  const gg_cells *c = &e->cells;
  uint32_t part[3][2], n[3], count = 0;
  for (int a = 0; a < 3; a++) {
    part[a][0] = c->part[a][a == axis ? only : node->cell[a]];
    part[a][1] = c->part[a][node->cell[a] + 1];
    n[a] = a == axis ? 1 : 1 + (node->neighbours >> a & 1);
  }
  for (uint32_t z = 0; z < n[2]; z++)
    for (uint32_t y = 0; y < n[1]; y++)
      for (uint32_t x = 0; x < n[0]; x++) index[count++] = (size_t)part[2][z] + part[1][y] + part[0][x];
  return count;
}

/* Out of the cells `only` along `axis`, or of all (axis -1). What stands behind a cell's end may be anybody: the first
 * place found is the one. No branch depends on where it is. */
GG_INLINE void gg_shared_leave(gg_md *e, uint32_t i, int axis, int32_t only)
{
  size_t index[8];
  uint32_t n = gg_shared_cells(e, &e->node[i], axis, only, index), stride = e->cells.stride;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t *cell = e->cells.cell + index[k] * stride, at = UINT32_MAX;
    for (uint32_t base = 0; at == UINT32_MAX; base += 8)
      for (uint32_t m = base ? 0 : 1; m < 8; m++) {
        uint32_t found = cell[base + m] == i ? base + m : UINT32_MAX;
        at = found < at ? found : at;
      }
    cell[at] = cell[cell[0]--];
  }
}

/* Into them. False: out of memory. */
GG_INLINE bool gg_shared_enter(gg_md *e, uint32_t i, int axis, int32_t only)
{
  size_t index[8];
  uint32_t n = gg_shared_cells(e, &e->node[i], axis, only, index);
  for (uint32_t k = 0; k < n; k++) {
    uint32_t *cell = e->cells.cell + index[k] * e->cells.stride;
    if (cell[0] + 1 == e->cells.stride) {
      if (!gg_cells_grow(&e->cells)) return false;
      cell = e->cells.cell + index[k] * e->cells.stride;
    }
    cell[++cell[0]] = i;
  }
  return true;
}

/* The cells of a place in the box. */
GG_INLINE void gg_shared_place(const gg_md *e, gg_features f, gg_vec r, gg_node *node)
{
  double half = 0.5 * e->cells.reach;
  gg_md_cell_of(&e->cells, r, node->cell);
  node->neighbours = 0;
  for (int a = 0; a < 3; a++) {
    double depth = gg_along(&r, a) - node->cell[a] * e->cells.width[a];
    if (depth > e->cells.width[a] - half && !gg_is_last(e, f, a, node->cell[a], 1)) {
      node->neighbours |= 1u << a;
    } else if (depth < half && !gg_is_last(e, f, a, node->cell[a], 0)) {
      node->neighbours |= 1u << a;
      node->cell[a] = node->cell[a] ? node->cell[a] - 1 : e->cells.n[a] - 1;
    }
  }
}

GG_INLINE int32_t gg_cell_after(const gg_md *e, int axis, int32_t cell)
{
  return cell + 1 == e->cells.n[axis] ? 0 : cell + 1;
}

/* Out of the cells along one axis that the grain is beyond by now. */
GG_INLINE void gg_shared_trim(gg_md *e, uint32_t i, int axis, double x)
{
  gg_node *node = &e->node[i];
  double half = 0.5 * e->cells.reach, width = e->cells.width[axis];
  if (!(node->neighbours >> axis & 1)) return;
  double depth = gg_depth(e, node, axis, x);
  if (depth > width + half) {
    gg_shared_leave(e, i, axis, node->cell[axis]);
    node->neighbours &= ~(1u << axis);
    node->cell[axis] = gg_cell_after(e, axis, node->cell[axis]);
  } else if (depth < width - half) {
    gg_shared_leave(e, i, axis, node->cell[axis] + 1);
    node->neighbours &= ~(1u << axis);
  }
}

/* When the grain comes into another cell, and along which axis, which way. */
GG_INLINE double gg_shared_next(const gg_md *e, gg_features f, const gg_search *s, int32_t *face)
{
  const gg_node *node = &e->node[s->grain];
  double half = 0.5 * e->cells.reach, first = INFINITY;
  *face = 0;
  for (int a = 0; a < 3; a++) {
    double v = gg_along(&s->self->v, a), width = e->cells.width[a];
    double depth = gg_depth(e, node, a, gg_along(&s->self->r, a));
    int up = v > 0, both = node->neighbours >> a & 1;
    double way[2] = {depth - half, (both + 1) * width - half - depth};
    if (f.sheared && a == 1) { /* or through the boundary */
      if (gg_is_last(e, f, a, node->cell[a] + (up ? both : 0), up)) way[up] += half;
    }
    double delay = way[up] / fabs(v);
    delay = delay > 0 ? delay : 0; /* at rest: NAN or infinite */
    delay = v != 0 ? delay : INFINITY;
    *face = delay < first ? 2 * a + up : *face;
    first = delay < first ? delay : first;
  }
  double t = e->k.now + first;
  if (f.sheared && s->valid < t) t = s->valid, *face = GG_SLIDE;
  return t;
}

/* The row across the sheared boundary, searched around where the grain is in it: what it can touch until a time
 * `valid`, with a cell of store in the direction in which it moves along the row. */
GG_INLINE void gg_shared_slide(const gg_md *e, gg_features f, gg_search *s, int side)
{
  const gg_cells *c = &e->cells;
  const gg_node *node = &e->node[s->grain];
  double w = c->width[0], reach = 1.5 * c->reach, speed = s->self->v.x - side * e->box.slide;
  double x = s->self->r.x - side * gg_offset(&e->box, e->k.now);
  int32_t from = (int32_t)gg_floor((x - reach) / w), to = (int32_t)gg_floor((x + reach) / w);
  if (speed < 0)
    from--;
  else
    to++;
  double room = speed < 0 ? x - c->reach - from * w : (to + 1) * w - x - c->reach;
  double valid = e->k.now + room / fabs(speed); /* at rest in the row: never */
  if (valid < s->valid) s->valid = valid;
  int deep = node->neighbours >> 2 & 1;
  for (int32_t z = node->cell[2]; z <= node->cell[2] + deep; z++) {
    gg_vec shift = {0, 0, 0};
    int32_t iz = gg_image_cell(e, 2, z, &shift.z);
    gg_scan_row(e, f, s, from, to, side > 0 ? 0 : c->n[1] - 1, iz, shift, 0);
  }
}

/* Two grains touch across the sheared boundary only where both are within reach of it. Who is not so far, at this
 * height above or below it, looks across when it comes there: whoever of the two has the last event sees the other. */
GG_INLINE void gg_shared_approach(const gg_md *e, gg_features f, gg_search *s, int side, double height)
{
  double reach = e->cells.reach, speed = side * s->self->v.y;
  if (height < 1.25 * reach) {
    gg_shared_slide(e, f, s, side);
  } else if (speed > 0) {
    double valid = e->k.now + (height - reach) / speed;
    if (valid < s->valid) s->valid = valid;
  }
}

GG_INLINE void gg_shared_slides(const gg_md *e, gg_features f, gg_search *s)
{
  s->valid = INFINITY;
  if (!f.sheared) return;
  const gg_node *node = &e->node[s->grain];
  double y = s->self->r.y;
  int top = node->cell[1] + (int)(node->neighbours >> 1 & 1) == e->cells.n[1] - 1;
  if (top) gg_shared_approach(e, f, s, 1, e->box.edge[1] - y);
  if (node->cell[1] == 0) gg_shared_approach(e, f, s, -1, y);
}

GG_INLINE void gg_shared_take(const gg_md *e, gg_features f, gg_search *s, int axis, int32_t only)
{
  size_t index[8];
  uint32_t n = gg_shared_cells(e, &e->node[s->grain], axis, only, index);
  const uint32_t *cell = e->cells.cell;
  size_t stride = e->cells.stride;
  for (uint32_t k = 0; k < n; k++) index[k] *= stride;
  if (gg_has_room(e, 8)) {
    uint32_t n_near = s->n_near;
    for (uint32_t k = 0; k < n; k++) n_near = gg_append_cell(s->near, n_near, cell + index[k]);
    s->n_near = n_near;
  } else {
    for (uint32_t k = 0; k < n; k++) gg_take_cell(s, cell + index[k]);
  }
  gg_shared_slides(e, f, s);
}

/* All who share a cell with the grain, after it has been taken out of cells that it has left. */
GG_INLINE void gg_shared_scan(gg_md *e, gg_features f, gg_search *s)
{
  if (e->node[s->grain].neighbours)
    for (int a = 0; a < 3; a++) gg_shared_trim(e, s->grain, a, gg_along(&s->self->r, a));
  gg_shared_take(e, f, s, -1, 0);
}

/* Into the next cell along an axis: those who are there. */
GG_INLINE bool gg_shared_cross(gg_md *e, gg_features f, gg_search *s, int axis, int up)
{
  gg_node *node = &e->node[s->grain];
  gg_grain *g = &e->grain[s->grain];
  int32_t n = e->cells.n[axis], *cell = &node->cell[axis];
  if (node->neighbours & ~(1u << axis))
    for (int a = 0; a < 3; a++)
      if (a != axis) gg_shared_trim(e, s->grain, a, gg_along(&g->r, a));
  if (node->neighbours >> axis & 1) gg_shared_leave(e, s->grain, axis, up ? *cell : *cell + 1);
  if (!up)
    *cell = *cell ? *cell - 1 : n - 1;
  else if (node->neighbours >> axis & 1)
    *cell = gg_cell_after(e, axis, *cell);
  node->neighbours |= 1u << axis;
  if (!(f.sheared && axis == 1)) {
    double *x = gg_component(&g->r, axis);
    *x = gg_wrap(*x, e->box.edge[axis], e->box.inverse[axis]);
  }
  bool good = gg_shared_enter(e, s->grain, axis, *cell + up);
  gg_shared_take(e, f, s, axis, *cell + up);
  return good;
}

#endif
