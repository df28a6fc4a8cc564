/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Membership of grains in overlapping cells, for dilute gases. Each cell reaches half a contact distance beyond its
 * faces, and a grain is a member of every cell whose extended region contains it: one or two along each axis. Two
 * grains that touch share a cell, so a grain is tested only against grains that share a cell with it. New candidates
 * appear only when it enters another cell: the members of one or two cells, where plain cells would have nine; and
 * cells can have the width that is fastest. Leaving a cell is no event: it is done at the grain's next event.
 *
 * node->cell is the lower cell along each axis; bit a of node->neighbours is set if the grain is also in the next cell
 * along axis a. */
#ifndef GG_MD_OVERLAPPING_MEMBERS_H
#define GG_MD_OVERLAPPING_MEMBERS_H

#include <string.h>

#include "md/md_state.h"
#include "md/row_motion.h"
#include "simd/axes.h"

/* Distances from the lower edges of its lower cells to the grain, nearest image. */
GG_INLINE gg_axes gg_md_depths(const gg_md *e, const gg_md_node *node, const gg_vec *r)
{
  gg_axes cell = __builtin_convertvector(gg_load_indices(node->cell), gg_axes);
  gg_axes depth = gg_load_axes(&r->x) - cell * gg_load_axes(e->cells.width);
  return depth - gg_load_axes(e->box.edge) * gg_nearest_axes(depth * gg_load_axes(e->box.inverse));
}

/* Cells that a grain may be in: cell number k is the upper one along the axes whose bits are set in k. `which` has bit
 * k set if the grain is in cell k. */
typedef struct gg_md_members {
  uint32_t index[8], which;
} gg_md_members;

/* Set of the numbers whose bits are a subset of the bits of n, a bit each. */
GG_INLINE uint32_t gg_md_numbers_within(uint32_t n)
{
  static const uint8_t within[8] = {0x01, 0x03, 0x05, 0x0f, 0x11, 0x33, 0x55, 0xff};
  return within[n];
}

GG_INLINE void gg_md_members_of(const gg_md *e, const gg_md_node *node, gg_md_members *in)
{
  typedef uint32_t words __attribute__((vector_size(32)));
  const uint32_t *x = e->cells.part[0] + node->cell[0], *y = e->cells.part[1] + node->cell[1],
                 *z = e->cells.part[2] + node->cell[2];
  words up = {0, -1u, 0, -1u, 0, -1u, 0, -1u}, along = {0, 0, -1u, -1u, 0, 0, -1u, -1u};
  words deep = {0, 0, 0, 0, -1u, -1u, -1u, -1u};
  words index = x[0] + y[0] + z[0] + (up & (x[1] - x[0])) + (along & (y[1] - y[0])) + (deep & (z[1] - z[0]));
  memcpy(in->index, &index, sizeof index);
  in->which = gg_md_numbers_within(node->neighbours);
}

GG_INLINE void gg_md_members_leave(gg_md *e, uint32_t i, const gg_md_members *in, uint32_t which)
{
  size_t stride = e->cells.stride;
  for (; which; which &= which - 1) gg_md_cell_remove(e->cells.cell + in->index[__builtin_ctz(which)] * stride, i);
}

/* Enter a grain into the cells of `in`. False: out of memory. */
GG_INLINE bool gg_md_members_enter(gg_md *e, uint32_t i, const gg_md_members *in)
{
  for (uint32_t which = in->which; which; which &= which - 1) {
    size_t index = in->index[__builtin_ctz(which)];
    uint32_t *cell = e->cells.cell + index * e->cells.stride;
    if (__builtin_expect(cell[0] + 1 == e->cells.stride, 0)) {
      if (!gg_md_cells_grow(&e->cells)) return false;
      cell = e->cells.cell + index * e->cells.stride;
    }
    cell[++cell[0]] = i;
  }
  return true;
}

/* Find the cells of a position in the box. */
GG_INLINE void gg_md_members_place(const gg_md *e, gg_vec r, gg_md_node *node)
{
  double half = 0.5 * e->cells.reach;
  gg_md_cell_of(&e->cells, r, node->cell);
  node->neighbours = 0;
  for (int a = 0; a < 3; a++) {
    double depth = gg_along(&r, a) - node->cell[a] * e->cells.width[a];
    const bool walled = a == 1 && e->model.walled; /* there is no cell beyond a wall */
    if (depth > e->cells.width[a] - half && !(walled && node->cell[a] == e->cells.n[a] - 1)) {
      node->neighbours |= 1u << a;
    } else if (depth < half && !(walled && node->cell[a] == 0)) {
      node->neighbours |= 1u << a;
      node->cell[a] = node->cell[a] ? node->cell[a] - 1 : e->cells.n[a] - 1;
    }
  }
}

GG_INLINE int32_t gg_md_cell_after(const gg_md *e, int axis, int32_t cell)
{
  return cell + 1 == e->cells.n[axis] ? 0 : cell + 1;
}

/* Lanes of a grain in overlapping cells under shear. The cells form rows along x, each of which moves with the mean
 * flow at its middle. Two grains that touch are both in the layer of one row, which reaches half a contact distance
 * beyond its faces, and share a cell of that row. So rows are independent of each other's motion. Across the sheared
 * boundary the next row is the image of the last one on the other side.
 *
 * A grain is in one row or two, node->cell[1] and the next: in the lower row in cell node->cell[0], in the upper row in
 * cell node->upper. Bit l of node->neighbours is set if it is also in the next cell along lane l. */
enum {
  GG_MD_LOWER_X, /* along x in the lower row */
  GG_MD_ALONG_Y,
  GG_MD_ALONG_Z,
  GG_MD_UPPER_X, /* along x in the upper row */
  GG_MD_NO_LANE  /* no step */
};

/* Set of the cells that a grain is in, a bit each. In the number of a cell bit 0 is x, bit 1 the row, bit 2 z. */
GG_INLINE uint32_t gg_md_numbers_in_rows(uint32_t both)
{
  uint32_t lower = 1 | (both & 1) << 1, upper = (both >> 1 & 1) * (4 | (both & 8));
  return (lower | upper) * (1 + ((both & 4) << 2));
}

GG_INLINE void gg_md_members_in_rows_of(const gg_md *e, const gg_md_node *node, gg_md_members *in)
{
  const uint32_t *lower = e->cells.part[0] + node->cell[0], *upper = e->cells.part[0] + node->upper,
                 *y = e->cells.part[1] + node->cell[1], *z = e->cells.part[2] + node->cell[2];
  for (int deep = 0; deep < 2; deep++) {
    uint32_t one = y[0] + z[deep], two = y[1] + z[deep], *index = in->index + 4 * deep;
    index[0] = lower[0] + one, index[1] = lower[1] + one;
    index[2] = upper[0] + two, index[3] = upper[1] + two;
  }
  in->which = gg_md_numbers_in_rows(node->neighbours);
}

/* Lower row of a grain, -1 .. n_y, relative to the image of the box in which it is stored. It returns to the box when
 * it next changes rows. */
GG_INLINE int32_t gg_md_lower_row(const gg_md *e, const gg_md_node *node, double y)
{
  double depth = y - node->cell[1] * e->cells.width[1];
  return node->cell[1] + (int32_t)gg_nearest(depth * e->box.inverse[1]) * e->cells.n[1];
}

/* Cell of a row that holds the position x now; *both: the next cell holds it, too. Rows -1 and n_y are images. */
GG_INLINE int32_t gg_md_place_in_row(const gg_md *e, int32_t row, double x, uint32_t *both)
{
  double w = e->cells.width[0], half = 0.5 * e->cells.reach;
  double depth = gg_wrap(x - gg_md_row_begins(e, row), e->box.edge[0], e->box.inverse[0]);
  int32_t cell = (int32_t)(depth * e->cells.inverse[0]);
  depth -= cell * w;
  bool under = depth < half;
  *both = under | (depth > w - half);
  return gg_md_index_in_row(e, cell - under);
}

/* Find the cells of a position in the box. */
GG_INLINE void gg_md_members_in_rows_place(const gg_md *e, gg_vec r, gg_md_node *node)
{
  double half = 0.5 * e->cells.reach;
  uint32_t both[2];
  gg_md_cell_of(&e->cells, r, node->cell);
  node->neighbours = 0;
  for (int a = 1; a < 3; a++) {
    double depth = gg_along(&r, a) - node->cell[a] * e->cells.width[a];
    if (depth < half && node->cell[a]-- == 0) node->cell[a] += e->cells.n[a];
    if (depth < half || depth > e->cells.width[a] - half) node->neighbours |= 1u << a;
  }
  int32_t row = gg_md_lower_row(e, node, r.y);
  node->cell[0] = gg_md_place_in_row(e, row, r.x, &both[0]);
  node->upper = gg_md_place_in_row(e, row + 1, r.x, &both[1]);
  node->neighbours |= both[0] | (node->neighbours & 2 ? both[1] << 3 : 0);
}

#endif
