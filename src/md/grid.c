/* The grid that suits a model, and the grains' places in it. */
#include <math.h>
#include <stdlib.h>

#include "md/shared.h"

/* Below, cells that overlap are faster. */
#define MOST_DILUTE 0.05

/* Dilute, a cell holds this many grains: fewer crossings against more pairs to try. */
#define GRAINS_PER_CELL 0.7

double gg_md_reach(const gg_model *m)
{
  double widest = fmax(m->sigma[0], m->n_species > 1 ? m->sigma[3] : 0);
  return widest * (1 + 1e-9);
}

/* Neighbour lists or cells, and how wide the shells: the least time per collision as measured for elastic grains over
 * phi. Wide shells are left seldom, but make long lists; below phi = 0.4 mending lists costs more than they save. Lists
 * of grains of very unequal size would be too long. */
static double shell_radius(const gg_model *m)
{
  double ratio = m->n_species > 1 ? fmax(m->diameter[0], m->diameter[1]) / fmin(m->diameter[0], m->diameter[1]) : 1;
  if (m->walled || m->phi < 0.4 || ratio > 1.3) return 0;
  return fmin(0.34, 0.3 + 0.8 * (0.5 - m->phi));
}

/* Cells for shells' centres: only in boxes of at least three cells, no nearest image in doubt, no walls. */
gg_status gg_md_make_lists(gg_md *e, double radius, gg_error *err)
{
  double reach = gg_md_reach(&e->model) + 2 * radius;
  int32_t n[3];
  gg_cells_count(&e->box, reach, n);
  for (int a = 0; a < 3; a++)
    if (n[a] < 3 || e->box.edge[a] < 2 * reach + 4 * radius) return GG_OK;
  GG_TRY(gg_md_allocate_lists(e, err));
  gg_md_set_shells(e, radius);
  return gg_cells_make(&e->cells, &e->box, n, reach, err);
}

/* Dilute, wide cells that overlap are crossed half as often, and a crossing looks at one or two. Pairs in a cell, and
 * under shear those in a window of five along x, must have one nearest image. */
#define GRAINS_PER_SHARED_CELL 4.0

gg_status gg_md_make_shared(gg_md *e, gg_error *err)
{
  double reach = gg_md_reach(&e->model), volume = e->model.volume / (double)e->model.n;
  double per = getenv("GPC") ? atof(getenv("GPC")) : GRAINS_PER_SHARED_CELL;
  double width = fmax(3 * reach, cbrt(per * volume));
  int32_t n[3];
  gg_cells_count(&e->box, width, n);
  for (int a = 0; a < 3; a++) {
    int32_t least = e->box.slide != 0 && a == 0 ? 14 : 6;
    if (n[a] < least) n[a] = least;
    if (e->box.edge[a] < 3 * reach * n[a]) return GG_OK;
  }
  e->shared = true;
  return gg_cells_make(&e->cells, &e->box, n, reach, err);
}

gg_status gg_md_make_grid(gg_md *e, gg_error *err)
{
  double radius = shell_radius(&e->model);
  if (radius > 0) GG_TRY(gg_md_make_lists(e, radius, err));
  if (e->shell) return GG_OK;
  if (e->model.phi < MOST_DILUTE && !e->model.walled) GG_TRY(gg_md_make_shared(e, err));
  if (e->shared) return GG_OK;
  double reach = gg_md_reach(&e->model);
  double width = fmax(reach, cbrt(GRAINS_PER_CELL * e->model.volume / (double)e->model.n));
  int32_t n[3];
  gg_cells_count(&e->box, width, n);
  return gg_cells_make(&e->cells, &e->box, n, reach, err);
}

void gg_md_cell_of(const gg_cells *c, gg_vec r, int32_t cell[3])
{
  for (int a = 0; a < 3; a++) {
    int32_t k = (int32_t)(gg_along(&r, a) * c->inverse[a]);
    cell[a] = k < c->n[a] ? k : c->n[a] - 1;
  }
}

void gg_md_enter_grid(gg_md *e)
{
  gg_features f = {.sheared = e->box.slide != 0};
  for (uint32_t i = 0; i < e->n; i++)
    if (e->shared)
      gg_shared_place(e, f, e->grain[i].r, &e->node[i]);
    else
      gg_md_cell_of(&e->cells, e->shell ? e->shell[i].centre : e->grain[i].r, e->node[i].cell);
}

bool gg_md_fill_grid(gg_md *e)
{
  gg_cells_clear(&e->cells);
  for (uint32_t i = 0; e->shared && i < e->n; i++)
    if (!gg_shared_enter(e, i, -1, 0)) return false;
  if (e->shared) return true;
  for (uint32_t i = 0; i < e->n; i++)
    while (!gg_cell_add(&e->cells, e->node[i].cell, i))
      if (!gg_cells_grow(&e->cells)) return false;
  return true;
}
