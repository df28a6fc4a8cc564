/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces near each cell, and contacts with surfaces that are no planes. */
#include <stdlib.h>

#include "base/memory.h"
#include "common/surface/shapes.h"
#include "md/grid.h"

/* Distance from its cell that a grain can have before its next crossing: in its skin, or in the next overlapping cell.
 */
static void get_beyond(const gg_md *e, int axis, double *below, double *above)
{
  *below = *above = e->search.kind == GG_MD_NEIGHBOUR_LISTS ? e->search.lists.radius * (1 + 1e-9) : 0;
  if (gg_md_search_overlaps(e->search.kind)) *above = e->cells.width[axis];
}

/* Mark the cells from which a centre can touch surface w: a layer from the place of the surface into the gas. */
static void mark_cells_near(gg_md *e, int w, double radius)
{
  const gg_surface *s = &e->model.surface[w];
  const gg_md_cells *c = &e->cells;
  double depth = (gg_surface_height(s) + radius) * (1 + 1e-9), edge[2] = {s->place, s->place - s->side * depth};
  double from = fmin(edge[0], edge[1]), to = fmax(edge[0], edge[1]);
  for (int a = 0; a < 3; a++) {
    double below, above;
    get_beyond(e, a, &below, &above);
    for (int32_t k = 0; k < c->n[a]; k++) {
      bool beyond = a == s->axis && (from > (k + 1) * c->width[a] + above || to < k * c->width[a] - below);
      if (!beyond) e->search.near[a][k] |= (uint8_t)(1 << w);
    }
  }
}

gg_status gg_md_find_near_surfaces(gg_md *e, gg_error *err)
{
  const gg_model *m = &e->model;
  double widest = 0;
  if (m->n_surfaces == 0) return GG_OK;
  for (int i = 0; i < m->n_species; i++) widest = fmax(widest, m->diameter[i]);
  for (int a = 0; a < 3; a++)
    if (!(e->search.near[a] = gg_base_array_new((size_t)e->cells.n[a], sizeof *e->search.near[a], err)))
      return GG_FAILED;
  for (int w = 0; w < m->n_surfaces; w++) mark_cells_near(e, w, 0.5 * widest);
  return GG_OK;
}

double gg_md_shaped_delay(const gg_md *e, const gg_surface *surface, const gg_flight *flight, const int32_t *cell)
{
  gg_region where;
  for (int a = 0; a < 3; a++) {
    where.from[a] = cell[a] * e->cells.width[a];
    where.to[a] = where.from[a] + e->cells.width[a];
  }
  return gg_surface_delay(surface, flight, &where);
}
