/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions of the components of C and Omega by height between walls: of the grains in slabs of equal thickness,
 * about the local flow of the window (local_frame.h). Heat that flows across the gap skews C_y, and next to a wall
 * arriving and leaving grains have different distributions. If the walls are alike, a slab's distribution is that of
 * the slab and of its image together (gap_slabs.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/gap_slabs.h"
#include "measure/histogram.h"
#include "measure/observable.h"

enum { SLABS = 6 };

typedef struct by_slab {
  const gg_model *model;
  int vectors; /* C, and Omega if there are spins */
} by_slab;

static const char *refuses(const gg_model *m)
{
  return gg_flow_is_walled(m->flow) ? NULL : "between walls only; elsewhere measure velocity_distributions";
}

static void *create(const gg_model *m, gg_error *err)
{
  by_slab *d = gg_base_array_new(1, sizeof *d, err);
  if (d) *d = (by_slab){.model = m, .vectors = m->rule == GG_SMOOTH ? 1 : 2};
  return d;
}

static size_t bins(const void *self)
{
  const by_slab *d = self;
  return (size_t)(d->model->n_species * d->vectors * SLABS * 3) * GG_HISTOGRAM;
}

static size_t place_of(const by_slab *d, int species, int vector, int slab, int axis)
{
  return (size_t)(((species * d->vectors + vector) * SLABS + slab) * 3 + axis) * GG_HISTOGRAM;
}

static gg_vec peculiar(const gg_snapshot *s, int vector, size_t i)
{
  double *const *x = vector ? s->s : s->c;
  const gg_vec v = {x[0][i], x[1][i], x[2][i]};
  if (!s->frame) return v;
  return vector ? gg_measure_local_frame_spin(s->frame, s->r[1][i], v, gg_snapshot_species(s, i))
                : gg_measure_local_frame_velocity(s->frame, s->r[1][i], v);
}

/* The root of <C.C>/3 over the gap at this instant, for each species: the unit of its histograms. */
static void take_units(const by_slab *d, const gg_snapshot *s, int vector, double unit[GG_MAX_SPECIES])
{
  double squares[GG_MAX_SPECIES] = {0}, grains[GG_MAX_SPECIES] = {0};
  for (size_t i = 0; i < s->n; i++) {
    const gg_vec v = peculiar(s, vector, i);
    const int k = gg_snapshot_species(s, i);
    squares[k] += gg_dot(v, v), grains[k]++;
  }
  for (int k = 0; k < d->model->n_species; k++) unit[k] = sqrt(squares[k] / (3 * grains[k]));
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  const by_slab *d = self;
  for (int vector = 0; vector < d->vectors; vector++) {
    double unit[GG_MAX_SPECIES];
    take_units(d, s, vector, unit);
    for (size_t i = 0; i < s->n; i++) {
      const int slab = (int)floor(s->r[1][i] / d->model->box[1] * SLABS), k = gg_snapshot_species(s, i);
      if (slab < 0 || slab >= SLABS || !(unit[k] > 0)) continue; /* above an open top; all at rest */
      const gg_vec v = gg_scale(1 / unit[k], peculiar(s, vector, i));
      double *to = bin + place_of(d, k, vector, slab, 0);
      gg_histogram_add(to, v.x), gg_histogram_add(to + GG_HISTOGRAM, v.y), gg_histogram_add(to + 2 * GG_HISTOGRAM, v.z);
    }
  }
}

/* The histogram of a slab; if the gap is symmetric, with that of the image, in which x is `sign` times x. */
static void fold(const by_slab *d, const double *bin, int species, int vector, int slab, int axis, double *to)
{
  const gg_wall_symmetry symmetry = gg_wall_symmetry_of(d->model);
  const double *own = bin + place_of(d, species, vector, slab, axis),
               *other = bin + place_of(d, species, vector, SLABS - 1 - slab, axis);
  for (int k = 0; k < GG_HISTOGRAM; k++) to[k] = own[k];
  if (symmetry == GG_NO_SYMMETRY) return;
  const double sign = gg_wall_image(symmetry, vector, axis);
  for (int k = 0; k < GG_HISTOGRAM_BINS; k++) to[k] += other[sign < 0 ? GG_HISTOGRAM_BINS - 1 - k : k];
  for (int k = GG_HISTOGRAM_BINS; k < GG_HISTOGRAM; k++) to[k] += (k == GG_HISTOGRAM_CUBES ? sign : 1) * other[k];
}

static void put(const by_slab *d, gg_curves *list, int species, int vector, int slab, int axis, const double *bin)
{
  const char *what = vector ? "W" : "C", *greek = vector ? "Ω" : "C";
  const double from = d->model->box[1] * slab / SLABS, to = d->model->box[1] * (slab + 1) / SLABS;
  char name[48], panel[64], label[48], argument[24], tail[16] = "", of[24] = "";
  double sum[GG_HISTOGRAM];
  if (d->model->n_species > 1) {
    snprintf(tail, sizeof tail, "_%d", species + 1);
    snprintf(of, sizeof of, " of species %d", species + 1);
  }
  snprintf(name, sizeof name, "slab_distribution_%s%c%s_%d", what, "xyz"[axis], tail, slab + 1);
  snprintf(panel, sizeof panel, "%s_%c%s, by height", greek, "xyz"[axis], of);
  snprintf(label, sizeof label, "y %.3g to %.3g", from, to);
  snprintf(argument, sizeof argument, "%s_%c/σ", greek, "xyz"[axis]);
  fold(d, bin, species, vector, slab, axis, sum);
  const double sigma = gg_measure_histogram_sigma(sum); /* NaN if there was never a grain */
  gg_curve *c = gg_measure_histogram_put(list, name, panel, label, sum, sigma, 0);
  c->folded = gg_wall_symmetry_of(d->model) != GG_NO_SYMMETRY;
  gg_measure_curve_axes(c, argument, "1", "P/P(0)", "1");
  gg_measure_curve_put_number(c, "variance_over_mean", sigma * sigma, "1");
}

/* The image of the upper half is the lower half. */
static void curves(const void *self, const double *bin, gg_curves *list)
{
  const by_slab *d = self;
  const int slabs = gg_wall_symmetry_of(d->model) == GG_NO_SYMMETRY ? SLABS : SLABS / 2;
  for (int k = 0; k < d->model->n_species; k++)
    for (int v = 0; v < d->vectors; v++)
      for (int axis = 0; axis < 3; axis++)
        for (int slab = 0; slab < slabs; slab++) put(d, list, k, v, slab, axis, bin);
}

const gg_observable gg_measure_slab_distributions = {
    GG_OBSERVABLE(SLAB_DISTRIBUTIONS, slab_distributions),
    .create = create,
    .destroy = free,
    .refuses = refuses,
    .positions = true,
    .curves = &(const gg_observable_curves){.bins = bins, .every = 4, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.ns = {20, 20}},
};
