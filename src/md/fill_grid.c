/* The cells that grains lie in, and the cells filled with them. */
#include "md/members_in_rows.h"

void gg_md_enter_grid(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++)
    if (e->overlapping && e->row)
      gg_md_members_in_rows_place(e, e->grain[i].r, &e->node[i]);
    else if (e->overlapping)
      gg_md_members_place(e, e->grain[i].r, &e->node[i]);
    else
      gg_md_cell_of(&e->cells, e->skin ? e->skin[i].centre : e->grain[i].r, e->node[i].cell);
  for (uint32_t i = 0; e->row && !e->overlapping && i < e->n; i++)
    e->node[i].cell[0] = gg_md_cell_in_row(e, e->node[i].cell[1], e->grain[i].r.x);
}

bool gg_md_fill_grid(gg_md *e)
{
  gg_md_cells_clear(&e->cells);
  for (uint32_t i = 0; e->overlapping && i < e->n; i++) {
    gg_md_members in;
    if (e->row)
      gg_md_members_in_rows_of(e, &e->node[i], &in);
    else
      gg_md_members_of(e, &e->node[i], &in);
    if (!gg_md_members_enter(e, i, &in)) return false;
  }
  if (e->overlapping) return true;
  for (uint32_t i = 0; i < e->n; i++)
    while (!gg_md_cell_add(&e->cells, e->node[i].cell, i))
      if (!gg_md_cells_grow(&e->cells)) return false;
  return true;
}
