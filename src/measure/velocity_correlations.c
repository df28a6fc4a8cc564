/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spatial velocity correlations G(r) = <zeta_a(R) zeta_b(R + r)>/<zeta_a^2>: C with C and Omega with Omega by
 * component, C_x with Omega_z (over the root of both), over all directions, and within half a diameter of the axes.
 * Without correlations G is a little below 0, because the total momentum is 0. Spins are about their mean, by
 * species. The local correlations are of velocities and spins about the means of cells (Gayen's thesis, appendix
 * II). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/cell_frame.h"
#include "measure/observable.h"
#include "measure/pairs.h"

enum { MOST_BINS = 60, RADIAL_WIDTH = 8, AXIS_WIDTH = 4 };
/* Bins. Radial: count, C_a C_a, W_a W_a, C_x W_z. Along each axis: count, C_x C_x, W_z W_z, C_x W_z. After them:
 * sums of squares. */
enum { COUNT, CC, WW = CC + 3, CW = WW + 3 };
enum { AXIS_CC = 1, AXIS_WW, AXIS_CW };
enum { SQUARES = 7 }; /* grains, C_a^2, Omega_a^2 */
#define SPACING 0.25
#define TUBE 0.5
/* Pairs a grain and snapshot, and the exponent by which their number falls with distance: every shell has as many. */
#define TRIES 50
#define FALL 2.0

/* Velocity and spin of a grain, in the order of the pairs; spins about their mean. */
typedef struct motion {
  double c[3], w[3];
} motion;

typedef struct correlations {
  const gg_model *model;
  gg_pairs pairs;
  int bins;
  bool spins, local;
  gg_cell_frame cells; /* for the local correlations */
  motion *motion;
} correlations;

static void destroy(void *self)
{
  correlations *d = self;
  gg_measure_pairs_clear(&d->pairs);
  if (d->local) gg_measure_cell_frame_clear(&d->cells);
  free(d->motion);
  free(d);
}

static void *create_of(const gg_model *m, bool local, gg_error *err)
{
  correlations *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = m;
  double reach = gg_measure_pairs_longest_reach(m);
  d->bins = (int)fmin(floor(reach / SPACING), MOST_BINS);
  d->spins = m->rule != GG_SMOOTH;
  d->local = local;
  bool whole = !local || gg_measure_cell_frame_init(&d->cells, m, gg_measure_cell_grid_of(m), err) == GG_OK;
  d->motion = gg_base_array_new((size_t)m->n, sizeof *d->motion, err);
  if (whole && d->motion && gg_measure_pairs_init(&d->pairs, m, d->bins * SPACING, TRIES, FALL, err) == GG_OK) return d;
  destroy(d);
  return NULL;
}

static void *create(const gg_model *m, gg_error *err)
{
  return create_of(m, false, err);
}
static void *create_local(const gg_model *m, gg_error *err)
{
  return create_of(m, true, err);
}

static size_t bins(const void *self)
{
  return (size_t)((const correlations *)self)->bins * (RADIAL_WIDTH + 3 * AXIS_WIDTH) + SQUARES;
}

typedef struct summing {
  const correlations *d;
  double *bin;
} summing;

GG_INLINE void add_along(const correlations *d, double *bin, const motion *i, const motion *j, double weight)
{
  bin[COUNT] += weight;
  bin[AXIS_CC] += weight * (i->c[0] * j->c[0]);
  if (!d->spins) return;
  bin[AXIS_WW] += weight * (i->w[2] * j->w[2]);
  bin[AXIS_CW] += 0.5 * weight * (i->c[0] * j->w[2] + j->c[0] * i->w[2]);
}

GG_INLINE void add_pair(void *context, uint32_t one, uint32_t two, gg_vec r, double square, double weight)
{
  const summing *s = context;
  const correlations *d = s->d;
  const motion *i = &d->motion[one], *j = &d->motion[two];
  int k = (int)(sqrt(square) * (1 / SPACING));
  if (k >= d->bins) return;
  double *bin = s->bin + k * RADIAL_WIDTH;
  bin[COUNT] += weight;
  for (int a = 0; a < 3; a++) bin[CC + a] += weight * (i->c[a] * j->c[a]);
  if (d->spins) {
    for (int a = 0; a < 3; a++) bin[WW + a] += weight * (i->w[a] * j->w[a]);
    bin[CW] += 0.5 * weight * (i->c[0] * j->w[2] + j->c[0] * i->w[2]);
  }
  const double along[3] = {r.x, r.y, r.z};
  for (int a = 0; a < 3; a++)
    if (square - along[a] * along[a] < TUBE * TUBE)
      add_along(d, s->bin + d->bins * (RADIAL_WIDTH + a * AXIS_WIDTH) + k * AXIS_WIDTH, i, j, weight);
}

static void mean_spins(const correlations *d, const gg_snapshot *s, double mean[GG_MAX_SPECIES][3])
{
  memset(mean, 0, GG_MAX_SPECIES * sizeof *mean);
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) mean[gg_snapshot_species(s, i)][a] += gg_snapshot_omega(s, a, i);
  for (int k = 0; k < d->model->n_species; k++)
    for (int a = 0; a < 3; a++) mean[k][a] /= (double)d->model->n_of[k];
}

static void take_motion(const correlations *d, const gg_snapshot *s, size_t i, double mean[GG_MAX_SPECIES][3],
                        motion *m)
{
  for (int a = 0; a < 3; a++) {
    m->c[a] = s->c[a][i];
    if (d->spins) m->w[a] = gg_snapshot_omega(s, a, i) - mean[gg_snapshot_species(s, i)][a];
  }
}

static void take_local_motion(const correlations *d, const gg_snapshot *s, size_t i, motion *m)
{
  gg_vec c = gg_measure_cell_frame_velocity(&d->cells, s, i);
  m->c[0] = c.x, m->c[1] = c.y, m->c[2] = c.z;
  if (!d->spins) return;
  gg_vec w = gg_measure_cell_frame_spin(&d->cells, s, i);
  m->w[0] = w.x, m->w[1] = w.y, m->w[2] = w.z;
}

/* Velocities and spins in the order of the pairs, and the sums of their squares. */
static void take_motions(correlations *d, const gg_snapshot *s, double *squares)
{
  double mean[GG_MAX_SPECIES][3];
  if (d->spins) mean_spins(d, s, mean);
  if (d->local) gg_measure_cell_frame_take(&d->cells, s);
  squares[0] += (double)s->n;
  for (size_t k = 0; k < s->n; k++) {
    motion *m = &d->motion[k];
    if (d->local)
      take_local_motion(d, s, d->pairs.grain[k], m);
    else
      take_motion(d, s, d->pairs.grain[k], mean, m);
    for (int a = 0; a < 3; a++) {
      squares[1 + a] += m->c[a] * m->c[a];
      if (d->spins) squares[4 + a] += m->w[a] * m->w[a];
    }
  }
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  correlations *d = self;
  summing to = {d, bin};
  gg_images box = gg_measure_pairs_images(s);
  gg_measure_pairs_sort(&d->pairs, s, &box);
  take_motions(d, s, bin + d->bins * (RADIAL_WIDTH + 3 * AXIS_WIDTH));
  gg_pairs_each(&d->pairs, s, &box, add_pair, &to);
}

/* Level without correlations. In equilibrium without momentum <C_i C_j> = -T/M for any two of total mass M, and
 * <C_i^2> = T (1/m_i - 1/M): over all pairs and grains -1/(M <1/m> - 1), which is -1/(N - 1) for one species. For
 * spins, about their mean by species, the latter. */
static double of_no_momentum(const gg_model *m)
{
  double mass = 0, inverse = 0;
  for (int k = 0; k < m->n_species; k++) {
    mass += (double)m->n_of[k] * m->mass[k];
    inverse += (double)m->n_of[k] / m->mass[k] / (double)m->n;
  }
  return -1 / (mass * inverse - 1);
}

/* One curve from a channel of `width`-wide bins, from the first bin that can contain a pair. */
static void put(const correlations *d, gg_curves *list, const char *name, const char *panel, const char *label,
                const double *bin, int width, int channel, double norm)
{
  const gg_model *m = d->model;
  int first = (int)(gg_common_model_narrowest(m) / SPACING);
  if (d->bins <= first) return;
  char full[64];
  snprintf(full, sizeof full, "%svelocity_correlation_%s", d->local ? "local_" : "", name);
  gg_curve *c = gg_measure_curve_add(list, (size_t)(d->bins - first), full, panel, label);
  gg_measure_curve_axes(c, "r", gg_measure_curve_unit(m, "length"), "G", "1");
  for (size_t i = 0; i < c->n; i++) {
    const double *at = bin + ((int)i + first) * width;
    c->x[i] = ((double)i + first + 0.5) * SPACING;
    c->value[i] = at[COUNT] > 0 ? at[channel] / (at[COUNT] * norm) : NAN;
  }
  if (d->local || m->frame != GG_FRAME_IMPOSED) return; /* negative within a cell, and zero beyond: no level */
  double level = strstr(name, "CxW") ? 0 : strchr(name, 'W') ? -1 / ((double)m->n - 1) : of_no_momentum(m);
  gg_measure_curve_beside(c, "uncorrelated", gg_measure_curve_level, &level);
}

static void put_radial(const correlations *d, const double *bin, const double *square, gg_curves *list)
{
  char name[48], label[24];
  for (int vector = 0; vector < 1 + d->spins; vector++)
    for (int a = 0; a < 3; a++) {
      snprintf(name, sizeof name, "%s%c", vector ? "W" : "C", "xyz"[a]);
      snprintf(label, sizeof label, "%s_%c", vector ? "Ω" : "C", "xyz"[a]);
      put(d, list, name, vector ? "G_{ΩΩ}(r)" : "G_{CC}(r)", label, bin, RADIAL_WIDTH, (vector ? WW : CC) + a,
          square[3 * vector + a]);
    }
  if (d->spins) put(d, list, "CxWz", "G_{CΩ}(r)", "radial", bin, RADIAL_WIDTH, CW, sqrt(square[0] * square[5]));
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const correlations *d = self;
  const double *sums = bin + d->bins * (RADIAL_WIDTH + 3 * AXIS_WIDTH);
  double square[6];
  for (int a = 0; a < 6; a++) square[a] = sums[1 + a] / sums[0];
  put_radial(d, bin, square, list);
  char name[48], label[24];
  for (int a = 0; a < 3; a++) {
    const double *along = bin + d->bins * (RADIAL_WIDTH + a * AXIS_WIDTH);
    snprintf(label, sizeof label, "along %c", "xyz"[a]);
    snprintf(name, sizeof name, "Cx_along_%c", "xyz"[a]);
    put(d, list, name, "G_{CC}^{xx} along axes", label, along, AXIS_WIDTH, AXIS_CC, square[0]);
    if (!d->spins) continue;
    snprintf(name, sizeof name, "Wz_along_%c", "xyz"[a]);
    put(d, list, name, "G_{ΩΩ}^{zz} along axes", label, along, AXIS_WIDTH, AXIS_WW, square[5]);
    snprintf(name, sizeof name, "CxWz_along_%c", "xyz"[a]);
    put(d, list, name, "G_{CΩ}(r)", label, along, AXIS_WIDTH, AXIS_CW, sqrt(square[0] * square[5]));
  }
}

const gg_observable gg_measure_velocity_correlations = {
    GG_OBSERVABLE(VELOCITY_CORRELATIONS, velocity_correlations),
    .create = create,
    .destroy = destroy,
    .refuses = gg_measure_needs_bulk,
    .positions = true,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 8, .framed = true, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.bytes = 82, .ns = {110, 0}},
};

const gg_observable gg_measure_local_velocity_correlations = {
    GG_OBSERVABLE(LOCAL_VELOCITY_CORRELATIONS, local_velocity_correlations),
    .create = create_local,
    .destroy = destroy,
    .refuses = gg_measure_needs_bulk,
    .positions = true,
    .curves = &(const gg_observable_curves){.bins = bins, .every = 8, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.bytes = 92, .ns = {110, 0}},
};
