/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rebuild of all neighbour lists, by the searches of search/list_update.h for any boundary and mixture. */
#include "md/grid.h"
#include "md/search/list_update.h"
#include "md/start/all_grains.h"

/* Fill the lists of some grains from the cells, after all skins were renewed. False: a list is too long. */
static bool fill_lists(gg_md *e, uint32_t from, uint32_t to)
{
  uint32_t found[GG_MD_FOUND];
  for (uint32_t i = from; i < to; i++) {
    uint32_t count = gg_md_search_skin(e, i, found), *list = gg_md_list(e, i);
    if (count > GG_MD_LIST) return false;
    gg_md_list_clear(e, i);
    for (uint32_t k = 0; k < count; k++) list[k] = found[k];
    e->node[i].neighbours = count;
  }
  return true;
}

bool gg_md_build_lists(gg_md *e, const gg_stop *stop)
{
  for (uint32_t i = 0; i < e->n; i++) gg_md_new_skin(e, i);
  gg_md_fill_grid(e);
  gg_md_all_grains how;
  while ((how = gg_md_for_all_grains(e, fill_lists, stop)) == GG_MD_GIVEN_UP)
    gg_md_set_skins(e, 0.95 * e->search.lists.radius);
  e->out_of_memory |= how == GG_MD_NO_MEMORY;
  return how == GG_MD_ALL_DONE;
}
