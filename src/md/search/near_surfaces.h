/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prediction of contacts with the surfaces of the model. */
#ifndef GG_MD_SEARCH_NEAR_SURFACES_H
#define GG_MD_SEARCH_NEAR_SURFACES_H

#include "common/surface/shapes.h"
#include "md/grid.h"
#include "md/search/search.h"

/* Test the surfaces near the cell of the grain: the earliest contact replaces a later partner. A grain in the middle of
 * the box reads only one byte. Planes are tested inline, other shapes by a call. */
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
