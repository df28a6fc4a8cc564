/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells: a grid over the box, no edge below the largest contact distance, so that a grain can only touch grains of its
 * own and the 26 cells around (32 where rows of cells move with the flow, search/comoving_rows.h). The grains of a cell
 * stand side by side in memory. A grain's cell is a matter of its crossings, not of its rounded coordinates: it changes
 * only by crossing events.
 *
 * Small cells have four words, a fourth of a cache line: where cells are one contact distance wide, fewer than 1 in
 * 10^4 have four grains of equal size. The third grain then leads to the fourth, that one to the fifth, up to the
 * seventh: the cell's overflow list (small_cells.c). */
#ifndef GG_MD_CELL_GRID_H
#define GG_MD_CELL_GRID_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "md/box.h"
#include "simd/words.h"

enum { GG_MD_SMALL_CELL = 4, GG_MD_SIDE_BY_SIDE = 3, GG_MD_MOST_IN_SMALL = 7 };

typedef struct gg_md_cells {
  int32_t n[3];
  double width[3], inverse[3];
  double reach;      /* largest contact distance (of lists: largest distance of centres) */
  uint32_t stride;   /* a multiple of 8; 4: small cells */
  bool fixed;        /* others are at work in them: they do not grow */
  uint32_t *part[3]; /* an index -2 .. n + 1 along an axis: its share of the cell's number, wrapped */
  uint32_t *cell;    /* stride words a cell, x fastest: how many grains, then who; readable beyond the last */
  uint32_t *next;    /* of small cells: whom a grain leads to in an overflow list; NULL: they are not small */
} gg_md_cells;

/* A grid of n[] cells on the box, empty. */
gg_status gg_md_cells_make(gg_md_cells *cells, const gg_md_box *box, const int32_t n[3], double reach, gg_error *err);
/* Of small cells, for so many grains. */
gg_status gg_md_cells_make_small(gg_md_cells *cells, const gg_md_box *box, const int32_t n[3], double reach,
                                 uint32_t grains, gg_error *err);
void gg_md_cells_free(gg_md_cells *cells);
void gg_md_cells_clear(gg_md_cells *cells);
/* As many cells as fit with edges of at least `width`. */
void gg_md_cells_count(const gg_md_box *box, double width, int32_t n[3]);
/* The cell that a place in the box lies in. */
void gg_md_cell_of(const gg_md_cells *cells, gg_vec r, int32_t cell[3]);
/* Twice the room in every cell; false if there is no memory for it. */
bool gg_md_cells_grow(gg_md_cells *cells);

/* small_cells.c: a grain into a cell that has no room side by side; false: nor in an overflow list. And any grain out
 * of a cell that has such a list. */
bool gg_md_cell_overflow(const gg_md_cells *cells, uint32_t *cell, uint32_t grain);
void gg_md_cell_remove_overfull(const gg_md_cells *cells, uint32_t *cell, uint32_t grain);
/* All grains of a small cell; returns how many. */
uint32_t gg_md_small_cell_list(const gg_md_cells *cells, const uint32_t *cell, uint32_t *who);

/* An index of n; the last one where rounding leads to n, or what is no number anywhere else. */
GG_INLINE int32_t gg_md_within(int32_t k, int32_t n)
{
  return (uint32_t)k < (uint32_t)n ? k : n - 1;
}

GG_INLINE size_t gg_md_cell_index(const gg_md_cells *c, const int32_t at[3])
{
  return ((size_t)at[2] * (size_t)c->n[1] + (size_t)at[1]) * (size_t)c->n[0] + (size_t)at[0];
}

GG_INLINE uint32_t *gg_md_cell_at(const gg_md_cells *c, const int32_t at[3])
{
  return c->cell + gg_md_cell_index(c, at) * c->stride;
}

/* False if the cell is full. */
GG_INLINE bool gg_md_cell_put(const gg_md_cells *c, uint32_t *cell, uint32_t grain)
{
  if (__builtin_expect(cell[0] + 1 >= c->stride, 0)) return gg_md_cell_overflow(c, cell, grain);
  cell[++cell[0]] = grain;
  return true;
}

GG_INLINE bool gg_md_cell_add(const gg_md_cells *c, const int32_t at[3], uint32_t grain)
{
  return gg_md_cell_put(c, gg_md_cell_at(c, at), grain);
}

/* Who is in a cell; `found`: room for an overflow list. */
GG_INLINE const uint32_t *gg_md_cell_members(const gg_md_cells *c, const uint32_t *cell,
                                             uint32_t found[GG_MD_MOST_IN_SMALL])
{
  if (!c->next || cell[0] <= GG_MD_SIDE_BY_SIDE) return cell + 1;
  gg_md_small_cell_list(c, cell, found);
  return found;
}

/* Where a grain stands in a cell that it is in. What stands behind a cell's end may be anybody: the first place found
 * is the one. */
GG_INLINE uint32_t gg_md_cell_find(const uint32_t *cell, uint32_t grain)
{
  uint32_t found = gg_words_equal16(cell, grain) & ~1u, base = 0;
  while (!found) found = gg_words_equal16(cell + (base += 16), grain);
  return base + (uint32_t)__builtin_ctz(found);
}

GG_INLINE void gg_md_cell_close_gap(uint32_t *cell, uint32_t at)
{
  cell[at] = cell[cell[0]];
  cell[0]--;
}

/* Of cells that are not small. */
GG_INLINE void gg_md_cell_remove(uint32_t *cell, uint32_t grain)
{
  gg_md_cell_close_gap(cell, gg_md_cell_find(cell, grain)); /* read as a line before a word of it is written */
}

/* Of any. */
GG_INLINE void gg_md_cell_remove_from(const gg_md_cells *c, uint32_t *cell, uint32_t grain)
{
  if (c->stride != GG_MD_SMALL_CELL)
    gg_md_cell_remove(cell, grain);
  else if (__builtin_expect(cell[0] > GG_MD_SIDE_BY_SIDE, 0))
    gg_md_cell_remove_overfull(c, cell, grain);
  else
    gg_md_cell_close_gap(cell, (uint32_t)__builtin_ctz(gg_words_equal4(cell, grain) & ~1u));
}

#endif
