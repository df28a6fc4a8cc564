#include "measure/cell_grid.h"

#include <math.h>

enum { GRAINS_PER_CELL = 8, LEAST_CELLS = 3 };

gg_cell_grid gg_measure_cell_grid_of(const gg_model *m)
{
  gg_cell_grid g;
  double edge = cbrt(GRAINS_PER_CELL * m->volume / (double)m->n);
  for (int a = 0; a < 3; a++) {
    g.box[a] = m->box[a];
    g.n[a] = (int)fmax(LEAST_CELLS, round(m->box[a] / edge));
  }
  return g;
}

size_t gg_measure_cell_grid_cells(const gg_cell_grid *g)
{
  return (size_t)g->n[0] * (size_t)g->n[1] * (size_t)g->n[2];
}

size_t gg_measure_cell_grid_cell(const gg_cell_grid *g, const gg_snapshot *s, size_t i)
{
  int at[3];
  for (int a = 0; a < 3; a++) {
    at[a] = (int)(s->r[a][i] / g->box[a] * g->n[a]);
    at[a] = at[a] < 0 ? 0 : at[a] >= g->n[a] ? g->n[a] - 1 : at[a];
  }
  return (size_t)((at[2] * g->n[1] + at[1]) * g->n[0] + at[0]);
}
