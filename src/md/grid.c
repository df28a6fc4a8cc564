/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grid of cells, and the data of a search beside it. */
#include "md/grid.h"

#include "base/memory.h"
#include "md/md_allocate.h"
#include "md/overlapping_members.h"
#include "md/row_motion.h"
#include "md/select_search.h"
#include "md/start/all_grains.h"

void gg_md_set_skins(gg_md *e, double radius)
{
  const gg_model *m = &e->model;
  e->search.lists.radius = radius;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++)
      e->search.lists.reach[gg_md_pair(&e->contacts, i, j)] = m->sigma[gg_pair(i, j)] + 2 * radius;
  e->search.lists.shrinkage = 0.25 * fabs(m->shear_rate) * (gg_md_reach(m) + 2 * radius) * (1 + 1e-9);
}

gg_status gg_md_make_lists(gg_md *e, double radius, gg_error *err)
{
  int32_t n[3];
  if (!gg_md_fit_lists(&e->model, radius, n)) return GG_OK;
  /* These cells hold four or five grains on average: make room for fifteen before memory of the lists is allocated. */
  GG_TRY(gg_md_cells_make(&e->cells, &e->box, n, gg_md_reach(&e->model) + 2 * radius, err));
  if (!gg_md_cells_grow(&e->cells)) return gg_base_out_of_memory_for(err, "the grid of cells");
  GG_TRY(gg_md_poll_stop(e, err)); /* clearing a gigabyte of memory takes a while */
  GG_TRY(gg_md_allocate_lists(e, err));
  gg_md_set_skins(e, radius);
  return gg_md_find_near_surfaces(e, err);
}

gg_status gg_md_make_cells(gg_md *e, const int32_t n[3], double reach, gg_error *err)
{
  if (gg_md_has_small_cells(&e->model, e->search.kind))
    return gg_md_cells_make_small(&e->cells, &e->box, n, reach, e->n, err);
  return gg_md_cells_make(&e->cells, &e->box, n, reach, err);
}

gg_status gg_md_make_grid(gg_md *e, gg_error *err)
{
  double radius;
  int32_t n[3];
  const gg_md_search_kind kind = gg_md_search_select(&e->model, &radius, n);
  if (kind == GG_MD_NEIGHBOUR_LISTS) return gg_md_make_lists(e, radius, err);
  e->search.kind = kind;
  GG_TRY(gg_md_make_cells(e, n, gg_md_reach(&e->model), err));
  GG_TRY(gg_md_find_near_surfaces(e, err));
  if (!gg_md_search_has_rows(kind)) return GG_OK;
  GG_TRY(gg_md_make_rows(e, err));
  gg_md_align_rows(e);
  if (e->model.shear_rate == 0) gg_md_separate_rows(e);
  return GG_OK;
}

/* Find the cells of a grain from its position. */
static void enter(gg_md *e, uint32_t i)
{
  const gg_vec r = e->grain[i].r;
  gg_md_node *node = &e->node[i];
  switch (e->search.kind) {
  case GG_MD_OVERLAPPING_ROWS: gg_md_members_in_rows_place(e, r, node); break;
  case GG_MD_OVERLAPPING_CELLS: gg_md_members_place(e, r, node); break;
  case GG_MD_NEIGHBOUR_LISTS: gg_md_cell_of(&e->cells, e->search.lists.skin[i].centre, node->cell); break;
  case GG_MD_COMOVING_ROWS:
    gg_md_cell_of(&e->cells, r, node->cell);
    node->cell[0] = gg_md_cell_in_row(e, node->cell[1], r.x);
    break;
  default: gg_md_cell_of(&e->cells, r, node->cell);
  }
}

void gg_md_enter_grid(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) enter(e, i);
}

static bool fill_overlapping(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_members in;
    if (e->search.kind == GG_MD_OVERLAPPING_ROWS)
      gg_md_members_in_rows_of(e, &e->node[i], &in);
    else
      gg_md_members_of(e, &e->node[i], &in);
    if (!gg_md_members_enter(e, i, &in)) return false;
  }
  return true;
}

bool gg_md_fill_grid(gg_md *e)
{
  gg_md_cells_clear(&e->cells);
  if (gg_md_search_overlaps(e->search.kind)) return fill_overlapping(e);
  for (uint32_t i = 0; i < e->n; i++)
    while (!gg_md_cell_add(&e->cells, e->node[i].cell, i))
      if (!gg_md_cells_grow(&e->cells)) return false;
  return true;
}
