/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Co-moving rows of cells (row_motion.c, search/comoving_rows.h): how few cells they may have, and their numbers. */
#ifndef GG_MD_ROWS_H
#define GG_MD_ROWS_H

#include "md/md_state.h"

/* Fewest cells along x, of which the nearest image of all that a cell sees is the one that is tried. */
enum { GG_MD_FEWEST_COMOVING = 7 };

/* Index of a cell, up to n cells off. */
GG_INLINE int32_t gg_md_index_in_row(const gg_md *e, int32_t x)
{
  int32_t n = e->cells.n[0];
  return x < 0 ? x + n : x >= n ? x - n : x;
}

#endif
