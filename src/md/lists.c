/* All lists anew: the searches of search/list_update.h for any boundary and mixture. */
#include "md/search/list_update.h"

/* Lists from cells that are there, all shells being new. False: some list is too long. */
static bool fill_lists(gg_md *e)
{
  uint32_t found[GG_FOUND];
  for (uint32_t i = 0; i < e->n; i++) {
    uint32_t count = gg_search_shell(e, i, found), *list = gg_list(e, i);
    if (count > GG_LIST) return false;
    gg_list_clear(e, i);
    for (uint32_t k = 0; k < count; k++) list[k] = found[k];
    e->node[i].neighbours = count;
  }
  return true;
}

void gg_md_set_shells(gg_md *e, double radius)
{
  const gg_model *m = &e->model;
  e->shell_radius = radius;
  e->pair_reach[0] = m->sigma[0] + 2 * radius;
  e->pair_reach[1] = m->sigma[1] + 2 * radius;
  e->pair_reach[2] = m->sigma[3] + 2 * radius;
  e->shrinkage = 0.25 * m->shear_rate * (gg_md_reach(m) + 2 * radius) * (1 + 1e-9);
}

void gg_md_build_lists(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) gg_new_shell(e, i);
  gg_md_fill_grid(e);
  while (!fill_lists(e)) gg_md_set_shells(e, 0.95 * e->shell_radius);
}
