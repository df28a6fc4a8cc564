/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/cell_frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

typedef struct gg_cell_mean {
  double mass, inertia; /* sums of m and I; then the means of c and omega with these weights */
  double y;             /* the same for the height */
  gg_vec c, omega;
} gg_cell_mean;

gg_status gg_measure_cell_frame_init(gg_cell_frame *f, const gg_model *m, gg_cell_grid grid, gg_error *err)
{
  f->grid = grid;
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
    cell->y += m->mass[k] * s->r[1][i];
    add(&cell->c, m->mass[k], of_grain(s->c, i));
    if (s->s[0]) add(&cell->omega, inertia, omega_of(s, i));
  }
  for (size_t k = 0; k < cells; k++) {
    gg_cell_mean *cell = &f->mean[k];
    if (cell->mass > 0) cell->c = gg_scale(1 / cell->mass, cell->c), cell->y /= cell->mass;
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

gg_cell_grid gg_measure_frame_grid_of(const gg_model *m)
{
  gg_cell_grid g = gg_measure_cell_grid_of(m);
  for (int a = 0; a < 3 && m->frame != GG_FRAME_IMPOSED; a++)
    g.n[a] = a == 1 || !gg_frame_has_slabs(m->frame) ? m->frame_cells : 1;
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

gg_status gg_measure_framed_init(gg_framed *f, const gg_model *m, gg_error *err)
{
  GG_TRY(gg_measure_cell_frame_init(&f->cells, m, gg_measure_frame_grid_of(m), err));
  for (int a = 0; a < 3; a++) {
    if (!(f->c[a] = gg_base_array_new((size_t)m->n, sizeof(double), err))) return GG_FAILED;
    if (m->rule != GG_SMOOTH && !(f->s[a] = gg_base_array_new((size_t)m->n, sizeof(double), err))) return GG_FAILED;
  }
  return GG_OK;
}

void gg_measure_framed_clear(gg_framed *f)
{
  gg_measure_cell_frame_clear(&f->cells);
  for (int a = 0; a < 3; a++) free(f->c[a]), free(f->s[a]);
}

static void put(double *const to[3], size_t i, gg_vec v)
{
  to[0][i] = v.x, to[1][i] = v.y, to[2][i] = v.z;
}

/* Fraction of a grain's variance that remains after subtracting the mean of its cell; 0 if it is alone. */
static double remaining_variance(const gg_framed *f, size_t i, bool spin)
{
  const gg_snapshot *s = &f->snapshot;
  const gg_cell_mean *cell = &f->cells.mean[f->cells.at[i]];
  const int k = gg_snapshot_species(s, i);
  return spin ? 1 - gg_moment_of_inertia(s->model, k) / cell->inertia : 1 - s->model->mass[k] / cell->mass;
}

/* Correction for grains alone in their cells, and for the total mean, which the imposed flow has subtracted, too. */
static double correction_for_all(const gg_framed *f)
{
  const double n = (double)f->snapshot.n;
  double together = 0;
  for (size_t i = 0; i < f->snapshot.n; i++) together += remaining_variance(f, i, false) > 0;
  return together > 0 ? (n - 1) / together : 0;
}

static gg_vec mean_spin(const gg_cell_frame *f)
{
  gg_vec sum = {0, 0, 0};
  double inertia = 0;
  for (size_t k = 0; k < gg_measure_cell_grid_cells(&f->grid); k++) {
    add(&sum, f->mean[k].inertia, f->mean[k].omega);
    inertia += f->mean[k].inertia;
  }
  return gg_scale(1 / inertia, sum);
}

void gg_measure_framed_take(gg_framed *f, const gg_snapshot *whole)
{
  const gg_model *m = whole->model;
  const bool laboratory = gg_frame_is_laboratory(m->frame);
  f->snapshot = *whole;
  f->snapshot.whole = whole;
  for (int a = 0; a < 3; a++) f->snapshot.c[a] = f->c[a], f->snapshot.s[a] = f->s[a];
  gg_measure_cell_frame_take(&f->cells, whole);
  const double all = laboratory ? 0 : correction_for_all(f);
  const gg_vec spin = f->s[0] ? mean_spin(&f->cells) : (gg_vec){0, 0, 0};
  for (size_t i = 0; i < whole->n; i++) {
    gg_vec c = gg_measure_cell_frame_velocity(&f->cells, whole, i);
    double left = remaining_variance(f, i, false), stretch = laboratory ? 1 : left > 0 ? sqrt(all / left) : 0;
    if (laboratory) c.x += m->shear_rate * (whole->r[1][i] - f->cells.mean[f->cells.at[i]].y);
    put(f->c, i, gg_scale(stretch, c));
    if (!f->s[0]) continue;
    if (!laboratory && left > 0) stretch = sqrt(all / remaining_variance(f, i, true));
    gg_vec omega = gg_scale(stretch, gg_measure_cell_frame_spin(&f->cells, whole, i));
    put(f->s, i, gg_scale(m->diameter[gg_snapshot_species(whole, i)] / 2, gg_add(omega, spin)));
  }
}

void gg_measure_framed_visit(const gg_framed *f, gg_visit *visit, void *context)
{
  const gg_snapshot *s = &f->snapshot, *w = s->whole;
  for (size_t from = 0; from < s->n; from += GG_CHUNK) {
    gg_chunk chunk = {.n = s->n - from < GG_CHUNK ? s->n - from : GG_CHUNK, .id = s->id + from};
    if (s->species) chunk.species = s->species + from;
    for (int a = 0; a < 3; a++) {
      chunk.r[a] = s->r[a] + from, chunk.c[a] = s->c[a] + from, chunk.whole_c[a] = w->c[a] + from;
      if (s->s[a]) chunk.s[a] = s->s[a] + from, chunk.whole_s[a] = w->s[a] + from;
    }
    visit(context, &chunk);
  }
}
