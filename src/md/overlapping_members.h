/* Cells that overlap, for dilute gases: each reaches half a contact distance beyond its faces, and a grain is in every
 * cell whose extended region it is in, one or two along each axis. Two grains that touch share a cell, so a grain tries
 * only those who share one with it; and there is somebody new to try only when it comes into another cell, whose
 * members are then tried: one cell or two where ordinary cells would be nine, and with cells as wide as pays.
 * Leaving a cell is no event: it is done at the grain's next one.
 *
 * node->cell is the lower cell along each axis; bit a of node->neighbours tells whether the grain is in the next one
 * along axis a, too. Under shear: members_in_rows.h. */
#ifndef GG_MD_MEMBERS_H
#define GG_MD_MEMBERS_H

#include <string.h>

#include "md/md_state.h"
#include "simd/axes.h"

/* From the lower edges of its lower cells to where a grain is, nearest image. */
GG_INLINE gg_axes gg_md_depths(const gg_md *e, const gg_md_node *node, const gg_vec *r)
{
  gg_axes cell = __builtin_convertvector(gg_load_indices(node->cell), gg_axes);
  gg_axes depth = gg_load_axes(&r->x) - cell * gg_load_axes(e->cells.width);
  return depth - gg_load_axes(e->box.edge) * gg_nearest_axes(depth * gg_load_axes(e->box.inverse));
}

/* Cells that a grain may be in: number `index` is up along those axes whose bits are set in that number. `which` has
 * a bit for each that it is in. */
typedef struct gg_md_members {
  uint32_t index[8], which;
} gg_md_members;

/* Numbers of which no other bits are set than of n. */
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

/* Into those of `in`. False: out of memory. */
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

/* The cells of a place in the box. */
GG_INLINE void gg_md_members_place(const gg_md *e, gg_vec r, gg_md_node *node)
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

GG_INLINE int32_t gg_md_cell_after(const gg_md *e, int axis, int32_t cell)
{
  return cell + 1 == e->cells.n[axis] ? 0 : cell + 1;
}

#endif
