/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells: a grid over the box, no edge below the largest contact distance, so that a grain can only touch grains of its
 * own and the 26 cells around (32 where rows of cells move with the flow, search/comoving_rows.h). The grains of a cell
 * stand side by side in memory. A grain's cell is a matter of its crossings, not of its rounded coordinates: it changes
 * only by crossing events. */
#ifndef GG_MD_CELLS_H
#define GG_MD_CELLS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "md/box.h"
#include "simd/words.h"

typedef struct gg_md_cells {
  int32_t n[3];
  double width[3], inverse[3];
  double reach;      /* largest contact distance (of lists: largest distance of centres) */
  uint32_t stride;   /* a multiple of 8 */
  bool fixed;        /* others are at work in them: they do not grow */
  uint32_t *part[3]; /* an index -2 .. n + 1 along an axis: its share of the cell's number, wrapped */
  uint32_t
      *cell; /* stride words a cell, x fastest: how many grains, then who; readable beyond the last (cell_frame.c) */
} gg_md_cells;

/* A grid of n[] cells on the box, empty. */
gg_status gg_md_cells_make(gg_md_cells *cells, const gg_md_box *box, const int32_t n[3], double reach, gg_error *err);
void gg_md_cells_free(gg_md_cells *cells);
void gg_md_cells_clear(gg_md_cells *cells);
/* As many cells as fit with edges of at least `width`. */
void gg_md_cells_count(const gg_md_box *box, double width, int32_t n[3]);
/* The cell that a place in the box lies in. */
void gg_md_cell_of(const gg_md_cells *cells, gg_vec r, int32_t cell[3]);
/* Twice the room in every cell; false if there is no memory for it. */
bool gg_md_cells_grow(gg_md_cells *cells);

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
GG_INLINE bool gg_md_cell_add(const gg_md_cells *c, const int32_t at[3], uint32_t grain)
{
  uint32_t *cell = gg_md_cell_at(c, at);
  if (cell[0] + 1 == c->stride) return false;
  cell[++cell[0]] = grain;
  return true;
}

/* Where a grain stands in a cell that it is in. What stands behind a cell's end may be anybody: the first place found
 * is the one. */
GG_INLINE uint32_t gg_md_cell_find(const uint32_t *cell, uint32_t grain)
{
  uint32_t found = gg_words_equal16(cell, grain) & ~1u, base = 0;
  while (!found) found = gg_words_equal16(cell + (base += 16), grain);
  return base + (uint32_t)__builtin_ctz(found);
}

GG_INLINE void gg_md_cell_remove(uint32_t *cell, uint32_t grain)
{
  uint32_t at = gg_md_cell_find(cell, grain); /* read as a line before a word of it is written */
  cell[at] = cell[cell[0]];
  cell[0]--;
}

#endif
