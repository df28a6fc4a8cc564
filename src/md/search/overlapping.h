/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common part of the searches with overlapping cells: candidates from the cells that a grain is in. */
#ifndef GG_MD_SEARCH_OVERLAPPING_H
#define GG_MD_SEARCH_OVERLAPPING_H

#include "md/search/features.h"

enum {
  ROWS_SHIFT = false,
  ROWS_MOVE = false,
  KNOWS_IMAGES = false,
  FEW_MEET = true,
  HAS_COPIES = true,
  CACHED = 20000,
  SMALL_CELLS = false,
  PREDICTS_IN_PLACE = false
};

#include "md/overlapping_members.h"
#include "md/search/candidates.h"
#include "md/search/neighbour_search.h"
#include "md/search/simd_pairs.h"

/* Append the grains of a cell that overflowed. Whenever there is no room, the candidates so far are tested first. */
static __attribute__((noinline, cold, unused)) void gg_md_take_crowded(const gg_md *e, gg_md_search *s,
                                                                       const uint32_t *cell)
{
  for (uint32_t k = 1; k <= cell[0]; k++) {
    if (s->n_candidates == GG_MD_MOST_CANDIDATES) {
      gg_md_try_candidates(e, s);
      s->n_candidates = 0;
    }
    s->candidates[s->n_candidates++] = cell[k];
  }
}

GG_INLINE void gg_md_take_members(const gg_md *e, gg_md_search *s, const gg_md_members *in)
{
  const uint32_t *cell = e->cells.cell;
  size_t stride = e->cells.stride;
  if (__builtin_expect(!gg_md_has_room(e, 8), 0)) {
    for (uint32_t which = in->which; which; which &= which - 1)
      gg_md_take_crowded(e, s, cell + in->index[__builtin_ctz(which)] * stride);
    return;
  }
  uint32_t *end = s->candidates + s->n_candidates;
  for (uint32_t which = in->which; which; which &= which - 1)
    end = gg_md_append_large(end, cell + in->index[__builtin_ctz(which)] * stride);
  s->n_candidates = (uint32_t)(end - s->candidates);
}

/* Axis of the step of a grain that will enter another cell, and the cell from which the step is counted. False: unknown
 * in advance. Each of the two searches defines it. */
GG_INLINE bool gg_md_step_of(const gg_md *e, const gg_md_node *node, int *axis, int32_t at[3]);

/* Prefetch the cell that a grain will enter, or (`members`) the grains in it; of a grain that will collide the partner.
 */
GG_INLINE void gg_md_prefetch_entry(const gg_md *e, uint32_t i, bool members)
{
  const gg_md_node *node = &e->node[i];
  const gg_md_cells *c = &e->cells;
  if (!(node->time < node->collision)) {
    if (GG_MD_NO_GRAIN(node->partner) || members) return;
    __builtin_prefetch(&e->grain[node->partner]);
    __builtin_prefetch(&e->node[node->partner]);
    return;
  }
  int axis = node->face >> 1, up = node->face & 1, both = node->neighbours >> axis & 1;
  int32_t at[3] = {node->cell[0], node->cell[1], node->cell[2]};
  if (!gg_md_step_of(e, node, &axis, at)) return;
  if (!up)
    at[axis]--;
  else
    at[axis] = (both ? gg_md_cell_after(e, axis, at[axis]) : at[axis]) + 1;
  const uint32_t *cell = c->cell + (size_t)(c->part[0][at[0]] + c->part[1][at[1]] + c->part[2][at[2]]) * c->stride;
  if (!members)
    __builtin_prefetch(cell);
  else
    for (uint32_t m = 1; m <= 8; m++) __builtin_prefetch(&e->grain[m <= cell[0] ? cell[m] : i]);
}

GG_INLINE void gg_md_prefetch_due(const gg_md *e, uint32_t i, uint32_t partner)
{
  (void)partner;
  gg_md_prefetch_entry(e, i, false);
}

GG_INLINE void gg_md_prefetch_ahead(const gg_md *e, uint32_t i)
{
  gg_md_prefetch_entry(e, i, true);
}

GG_INLINE void gg_md_shift_all(gg_md *e)
{
  (void)e; /* overlapping rows are independent of each other */
}

#endif
