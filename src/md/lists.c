/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All lists anew: the searches of search/list_update.h for any boundary and mixture. */
#include "md/search/list_update.h"

/* Lists of some grains from cells that are there, all skins being new. False: some list is too long. */
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
  for (uint32_t from = 0; from < e->n;) {
    if (stop && gg_stop_asked(stop)) return false;
    const uint32_t to = e->n - from > GG_MD_GRAINS_BETWEEN_LOOKS ? from + GG_MD_GRAINS_BETWEEN_LOOKS : e->n;
    const bool fit = fill_lists(e, from, to);
    if (!fit) gg_md_set_skins(e, 0.95 * e->search.lists.radius);
    from = fit ? to : 0;
  }
  return true;
}
