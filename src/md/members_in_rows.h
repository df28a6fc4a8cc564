/* Cells that overlap (overlapping_members.h), in a dilute gas under shear: rows of them along x, each of which moves
 * with the mean flow at its middle. Two grains that touch are together in the layer of one row, which reaches half a
 * contact distance beyond its faces, and there share a cell of that row. So each row is on its own, wherever the others
 * have moved to; and across the sheared boundary the next row is the image of the last one on the other side.
 *
 * A grain is in one row or in two, node->cell[1] and the next; in the lower one in cell node->cell[0], in the upper one
 * in node->upper. There are four lanes: along x in the lower row, along y, along z, along x in the upper row; bit a of
 * node->neighbours tells whether the grain is in the next cell along lane a, too. */
#ifndef GG_MD_MEMBERS_IN_ROWS_H
#define GG_MD_MEMBERS_IN_ROWS_H

#include "md/overlapping_members.h"
#include "md/rows.h"

/* Of a step: x and y of the lower and the upper row. Lane 4: nowhere. */
enum { GG_MD_LOWER_X, GG_MD_ALONG_Y, GG_MD_ALONG_Z, GG_MD_UPPER_X, GG_MD_NO_LANE };

/* Numbers of cells: bit 0 is x, bit 1 the row, bit 2 z. Which of them a grain is in. */
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

/* The grain's lower row, counted from those of the image of the box that it is stored in: -1 .. n_y. It comes into the
 * box when it next changes rows. */
GG_INLINE int32_t gg_md_lower_row(const gg_md *e, const gg_md_node *node, double y)
{
  double depth = y - node->cell[1] * e->cells.width[1];
  return node->cell[1] + (int32_t)gg_nearest(depth * e->box.inverse[1]) * e->cells.n[1];
}

/* The cell of a row in which the place x is now; *both: in the next one, too. Row -1 and row n_y are images. */
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

/* The cells of a place in the box. */
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
