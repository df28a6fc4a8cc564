#include "measure/cell_frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

typedef struct gg_cell_mean {
  double mass, inertia; /* sums of m, I; then what c and omega are the means of under these weights */
  gg_vec c, omega;
} gg_cell_mean;

gg_status gg_measure_cell_frame_init(gg_cell_frame *f, const gg_model *m, gg_error *err)
{
  f->grid = gg_measure_cell_grid_of(m);
  f->mean = gg_base_array_new(gg_measure_cell_grid_cells(&f->grid), sizeof *f->mean, err);
  f->at = f->mean ? gg_base_array_new((size_t)m->n, sizeof *f->at, err) : NULL;
  return f->at ? GG_OK : GG_FAILED;
}

void gg_measure_cell_frame_clear(gg_cell_frame *f)
{
  free(f->mean);
  free(f->at);
}

static gg_vec of_grain(double *const field[3], size_t i)
{
  return (gg_vec){field[0][i], field[1][i], field[2][i]};
}

static gg_vec omega_of(const gg_snapshot *s, size_t i)
{
  return (gg_vec){gg_snapshot_omega(s, 0, i), gg_snapshot_omega(s, 1, i), gg_snapshot_omega(s, 2, i)};
}

static void add(gg_vec *sum, double weight, gg_vec v)
{
  *sum = gg_add(*sum, gg_scale(weight, v));
}

void gg_measure_cell_frame_take(gg_cell_frame *f, const gg_snapshot *s)
{
  const gg_model *m = s->model;
  size_t cells = gg_measure_cell_grid_cells(&f->grid);
  memset(f->mean, 0, cells * sizeof *f->mean);
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    double inertia = gg_moment_of_inertia(m, k);
    f->at[i] = (uint32_t)gg_measure_cell_grid_cell(&f->grid, s, i);
    gg_cell_mean *cell = &f->mean[f->at[i]];
    cell->mass += m->mass[k], cell->inertia += inertia;
    add(&cell->c, m->mass[k], of_grain(s->c, i));
    if (s->s[0]) add(&cell->omega, inertia, omega_of(s, i));
  }
  for (size_t k = 0; k < cells; k++) {
    gg_cell_mean *cell = &f->mean[k];
    if (cell->mass > 0) cell->c = gg_scale(1 / cell->mass, cell->c);
    if (cell->inertia > 0) cell->omega = gg_scale(1 / cell->inertia, cell->omega);
  }
}

gg_vec gg_measure_cell_frame_velocity(const gg_cell_frame *f, const gg_snapshot *s, size_t i)
{
  return gg_sub(of_grain(s->c, i), f->mean[f->at[i]].c);
}

gg_vec gg_measure_cell_frame_spin(const gg_cell_frame *f, const gg_snapshot *s, size_t i)
{
  return gg_sub(omega_of(s, i), f->mean[f->at[i]].omega);
}

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
