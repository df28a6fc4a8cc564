/* Walls across y: when does a grain touch one? */
#ifndef GG_MD_SEARCH_WALLS_H
#define GG_MD_SEARCH_WALLS_H

#include "md/search/search.h"

/* A wall that the grain meets before anything else so far. Only grains in the cells along a wall can touch it. */
GG_INLINE void gg_md_try_walls(const gg_md *e, gg_md_search *s)
{
  const gg_md_grain *g = s->self;
  int32_t y = e->node[s->grain].cell[1];
  double radius = 0.5 * e->model.diameter[IS_MIXTURE ? gg_md_species_of(g) : 0];
  double lower = INFINITY, upper = INFINITY, fall = HAS_GRAVITY ? e->gravity.y : 0;
  if (y == 0) lower = e->k.now + gg_md_fall_delay(g->r.y - radius, -g->v.y, -fall);
  if (y == e->cells.n[1] - 1 && !e->model.open_top)
    upper = e->k.now + gg_md_fall_delay(e->box.edge[1] - radius - g->r.y, g->v.y, fall);
  if (lower < s->collision) s->collision = lower, s->partner = GG_MD_LOWER_WALL;
  if (upper < s->collision) s->collision = upper, s->partner = GG_MD_UPPER_WALL;
}

#endif
