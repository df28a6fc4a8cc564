/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A kind of neighbour search: plain cells, cells in rows that move with the flow, overlapping cells, overlapping
 * cells in rows, neighbour lists. One header each, of which an instance of the event loop includes one (features.h).
 * Each of them defines the functions declared here, and the constants
 *
 *   ROWS_SHIFT     do rows shift, upon which all grains search at once (gg_md_shift_all)?
 *   ROWS_MOVE      have rows carried images apart along x by several edges, perhaps?
 *   KNOWS_IMAGES   does a search know whether all candidates are in the grain's own image of the box?
 *   FEW_MEET       of those tried: worth a test whether anybody of a batch is in the way at all?
 *   CACHED         so many grains are in the cache anyway: nothing needs to be prefetched
 *   SMALL_CELLS    may cells be small (cell_grid.h)?
 *   PREDICTS_IN_PLACE   is a stale event re-predicted within the loop, or by a call (1 to 3 % either way)? */
#ifndef GG_MD_NEIGHBOUR_SEARCH_H
#define GG_MD_NEIGHBOUR_SEARCH_H

#include "md/search/search.h"

/* All that the grain can meet from where it is. */
GG_INLINE void gg_md_search_all(gg_md *e, gg_md_search *s);
/* When it next comes into another cell, or out of the skin of its list; and node->face: where. */
GG_INLINE double gg_md_next_crossing(const gg_md *e, const gg_md_search *s, int32_t *face);
/* It does so now. */
GG_INLINE void gg_md_cross(gg_md *e, uint32_t i);
/* Rows shift by a cell: everybody searches what comes within reach. */
GG_INLINE void gg_md_shift_all(gg_md *e);

/* What the events of a new bucket will read, beside the grain: `partner` of its predicted collision, or none. */
GG_INLINE void gg_md_prefetch_due(const gg_md *e, uint32_t i, uint32_t partner);
/* What an event two ahead will read: in systems that the cache holds, and in larger ones. */
GG_INLINE void gg_md_prefetch_cached(const gg_md *e, uint32_t i);
GG_INLINE void gg_md_prefetch_ahead(const gg_md *e, uint32_t i);

/* event_loop.h: the search is over, and what it found goes into the event queue; and a search from scratch with that.
 */
GG_INLINE void gg_md_schedule(gg_md *e, gg_md_search *s);
static void gg_md_predict(gg_md *e, uint32_t i);

/* A cell could not grow: the run is over. */
GG_INLINE void gg_md_check_memory(gg_md *e, bool good)
{
  if (good) return;
  e->out_of_memory = true;
  e->k.collisions_left = 0;
}

/* A contact has left this velocity: what is no number has no place in a cell. */
GG_INLINE bool gg_md_is_velocity(gg_md *e, const gg_md_grain *g)
{
  if (__builtin_expect(fabs(g->v.x + g->v.y + g->v.z) < INFINITY, 1)) return true;
  e->no_number = true;
  e->k.collisions_left = 0;
  return false;
}

GG_INLINE void gg_md_leave_cell(gg_md *e, uint32_t i)
{
  uint32_t *cell = gg_md_cell_at(&e->cells, e->node[i].cell);
  if (SMALL_CELLS && !IS_WALLED)
    gg_md_cell_remove_from(&e->cells, cell, i);
  else
    gg_md_cell_remove(cell, i);
}

GG_INLINE void gg_md_enter_cell(gg_md *e, uint32_t i)
{
  while (!gg_md_cell_add(&e->cells, e->node[i].cell, i))
    if (!gg_md_cells_grow(&e->cells)) {
      gg_md_check_memory(e, false);
      return;
    }
}

#endif
