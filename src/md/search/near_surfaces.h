/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The surfaces of the model: when does a grain touch one? */
#ifndef GG_MD_SEARCH_NEAR_SURFACES_H
#define GG_MD_SEARCH_NEAR_SURFACES_H

#include "common/surface/shapes.h"
#include "md/grid.h"
#include "md/search/search.h"

/* A surface that the grain meets before anything else so far. Only those within reach of its cell are tried, so grains
 * in the middle of the box look up one byte. Planes are tried in place, other shapes by a call. */
GG_INLINE void gg_md_try_surfaces(const gg_md *e, gg_md_search *s)
{
  const int32_t *cell = e->node[s->grain].cell;
  uint32_t near = e->search.near[1][cell[1]];
  if (near == 0) return;
  const gg_md_grain *g = s->self;
  const gg_vec none = {0, 0, 0};
  const gg_flight flight = {&g->r, &g->v, HAS_GRAVITY ? &e->gravity : &none,
                            0.5 * e->model.diameter[IS_MIXTURE ? gg_md_species_of(g) : 0]};
  for (near &= e->search.near[0][cell[0]] & e->search.near[2][cell[2]]; near; near &= near - 1) {
    int w = __builtin_ctz(near);
    const gg_surface *surface = &e->model.surface[w];
    double t = e->k.now + (surface->shape == GG_SHAPE_plane ? gg_plane_delay(surface, &flight, NULL)
                                                            : gg_md_shaped_delay(e, surface, &flight, cell));
    if (t < s->collision) s->collision = t, s->partner = GG_MD_SURFACE(w);
  }
}

#endif
