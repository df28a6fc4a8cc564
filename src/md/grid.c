/* The grid of cells, and what goes with the kind of search. */
#include "base/memory.h"
#include "md/md_state.h"

gg_status gg_md_make_lists(gg_md *e, double radius, gg_error *err)
{
  int32_t n[3];
  if (!gg_md_fit_lists(&e->model, radius, n)) return GG_OK;
  /* Such cells hold four or five grains on average: room for fifteen at once, before the lists take theirs. */
  GG_TRY(gg_md_cells_make(&e->cells, &e->box, n, gg_md_reach(&e->model) + 2 * radius, err));
  if (!gg_md_cells_grow(&e->cells)) return gg_base_out_of_memory_for(err, "the grid of cells");
  GG_TRY(gg_md_allocate_lists(e, err));
  gg_md_set_skins(e, radius);
  return GG_OK;
}

gg_status gg_md_make_grid(gg_md *e, gg_error *err)
{
  double radius;
  int32_t n[3];
  const gg_md_search_kind kind = gg_md_search_select(&e->model, &radius, n);
  if (kind == GG_MD_NEIGHBOUR_LISTS) return gg_md_make_lists(e, radius, err);
  e->search.kind = kind;
  GG_TRY(gg_md_cells_make(&e->cells, &e->box, n, gg_md_reach(&e->model), err));
  GG_TRY(gg_md_note_surfaces(e, err));
  if (!gg_md_search_has_rows(kind)) return GG_OK;
  GG_TRY(gg_md_make_rows(e, err));
  gg_md_align_rows(e);
  return GG_OK;
}
