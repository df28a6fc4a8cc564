/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Overflow lists of small cells: next[third] is the fourth grain, and so on; the number of grains in the cell defines
 * the end. A change of a cell changes its own list only, so threads share no more than the cells. */
#include "md/cell_grid.h"

bool gg_md_cell_overflow(const gg_md_cells *c, uint32_t *cell, uint32_t grain)
{
  if (!c->next || cell[0] == GG_MD_MOST_IN_SMALL) return false;
  uint32_t *fourth = &c->next[cell[GG_MD_SIDE_BY_SIDE]];
  c->next[grain] = *fourth; /* unused if the grain is the first of the list */
  *fourth = grain;
  cell[0]++;
  return true;
}

/* The third grain replaces one of the first two; the grains behind a removed one move up. */
void gg_md_cell_remove_overfull(const gg_md_cells *c, uint32_t *cell, uint32_t grain)
{
  uint32_t *place = &cell[GG_MD_SIDE_BY_SIDE];
  if (cell[1] == grain || cell[2] == grain)
    cell[cell[1] == grain ? 1 : 2] = *place;
  else
    while (*place != grain) place = &c->next[*place];
  *place = c->next[*place];
  cell[0]--;
}

uint32_t gg_md_small_cell_list(const gg_md_cells *c, const uint32_t *cell, uint32_t *who)
{
  const uint32_t *place = cell;
  for (uint32_t k = 0; k < cell[0]; k++) {
    place = k < GG_MD_SIDE_BY_SIDE ? place + 1 : &c->next[*place];
    who[k] = *place;
  }
  return cell[0];
}
