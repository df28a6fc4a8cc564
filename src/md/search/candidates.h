/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Candidates of a search: the grains of the cells around are gathered into one list for the SIMD pair kernel. */
#ifndef GG_MD_SEARCH_CANDIDATES_H
#define GG_MD_SEARCH_CANDIDATES_H

#include <string.h>

#include "md/search/search.h"

/* Append all grains of a cell to n candidates, eight words at a time; words behind the last grain are ignored. Returns
 * the new number. */
GG_INLINE uint32_t gg_md_append_cell(uint32_t *candidates, uint32_t n, const uint32_t *cell)
{
  uint32_t count = cell[0];
  memcpy(candidates + n, cell + 1, 8 * sizeof *cell);
  for (uint32_t k = 8; k < count; k += 8) memcpy(candidates + n + k, cell + 1 + k, 8 * sizeof *cell);
  return n + count;
}

/* Append all grains of a cell of sixteen words or more at the end of a list, line by line: a read across the end of a
 * line would load another line. Returns the new end. */
GG_INLINE uint32_t *gg_md_append_large(uint32_t *end, const uint32_t *cell)
{
  enum { LINE = 16 };
  const uint32_t count = cell[0];
  memcpy(end, cell + 1, (LINE - 1) * sizeof *cell);
  for (uint32_t k = LINE - 1; k < count; k += LINE) memcpy(end + k, cell + 1 + k, LINE * sizeof *cell);
  return end + count;
}

/* Size of cells, a constant in each copy of a search. Small cells are first read as if none had an overflow list; if
 * one has, all are read again as overfull cells. */
typedef enum gg_md_cell_size {
  GG_MD_SMALL_CELLS,
  GG_MD_OVERFULL_CELLS,
  GG_MD_EIGHT_WORDS,
  GG_MD_LARGE_CELLS
} gg_md_cell_size;

/* Candidates gathered so far. `counts`: bitwise OR of the counts of small cells. */
typedef struct gg_md_gathered {
  uint32_t *candidates, n, counts;
} gg_md_gathered;

GG_INLINE void gg_md_gather_cell(gg_md_gathered *g, const gg_md_cells *c, const uint32_t *cell, gg_md_cell_size size)
{
  uint32_t *to = g->candidates + g->n;
  if (size == GG_MD_SMALL_CELLS) {
    memcpy(to, cell + 1, GG_MD_SMALL_CELL * sizeof *cell);
    g->counts |= cell[0];
    g->n += cell[0];
  } else if (size == GG_MD_OVERFULL_CELLS) {
    g->n += gg_md_small_cell_list(c, cell, to);
  } else if (size == GG_MD_EIGHT_WORDS) {
    memcpy(to, cell + 1, 8 * sizeof *cell);
    g->n += cell[0];
  } else {
    g->n = gg_md_append_cell(g->candidates, g->n, cell);
  }
}

/* Store the gathered candidates in the search. False: a small cell has an overflow list. */
GG_INLINE bool gg_md_keep_gathered(gg_md_search *s, const gg_md_gathered *g)
{
  if (__builtin_expect(g->counts > GG_MD_SIDE_BY_SIDE, 0)) return false;
  s->n_candidates = g->n;
  return true;
}

/* True if there is room for the grains of so many full cells. */
GG_INLINE bool gg_md_has_room(const gg_md *e, int cells)
{
  return __builtin_expect((uint32_t)cells * e->cells.stride <= GG_MD_MOST_CANDIDATES, 1);
}

/* Append the grains of a cell to the search. False: no room. */
GG_INLINE bool gg_md_take_cell(gg_md_search *s, const uint32_t *cell)
{
  if (s->n_candidates + cell[0] > GG_MD_MOST_CANDIDATES) return false;
  s->n_candidates = gg_md_append_cell(s->candidates, s->n_candidates, cell);
  return true;
}

/* Wrapped index of a neighbouring cell along one axis, and the shift of its image. */
GG_INLINE int32_t gg_md_image_cell(const gg_md *e, int axis, int32_t k, double *shift)
{
  *shift = 0;
  if (k < 0) {
    *shift = -e->box.edge[axis];
    return k + e->cells.n[axis];
  }
  if (k >= e->cells.n[axis]) {
    *shift = e->box.edge[axis];
    return k - e->cells.n[axis];
  }
  return k;
}

#endif
