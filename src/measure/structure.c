/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Structure factor S(k) = <|sum_i exp(-i k.r_i)|^2>/N, and spectra of the momentum field, <|k_hat.J(k)|^2>
 * (longitudinal) and half the rest (transverse) over <sum m^2 C^2>/3: 1 without correlations. J(k) = sum_i m_i C_i
 * exp(-i k.r_i). Averaged over directions, and S along the axes (under shear, along x: the mode nearest to the axis).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/mesh.h"
#include "measure/observable.h"

enum { COUNT, WAVE, DENSITY, LONGITUDINAL, TRANSVERSE, RADIAL }; /* a radial bin */
enum { AXIS_COUNT, AXIS_DENSITY, AXIS };                         /* a mode along an axis */

typedef struct structure {
  const gg_model *model;
  gg_mesh mesh;
  int most;         /* modes along each edge */
  gg_mode *mode[4]; /* of density and momentum: (2 most + 1)^2 (most + 1) */
  double *momentum;
} structure;

static void destroy(void *self)
{
  structure *d = self;
  gg_measure_mesh_clear(&d->mesh);
  for (int f = 0; f < 4; f++) free(d->mode[f]);
  free(d->momentum);
  free(d);
}

static size_t modes_of(const structure *d)
{
  size_t across = 2 * (size_t)d->most + 1;
  return across * across * ((size_t)d->most + 1);
}

static void *create(const gg_model *m, gg_error *err)
{
  structure *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = m;
  int n = gg_measure_mesh_points_along(m);
  d->most = n / 4;
  bool whole = gg_measure_mesh_init(&d->mesh, n, err) == GG_OK;
  for (int f = 0; f < 4 && whole; f++)
    whole = (d->mode[f] = gg_base_array_new(modes_of(d), sizeof(gg_mode), err)) != NULL;
  if (whole) d->momentum = gg_base_array_new((size_t)m->n, sizeof(double), err);
  if (whole && d->momentum) return d;
  destroy(d);
  return NULL;
}

static size_t bins(const void *self)
{
  return (size_t)((const structure *)self)->most * (RADIAL + 3 * AXIS);
}

/* Samples between transforms; more in small systems in large boxes, where a transform takes the time of many
 * collisions. */
enum { EVERY = 32 };
static int every_of(const void *self)
{
  const structure *d = self;
  double points = (double)d->mesh.n * d->mesh.n * d->mesh.n / (double)d->model->n;
  return EVERY * (int)fmax(1, ceil(points / GG_MESH_POINTS_PER_GRAIN));
}

static void keep_modes(structure *d, int field)
{
  gg_mode *to = d->mode[field];
  for (int z = -d->most; z <= d->most; z++)
    for (int y = -d->most; y <= d->most; y++)
      for (int x = 0; x <= d->most; x++) *to++ = gg_measure_mesh_mode(&d->mesh, x, y, z);
}

static double square(gg_mode a)
{
  return a.re * a.re + a.im * a.im;
}

/* The smallest of the largest wave numbers along the edges sets the bins: below it all directions are available. */
static double spacing(const gg_model *m)
{
  return 2 * M_PI / fmax(fmax(m->box[0], m->box[1]), m->box[2]);
}

static void add_mode(const structure *d, size_t at, gg_vec k, int nx, double scale, double *bin)
{
  double n = (double)d->model->n, length = sqrt(gg_dot(k, k)), weight = nx ? 2 : 1; /* -k is not stored */
  int b = (int)(length / spacing(d->model) - 0.5);
  if (b < 0 || b >= d->most) return;
  gg_mode x = d->mode[1][at], y = d->mode[2][at], z = d->mode[3][at];
  gg_mode along = {(k.x * x.re + k.y * y.re + k.z * z.re) / length, (k.x * x.im + k.y * y.im + k.z * z.im) / length};
  bin += b * RADIAL;
  bin[COUNT] += weight;
  bin[WAVE] += weight * length;
  bin[DENSITY] += weight * square(d->mode[0][at]) / n;
  bin[LONGITUDINAL] += weight * square(along) / (n * scale);
  bin[TRANSVERSE] += weight * (square(x) + square(y) + square(z) - square(along)) / (2 * n * scale);
}

/* sum m^2 C^2/(3N) of this instant. */
static double transform_fields(structure *d, const gg_snapshot *s, const gg_images *box)
{
  double sum = 0;
  gg_measure_mesh_transform(&d->mesh, s, box, NULL);
  keep_modes(d, 0);
  for (int a = 0; a < 3; a++) {
    for (size_t i = 0; i < s->n; i++) {
      d->momentum[i] = d->model->mass[gg_snapshot_species(s, i)] * s->c[a][i];
      sum += d->momentum[i] * d->momentum[i];
    }
    gg_measure_mesh_transform(&d->mesh, s, box, d->momentum);
    keep_modes(d, 1 + a);
  }
  return sum / (3 * (double)s->n);
}

static double density_of(const structure *d, int x, int y, int z)
{
  size_t across = 2 * (size_t)d->most + 1;
  size_t at = ((size_t)(z + d->most) * across + (size_t)(y + d->most)) * ((size_t)d->most + 1) + (size_t)x;
  return square(d->mode[0][at]) / (double)d->model->n;
}

static void add_axes(const structure *d, const gg_images *box, double *bin)
{
  for (int k = 1; k <= d->most; k++) {
    int nx = (int)lround(k * box->offset * box->inverse[0]); /* |D| <= L_x/2: within the mesh */
    const double value[3] = {density_of(d, k, nx, 0), density_of(d, 0, k, 0), density_of(d, 0, 0, k)};
    for (int a = 0; a < 3; a++) {
      bin[(a * d->most + k - 1) * AXIS + AXIS_COUNT]++;
      bin[(a * d->most + k - 1) * AXIS + AXIS_DENSITY] += value[a];
    }
  }
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  structure *d = self;
  gg_images box = gg_measure_pairs_images(s);
  double scale = transform_fields(d, s, &box);
  size_t at = 0;
  for (int z = -d->most; z <= d->most; z++)
    for (int y = -d->most; y <= d->most; y++)
      for (int x = 0; x <= d->most; x++, at++)
        if (x || y || z) add_mode(d, at, gg_measure_mesh_wave_vector(&box, x, y, z), x, scale, bin);
  add_axes(d, &box, bin + d->most * RADIAL);
}

static gg_curve *start(const structure *d, gg_curves *list, const char *name, const char *panel, const char *label,
                       const char *y_name)
{
  gg_curve *c = gg_measure_curve_add(list, (size_t)d->most, name, panel, label);
  char unit[40];
  snprintf(unit, sizeof unit, "1/%.30s", gg_measure_curve_unit(d->model, "length"));
  gg_measure_curve_axes(c, "k", unit, y_name, "1");
  return c;
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const structure *d = self;
  static const struct {
    const char *name, *panel, *label, *y_name;
    int channel;
  } radial[] = {{"structure_factor", "structure factor", "all directions", "S", DENSITY},
                {"velocity_spectrum_longitudinal", "velocity spectra", "longitudinal", "E", LONGITUDINAL},
                {"velocity_spectrum_transverse", "velocity spectra", "transverse", "E", TRANSVERSE}};
  for (int r = 0; r < 3; r++) {
    gg_curve *c = start(d, list, radial[r].name, radial[r].panel, radial[r].label, radial[r].y_name);
    for (size_t i = 0; i < c->n; i++) {
      const double *at = bin + i * RADIAL;
      c->x[i] = at[COUNT] > 0 ? at[WAVE] / at[COUNT] : ((double)i + 1) * spacing(d->model);
      c->value[i] = at[COUNT] > 0 ? at[radial[r].channel] / at[COUNT] : NAN;
    }
    if (radial[r].channel != DENSITY)
      gg_measure_curve_beside(c, "no correlation", gg_measure_curve_level, &(double){1});
  }
  for (int a = 0; a < 3; a++) {
    char name[48], label[24];
    snprintf(name, sizeof name, "structure_factor_%c", "xyz"[a]);
    snprintf(label, sizeof label, "along %c", "xyz"[a]);
    gg_curve *c = start(d, list, name, "structure factor", label, "S");
    for (size_t i = 0; i < c->n; i++) {
      const double *at = bin + d->most * RADIAL + (a * d->most + (int)i) * AXIS;
      c->x[i] = 2 * M_PI * ((double)i + 1) / d->model->box[a];
      c->value[i] = at[AXIS_DENSITY] / at[AXIS_COUNT];
    }
  }
}

/* Transforms of four fields take 24 ns a mesh point, in every 32nd sample or less often. Memory of a mesh point: the
 * field, its transform, four modes. */
static gg_observable_cost cost_of(const gg_model *m)
{
  const double points = pow(gg_measure_mesh_points_along(m), 3) / (double)m->n;
  const double ns = 24 * points / (32 * fmax(1, ceil(points / GG_MESH_POINTS_PER_GRAIN))) + 10;
  return (gg_observable_cost){.bytes = 8 + 20 * points, .ns = {ns, ns}};
}

const gg_observable gg_measure_structure = {
    GG_OBSERVABLE(STRUCTURE, structure),
    .create = create,
    .destroy = destroy,
    .refuses = gg_measure_needs_bulk,
    .positions = true,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = EVERY, .every_of = every_of, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost_of = cost_of,
};
