/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grid of cells over the box. No edge of a cell is shorter than the largest contact distance, so a grain can only touch
 * grains of its own cell and of the 26 cells around (32 in rows that move with the flow, search/comoving_rows.h). The
 * grains of a cell are adjacent in memory. The cell of a grain is defined by its crossings, not by its rounded
 * coordinates: it changes only by crossing events.
 *
 * Small cells have four words, a fourth of a cache line: of cells one contact distance wide, fewer than 1 in 10^4 have
 * four grains of equal size. The third grain then links to the fourth, that one to the fifth, up to the seventh: the
 * overflow list of the cell (small_cells.c). */
#ifndef GG_MD_CELL_GRID_H
#define GG_MD_CELL_GRID_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "md/box.h"
#include "simd/words.h"

enum {
  GG_MD_SMALL_CELL = 4,   /* words of a small cell */
  GG_MD_SIDE_BY_SIDE = 3, /* its grains without an overflow list */
  GG_MD_MOST_IN_SMALL = 7 /* its grains with an overflow list */
};

typedef struct gg_md_cells {
  int32_t n[3];
  double width[3], inverse[3];
  double reach;      /* largest contact distance (with lists: largest distance of centres) */
  uint32_t stride;   /* words per cell: a multiple of 8; 4: small cells */
  bool fixed;        /* other threads use the cells: they may not grow */
  uint32_t *part[3]; /* term of the cell index for -2 .. n + 1 along an axis, wrapped */
  uint32_t *cell;    /* x fastest; number of grains, then the grains; readable beyond the last cell */
  uint32_t *next;    /* of small cells: link to the next grain of an overflow list; NULL: not small */
} gg_md_cells;

/* Make a grid of n[] empty cells. */
gg_status gg_md_cells_make(gg_md_cells *cells, const gg_md_box *box, const int32_t n[3], double reach, gg_error *err);
/* The same with small cells, for so many grains. */
gg_status gg_md_cells_make_small(gg_md_cells *cells, const gg_md_box *box, const int32_t n[3], double reach,
                                 uint32_t grains, gg_error *err);
void gg_md_cells_free(gg_md_cells *cells);
void gg_md_cells_clear(gg_md_cells *cells);
/* Count the cells that fit with edges of at least `width`. */
void gg_md_cells_count(const gg_md_box *box, double width, int32_t n[3]);
/* Cell of a position in the box. */
void gg_md_cell_of(const gg_md_cells *cells, gg_vec r, int32_t cell[3]);
/* Double the room of every cell. False: out of memory, or the cells are fixed. */
bool gg_md_cells_grow(gg_md_cells *cells);

/* small_cells.c: put a grain into the overflow list of a full cell. False: no room, or the cell is not small. */
bool gg_md_cell_overflow(const gg_md_cells *cells, uint32_t *cell, uint32_t grain);
/* Remove a grain from a cell with an overflow list. */
void gg_md_cell_remove_overfull(const gg_md_cells *cells, uint32_t *cell, uint32_t grain);
/* List all grains of a small cell. Returns their number. */
uint32_t gg_md_small_cell_list(const gg_md_cells *cells, const uint32_t *cell, uint32_t *who);

/* Clamp an index to 0 .. n - 1: n - 1 if rounding leads to n, or for NaN. */
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

/* Put a grain into a cell. False: the cell is full. */
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

/* Grains of a cell; `found`: room for an overflow list. */
GG_INLINE const uint32_t *gg_md_cell_members(const gg_md_cells *c, const uint32_t *cell,
                                             uint32_t found[GG_MD_MOST_IN_SMALL])
{
  if (!c->next || cell[0] <= GG_MD_SIDE_BY_SIDE) return cell + 1;
  gg_md_small_cell_list(c, cell, found);
  return found;
}

/* Place of a grain in a cell that holds it: the first match, since words behind the last grain may be any grain. */
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

/* Remove a grain from a cell that is not small. */
GG_INLINE void gg_md_cell_remove(uint32_t *cell, uint32_t grain)
{
  gg_md_cell_close_gap(cell, gg_md_cell_find(cell, grain)); /* reads the line before a word of it is written */
}

/* Remove a grain from any cell. */
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
