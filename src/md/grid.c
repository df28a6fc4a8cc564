/* The grid that suits a model, and the grains' places in it. */
#include <math.h>
#include <stdlib.h>

#include "md/state.h"

/* Dilute, a cell holds this many grains: fewer crossings against more pairs to try. */
#define GRAINS_PER_CELL 0.5

double gg_md_reach(const gg_model *m)
{
  double widest = fmax(m->sigma[0], m->n_species > 1 ? m->sigma[3] : 0);
  return widest * (1 + 1e-9);
}

/* Shells that leave the fewest nanoseconds a collision: wide ones are left seldom, but make long lists. */
static double shell_radius(const gg_model *m)
{
  const char *s = getenv("SHELL_RADIUS");
  if (s) return atof(s);
  return m->phi > 0.25 ? 0.15 : 0;
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

gg_status gg_md_make_grid(gg_md *e, gg_error *err)
{
  double radius = e->model.walled ? 0 : shell_radius(&e->model);
  if (radius > 0) GG_TRY(gg_md_make_lists(e, radius, err));
  if (e->shell) return GG_OK;
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
  for (uint32_t i = 0; i < e->n; i++)
    gg_md_cell_of(&e->cells, e->shell ? e->shell[i].centre : e->grain[i].r, e->node[i].cell);
}

bool gg_md_fill_grid(gg_md *e)
{
  gg_cells_clear(&e->cells);
  for (uint32_t i = 0; i < e->n; i++)
    while (!gg_cell_add(&e->cells, e->node[i].cell, i))
      if (!gg_cells_grow(&e->cells)) return false;
  return true;
}
