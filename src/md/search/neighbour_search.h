/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interface of the neighbour searches: plain cells, cells in rows that move with the flow, overlapping cells,
 * overlapping cells in rows, neighbour lists. Each has a header, of which an instance of the event loop includes one
 * (features.h). It defines the functions declared here, and the constants
 *
 *   ROWS_SHIFT     rows shift, and all grains search at once (gg_md_shift_all)
 *   ROWS_MOVE      moving rows may separate images along x by several edges
 *   KNOWS_IMAGES   a search knows whether all candidates are in the grain's own image of the box
 *   FEW_MEET       few candidates approach: a batch is first tested for any contact
 *   HAS_COPIES     a candidate may be listed several times
 *   CACHED         up to so many grains are in the cache: nothing is prefetched
 *   SMALL_CELLS    cells may be small (cell_grid.h)
 *   PREDICTS_IN_PLACE   a stale event is re-predicted inline, not by a call (faster by 1 to 3 % in some searches) */
#ifndef GG_MD_NEIGHBOUR_SEARCH_H
#define GG_MD_NEIGHBOUR_SEARCH_H

#include "md/search/search.h"

/* Search all grains that the grain can touch from its present cell. */
GG_INLINE void gg_md_search_all(gg_md *e, gg_md_search *s);
/* Time at which it enters another cell or leaves its skin; *face: where. */
GG_INLINE double gg_md_next_crossing(const gg_md *e, const gg_md_search *s, int32_t *face);
/* Process the crossing that is due now. */
GG_INLINE void gg_md_cross(gg_md *e, uint32_t i);
/* Shift rows by a cell: every grain searches the cells that come within reach. */
GG_INLINE void gg_md_shift_all(gg_md *e);

/* Prefetch the data of an event of a new bucket, beside the grain. `partner`: of its predicted collision, or none. */
GG_INLINE void gg_md_prefetch_due(const gg_md *e, uint32_t i, uint32_t partner);
/* Prefetch the data of the next event but one: in systems that the cache holds, and in larger ones. */
GG_INLINE void gg_md_prefetch_cached(const gg_md *e, uint32_t i);
GG_INLINE void gg_md_prefetch_ahead(const gg_md *e, uint32_t i);

/* event_loop.h: insert the result of a search into the event queue. `is_next`, a constant: the grain is that of the
 * event in progress. */
GG_INLINE void gg_md_schedule(gg_md *e, gg_md_search *s, bool is_next);
/* Search from scratch, and insert the result. */
static void gg_md_predict(gg_md *e, uint32_t i);

/* End the run if a cell could not grow. */
GG_INLINE void gg_md_check_memory(gg_md *e, bool good)
{
  if (good) return;
  e->out_of_memory = true;
  e->k.collisions_left = 0;
}

/* True if the velocity after a contact is finite. NaN never recovers: the run ends. */
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
