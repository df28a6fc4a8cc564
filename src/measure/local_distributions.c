/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions of C_x and Omega_z in thin and dense regions: of the grains in cells whose density lies within a
 * tenth of a chosen one (Gayen's thesis, section 4.1), and of the grains of all cells. Cells have about eight
 * grains. Velocities are about the mean of the cell; with the fraction m_i/M_c of the variance restored that a mean
 * over few grains takes away they are, for Gaussian grains, Gaussian again. If the scene's frame is made of cells,
 * cells and velocities are those of the frame; if it is made of slabs, velocities alone. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/cell_frame.h"
#include "measure/histogram.h"
#include "measure/observable.h"

enum { VECTORS = 2 };
static const double usual[] = {0.5, 0.75, 1, 1.25, 1.5}; /* of the mean solid fraction */
#define TOLERANCE 0.1

typedef struct cell {
  double volume, weight[VECTORS], sum[VECTORS]; /* of grains; m, m C_x; I, I omega_z */
} cell;

typedef struct local {
  const gg_model *model;
  gg_cell_grid grid;
  int vectors;
  int densities;                     /* the class after them has all cells */
  bool given;                        /* by the scene */
  double centre[GG_LOCAL_DENSITIES]; /* of the mean solid fraction */
  cell *cell;
  uint32_t *at;           /* the cell of each grain */
  double *value[VECTORS]; /* of each grain, about its cell's mean */
} local;

static void destroy(void *self)
{
  local *d = self;
  for (int v = 0; v < VECTORS; v++) free(d->value[v]);
  free(d->at);
  free(d->cell);
  free(d);
}

static void choose_densities(local *d)
{
  const gg_model *m = d->model;
  d->given = m->local_density[0] > 0;
  const int most = d->given ? GG_LOCAL_DENSITIES : (int)(sizeof usual / sizeof *usual);
  for (int j = 0; j < most && (!d->given || m->local_density[j] > 0); j++, d->densities++)
    d->centre[j] = d->given ? m->local_density[j] / m->phi : usual[j];
}

static void *create(const gg_model *m, gg_error *err)
{
  local *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = m;
  d->vectors = m->rule == GG_SMOOTH ? 1 : VECTORS;
  d->grid = gg_frame_has_slabs(m->frame) ? gg_measure_cell_grid_of(m) : gg_measure_frame_grid_of(m);
  choose_densities(d);
  d->cell = gg_base_array_new(gg_measure_cell_grid_cells(&d->grid), sizeof *d->cell, err);
  d->at = gg_base_array_new((size_t)m->n, sizeof *d->at, err);
  bool whole = d->cell && d->at;
  for (int v = 0; v < d->vectors; v++)
    if (!(d->value[v] = gg_base_array_new((size_t)m->n, sizeof(double), err))) whole = false;
  if (whole) return d;
  destroy(d);
  return NULL;
}

static size_t bins(const void *self)
{
  const local *d = self;
  return (size_t)(d->model->n_species * d->vectors * (d->densities + 1)) * GG_HISTOGRAM;
}

static double *histogram_of(const local *d, double *bin, int species, int vector, int class)
{
  return bin + ((species * d->vectors + vector) * (d->densities + 1) + class) * GG_HISTOGRAM;
}

static double weight_of(const gg_model *m, int species, int vector)
{
  return vector ? gg_moment_of_inertia(m, species) : m->mass[species];
}

static double component(const gg_snapshot *s, int vector, size_t i)
{
  return vector ? gg_snapshot_omega(s, 2, i) : s->c[0][i];
}

static void sort_grains(local *d, const gg_snapshot *s)
{
  const gg_model *m = d->model;
  memset(d->cell, 0, gg_measure_cell_grid_cells(&d->grid) * sizeof *d->cell);
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    d->at[i] = (uint32_t)gg_measure_cell_grid_cell(&d->grid, s, i);
    cell *c = &d->cell[d->at[i]];
    c->volume += m->diameter[k] * m->diameter[k] * m->diameter[k];
    for (int v = 0; v < d->vectors; v++) {
      double w = weight_of(m, k, v);
      c->weight[v] += w, c->sum[v] += w * component(s, v, i);
    }
  }
}

/* Value of a grain about its cell's mean; NaN if it is alone in its cell. */
static double about_cell(const local *d, const gg_snapshot *s, int v, size_t i)
{
  const cell *c = &d->cell[d->at[i]];
  double w = weight_of(d->model, gg_snapshot_species(s, i), v), left = c->weight[v] - w;
  return left > 1e-9 * w ? (component(s, v, i) - c->sum[v] / c->weight[v]) * sqrt(c->weight[v] / left) : NAN;
}

/* Values of grains, and by species their mean and standard deviation over the whole box. The frame's values are
 * about cells already, spins plus a mean of the box. */
static void take_values(local *d, const gg_snapshot *s, int v, gg_scale_of scale[GG_MAX_SPECIES])
{
  const bool framed = d->model->frame != GG_FRAME_IMPOSED;
  double sum[GG_MAX_SPECIES] = {0}, squares[GG_MAX_SPECIES] = {0}, n[GG_MAX_SPECIES] = {0};
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    double x = d->value[v][i] = framed ? component(s, v, i) : about_cell(d, s, v, i);
    if (isfinite(x)) sum[k] += x, squares[k] += x * x, n[k]++;
  }
  for (int k = 0; k < d->model->n_species; k++) {
    double mean = framed ? sum[k] / n[k] : 0;
    scale[k] = (gg_scale_of){mean, sqrt(squares[k] / n[k] - mean * mean)};
  }
}

static bool belongs(const local *d, double density, int class)
{
  return class == d->densities || fabs(density / d->centre[class] - 1) <= TOLERANCE + 1e-9;
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  local *d = self;
  const gg_model *m = d->model;
  double mean = 6 / M_PI * m->phi * m->volume / (double)gg_measure_cell_grid_cells(&d->grid); /* sum of d^3 in a cell */
  sort_grains(d, s);
  for (int v = 0; v < d->vectors; v++) {
    gg_scale_of scale[GG_MAX_SPECIES];
    take_values(d, s, v, scale);
    for (size_t i = 0; i < s->n; i++) {
      double density = d->cell[d->at[i]].volume / mean;
      int k = gg_snapshot_species(s, i);
      if (!isfinite(d->value[v][i])) continue;
      for (int j = 0; j <= d->densities; j++)
        if (belongs(d, density, j))
          gg_histogram_add(histogram_of(d, bin, k, v, j), (d->value[v][i] - scale[k].mean) / scale[k].sigma);
    }
  }
}

static void put(const local *d, gg_curves *list, int species, int vector, int j, const double *bin)
{
  static const char *const plain[] = {"Cx", "Wz"}, *const written[] = {"C_x", "Ω_z"};
  char name[64], panel[48], label[24], argument[24], class[24] = "all", tail[16] = "", of[24] = "";
  const bool all = j == d->densities;
  const double phi = all ? d->model->phi : d->given ? d->model->local_density[j] : d->model->phi * d->centre[j];
  if (d->model->n_species > 1) {
    snprintf(tail, sizeof tail, "_%d", species + 1);
    snprintf(of, sizeof of, " of species %d", species + 1);
  }
  if (!all) snprintf(class, sizeof class, d->given ? "phi_%.9g" : "%g", d->given ? phi : d->centre[j]);
  snprintf(name, sizeof name, "local_distribution_%s%s_%s", plain[vector], tail, class);
  snprintf(panel, sizeof panel, "%s%s, by local density", written[vector], of);
  snprintf(label, sizeof label, all ? "all cells" : "φ %.3g", phi);
  snprintf(argument, sizeof argument, "%s/σ", written[vector]);
  double sigma = gg_measure_histogram_sigma(bin); /* NaN if no cell ever had this density */
  gg_curve *c = gg_measure_histogram_put(list, name, panel, label, bin, sigma, (double)list->samples);
  gg_measure_curve_axes(c, argument, "1", "P/P(0)", "1");
  gg_measure_curve_put_number(c, "temperature_over_mean", sigma * sigma, "1");
  gg_measure_curve_put_number(c, "solid_fraction", phi, "1");
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const local *d = self;
  for (int k = 0; k < d->model->n_species; k++)
    for (int v = 0; v < d->vectors; v++)
      for (int j = 0; j <= d->densities; j++, bin += GG_HISTOGRAM) put(d, list, k, v, j, bin);
}

const gg_observable gg_measure_local_distributions = {
    GG_OBSERVABLE(LOCAL_DISTRIBUTIONS, local_distributions),
    .create = create,
    .destroy = destroy,
    .refuses = gg_measure_needs_bulk,
    .positions = true,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 4, .framed = true, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.bytes = 25, .ns = {10, 0}},
};
