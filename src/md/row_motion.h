/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Co-moving rows of cells (search/comoving_rows.h, overlapping_members.h): their positions and their motion. */
#ifndef GG_MD_ROW_MOTION_H
#define GG_MD_ROW_MOTION_H

#include "md/md_state.h"

/* Fewest cells along x for which the nearest image of every grain in the searched cells is the image that is tried. */
enum { GG_MD_FEWEST_COMOVING = 7 };

/* Allocate the rows and place them by e->k. */
gg_status gg_md_make_rows(gg_md *e, gg_error *err);
/* Place the rows by the offset of the images at the start of the epoch. */
void gg_md_align_rows(gg_md *e);
/* Free rows of a flow at rest begin at different places. If they began at one, a grain in two rows would enter cells of
 * both at one time, and rounding could take it back out of one as it enters the other, for ever. */
void gg_md_separate_rows(gg_md *e);
/* Place the rows at the start of the next epoch, `span` later. */
void gg_md_move_rows(gg_md *e, double span);
/* Place the rows after they have shifted by a cell, forwards (1) or, in reversed shear, backwards (-1). */
void gg_md_shift_rows_by_a_cell(gg_md *e, int step);
/* Cell along x of row y that holds the position x now. */
int32_t gg_md_cell_in_row(const gg_md *e, int32_t y, double x);

/* Position at which cell 0 of row y begins now. */
GG_INLINE double gg_md_row_begins(const gg_md *e, int32_t y)
{
  return e->search.rows.row[y].origin + e->search.rows.row[y].speed * e->k.now;
}

/* Wrap the index of a cell along x that is up to n cells outside. */
GG_INLINE int32_t gg_md_index_in_row(const gg_md *e, int32_t x)
{
  int32_t n = e->cells.n[0];
  return x < 0 ? x + n : x >= n ? x - n : x;
}

#endif
