/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells of a channel: sorting of grains, mean numbers, contact values; and the time step, by the collision rate. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/contact_value.h"
#include "dsmc/walls/channel.h"
#include "simd/clones.h"

/* Width of cells in mean free paths l. The bias of transport by cells of width w is 0.11 (w/l)^2 (Alexander, Garcia &
 * Alder, Phys. Fluids 10 (1998) 1540). */
#define PATHS_PER_CELL 0.15
/* Width of cells in diameters, to resolve the layers at walls: in dense gases, and times phi in dilute ones, where
 * layers fade. */
#define DIAMETERS_PER_CELL 0.1
#define LAYERS_FADE 0.005
enum {
  LEAST_CELLS = 20,     /* across the channel */
  OPEN_HEIGHTS = 8,     /* with an open top cells reach up to so many heights of the box */
  NARROW = 25,          /* cells that a contact distance spans at least, for blocks */
  BLOCKS_PER_REACH = 8, /* blocks of a contact distance: narrower ones cost tables, wider ones candidates */
  PLACES = 16           /* solid fractions that are summed at once, in registers */
};

double gg_dsmc_channel_cell_width(const gg_model *m)
{
  double path = 1 / (sqrt(2) * M_PI * m->density * m->chi[0]);
  double width = fmin(PATHS_PER_CELL * path, m->box[1] / LEAST_CELLS);
  return m->boltzmann ? width : fmin(width, fmax(DIAMETERS_PER_CELL, LAYERS_FADE / m->phi));
}

/* Fraction of a grain's volume below z: integral of the cross-section pi (R^2 - z^2) up to z, over the whole integral.
 */
static double fraction_below(double radius, double z)
{
  const double u = fmin(fmax(z / radius, -1), 1);
  return 0.25 * (2 + 3 * u - u * u * u);
}

/* Set the kernels of the local solid fraction. Fischer & Methfessel, Phys. Rev. A 22 (1980) 2836: the contact value is
 * that of the density averaged over a sphere about the point of contact, which is the solid fraction there. */
static void set_kernels(gg_dsmc_channel *d)
{
  gg_dsmc_channel_cells *c = &d->cells;
  for (int s = 0; s < d->model.n_species; s++)
    for (int k = 0; k <= c->reach; k++) { /* places are half cells away */
      const double z = 0.5 * k * c->width, radius = 0.5 * d->model.diameter[s];
      c->kernel[s * (c->reach + 1) + k] =
          fraction_below(radius, z + 0.5 * c->width) - fraction_below(radius, z - 0.5 * c->width);
    }
}

static double lowest(const gg_dsmc_channel *d)
{
  double low = d->low[0];
  for (int s = 1; s < d->model.n_species; s++) low = fmin(low, d->low[s]);
  return low;
}

static double highest(const gg_dsmc_channel *d)
{
  if (gg_common_surface_is_open_above(&d->model)) return OPEN_HEIGHTS * d->model.box[1];
  double high = d->high[0];
  for (int s = 1; s < d->model.n_species; s++) high = fmax(high, d->high[s]);
  return high;
}

/* Contact distance in cells. */
static double reach_of(const gg_dsmc_channel *d)
{
  double reach = 0;
  for (int p = 0; p < gg_pairs_of(d->model.n_species); p++) reach = fmax(reach, d->reach[p] * d->cells.inverse);
  return reach;
}

/* Blocks of cells, for one species: grains of several species are not consecutive in a block. */
static gg_status make_blocks(gg_dsmc_channel *d, gg_error *err)
{
  gg_dsmc_channel_cells *c = &d->cells;
  const double reach = reach_of(d);
  if (d->model.n_species > 1 || d->periodic || reach < NARROW) return GG_OK;
  c->block = (int)fmax(1, floor(reach / BLOCKS_PER_REACH));
  c->blocks = (c->n + c->block - 1) / c->block;
  c->far = (int)ceil(reach / c->block);
  c->height = gg_base_array_new((size_t)c->far + 1, sizeof *c->height, err);
  c->most_chi = gg_base_array_new(2 * (size_t)c->blocks, sizeof *c->most_chi, err);
  if (!c->height || !c->most_chi) return GG_FAILED;
  for (int k = 0; k <= c->far; k++) c->height[k] = fmax(0.5, fmin((k + 1) * c->block / reach, 1));
  return GG_OK;
}

/* Partition the grains into parts and the cells into slabs of whole blocks. Partners of a slab are beyond its ends by
 * at most the contact distance, a block and a cell, for rounding. */
static gg_status partition(gg_dsmc_channel *d, gg_error *err)
{
  const gg_dsmc_channel_cells *c = &d->cells;
  const int64_t bins = (int64_t)c->n * d->model.n_species, n = d->model.n;
  const int block = c->block > 0 ? c->block : 1, blocks = (c->n + block - 1) / block;
  const double beyond = ceil(reach_of(d)) + 1 + c->block;
  d->parts = (int)fmin(GG_DSMC_CHANNEL_MOST_PARTS, fmax(1, (double)(n / (16 * bins))));
  d->slabs = (int)fmin(GG_DSMC_CHANNEL_MOST_SLABS, floor(c->n / (2 * beyond) / 2) * 2);
  if (n < GG_DSMC_CHANNEL_LEAST_SHARED) d->parts = 1;
  if (n < GG_DSMC_CHANNEL_LEAST_SHARED || d->slabs < 4) d->slabs = 1;
  const size_t bytes = (size_t)d->slabs * sizeof *d->slab;
  if (!(d->slab = aligned_alloc(64, bytes))) return gg_base_out_of_memory(err);
  memset(d->slab, 0, bytes);
  for (int k = 0; k < d->slabs; k++) {
    d->slab[k].first = (int)((int64_t)blocks * k / d->slabs) * block;
    d->slab[k].end = (int)fmin((double)((int64_t)blocks * (k + 1) / d->slabs * block), c->n);
  }
  return GG_OK;
}

gg_status gg_dsmc_channel_cells_new(gg_dsmc_channel *d, gg_error *err)
{
  const gg_model *m = &d->model;
  gg_dsmc_channel_cells *c = &d->cells;
  const size_t species = (size_t)m->n_species, pairs = (size_t)gg_pairs_of(m->n_species);
  c->from = lowest(d);
  const double height = highest(d) - c->from;
  c->n = (int)fmin(ceil(height / gg_dsmc_channel_cell_width(m) * (1 - 1e-12)), 1e7);
  c->width = height / c->n;
  c->inverse = c->n / height;
  c->volume = m->box[0] * m->box[2] * c->width;
  c->reach = (int)fmin(1 + ceil(gg_common_model_widest(m) * c->inverse), 2 * c->n);
  const size_t n = (size_t)c->n;
  c->start_below = gg_base_array_new((n + 2) * species + 1, sizeof *c->start, err);
  c->counted = gg_base_array_new(n * species, sizeof *c->counted, err);
  c->mean = gg_base_array_new(n * species, sizeof *c->mean, err);
  c->hits = gg_base_array_new(n, sizeof *c->hits, err);
  c->chi = gg_base_array_new(pairs * 2 * n + 2, sizeof *c->chi, err);
  c->filled = gg_base_array_new(7 * n + (size_t)c->reach + 2 + PLACES, sizeof *c->filled, err);
  c->kernel = gg_base_array_new(species * (size_t)(c->reach + 1), sizeof *c->kernel, err);
  c->majorant = gg_base_array_new(n * species * species, sizeof *c->majorant, err);
  GG_TRY(make_blocks(d, err));
  GG_TRY(partition(d, err));
  c->stride = (n * species + 15) / 16 * 16;
  c->next = gg_base_array_new((size_t)d->parts * c->stride, sizeof *c->next, err);
  if (!c->start_below || !c->next || !c->counted || !c->mean || !c->hits || !c->chi || !c->filled || !c->kernel ||
      !c->majorant)
    return GG_FAILED;
  c->start = c->start_below + species;
  set_kernels(d);
  return GG_OK;
}

void gg_dsmc_channel_cells_free(gg_dsmc_channel_cells *c)
{
  free(c->start_below);
  free(c->next);
  free(c->counted);
  free(c->mean);
  free(c->hits);
  free(c->chi);
  free(c->filled);
  free(c->kernel);
  free(c->majorant);
  free(c->height);
  free(c->most_chi);
}

/* Compute the first index of each cell, and of each part within it, from the counts. */
static void number(gg_dsmc_channel *d)
{
  gg_dsmc_channel_cells *c = &d->cells;
  const size_t species = (size_t)d->model.n_species, bins = (size_t)c->n * species;
  uint32_t at = 0;
  for (size_t b = 0; b < bins; b++) {
    c->start[b] = at;
    for (int part = 0; part < d->parts; part++) {
      uint32_t *next = &c->next[(size_t)part * c->stride + b];
      const uint32_t count = *next;
      *next = at;
      at += count;
    }
  }
  for (size_t b = bins; b <= bins + species; b++) c->start[b] = at;
}

/* Height and velocity of a grain, moved at once. */
typedef double row __attribute__((vector_size(32), may_alias));

GG_CLONES static void move_all(size_t from, size_t end, uint32_t *restrict place, uint32_t *restrict next,
                               const row *restrict at, row *restrict to, const uint32_t *restrict id,
                               uint32_t *restrict id_to)
{
  for (size_t i = from; i < end; i++) {
    const uint32_t k = next[place[i]]++;
    place[i] = k;
    to[k] = at[i];
    id_to[k] = id[i];
  }
}

static void order_part(void *context, int part)
{
  const gg_dsmc_channel *d = context;
  const gg_dsmc_channel_grains from = d->grains, to = d->sorted;
  const size_t first = gg_dsmc_channel_part(d, part), end = gg_dsmc_channel_part(d, part + 1);
  move_all(first, end, d->place, d->cells.next + (size_t)part * d->cells.stride, (const row *)from.at, (row *)to.at,
           from.id, to.id);
  for (size_t i = first; from.s && i < end; i++) to.s[d->place[i]] = from.s[i];
  for (size_t i = first; from.last && i < end; i++) to.last[d->place[i]] = from.last[i];
  for (size_t i = first; d->model.n_species > 1 && i < end; i++) to.species[d->place[i]] = from.species[i];
}

void gg_dsmc_channel_sort(gg_dsmc_channel *d)
{
  number(d);
  gg_base_thread_pool_for(d->pool, d->parts, order_part, d);
  const gg_dsmc_channel_grains from = d->grains;
  d->grains = d->sorted;
  d->sorted = from;
}

/* Mean numbers of a species, with those of the cells beyond both ends: none, or of images in a periodic channel. */
static void extend_mean(const gg_dsmc_channel *d, int species, int beyond, double *mean)
{
  const int n = d->cells.n;
  for (int b = -beyond; b < n + beyond + PLACES; b++) {
    const int image = d->periodic ? (b + 2 * n) % n : b;
    mean[beyond + b] = image >= 0 && image < n ? d->cells.mean[image * d->model.n_species + species] : 0;
  }
}

/* to[a] = sum of kernel[|k|] mean[a + (k + edge)/2] over k from -reach to reach, where k + edge is even. */
GG_CLONES static void spread(int n, int reach, int edge, const double *restrict kernel, const double *restrict mean,
                             double *restrict to)
{
  for (int first = 0; first < n; first += PLACES) {
    double sum[PLACES] = {0};
    for (int k = -reach + (reach + edge) % 2; k <= reach; k += 2)
      for (int a = 0; a < PLACES; a++) sum[a] += kernel[abs(k)] * mean[first + a + (k + edge) / 2];
    memcpy(to + first, sum, (size_t)(n - first < PLACES ? n - first : PLACES) * sizeof *sum);
  }
}

/* Local solid fraction at all places: n in the middles of cells, then n at their upper edges. And the sum of its
 * species' parts over their diameters. */
static void set_filling(gg_dsmc_channel *d)
{
  gg_dsmc_channel_cells *c = &d->cells;
  const int species = d->model.n_species, n = c->n;
  const int beyond = c->reach / 2 + 1;
  double *grains = c->filled + 4 * n, *mean = grains + 2 * n;
  memset(c->filled, 0, 4 * (size_t)n * sizeof *c->filled);
  for (int s = 0; s < species; s++) {
    const double diameter = d->model.diameter[s], *kernel = c->kernel + s * (c->reach + 1);
    extend_mean(d, s, beyond, mean);
    for (int edge = 0; edge < 2; edge++) spread(n, c->reach, edge, kernel, mean + beyond, grains + edge * n);
    for (int place = 0; place < 2 * n; place++) {
      const double part = M_PI / 6 * diameter * diameter * diameter * grains[place] / c->volume;
      c->filled[place] += part, c->filled[2 * n + place] += part / diameter;
    }
  }
}

static void set_most_chi(gg_dsmc_channel_cells *c)
{
  for (int both = 0; both < 2 * c->blocks; both++) {
    double most = 0;
    for (int k = both * c->block; k <= (both + 2) * c->block - 2 && k < 2 * c->n - 1; k++)
      if (c->chi[k + 1] > most) most = c->chi[k + 1];
    c->most_chi[both] = most;
  }
}

double gg_dsmc_channel_set_chi(gg_dsmc_channel *d)
{
  const gg_model *m = &d->model;
  gg_dsmc_channel_cells *c = &d->cells;
  const gg_contact_value kind = m->contact_value;
  /* Mean numbers of a start or of a bed packed by gravity go beyond the densities of contact values. */
  const double most = gg_common_contact_value_limit(m->n_species == 1 ? kind : GG_CARNAHAN_STARLING);
  double beyond = 0;
  if (!m->boltzmann) set_filling(d);
  for (int place = 0; place < 2 * c->n; place++) {
    const double *at = c->filled + place / 2 + place % 2 * c->n;
    double filled = at[0], over_d = at[2 * c->n];
    if (filled > most) {
      over_d *= most / filled, filled = most;
      for (int s = 0; place % 2 == 0 && s < m->n_species; s++) beyond += c->mean[place / 2 * m->n_species + s];
    }
    for (int i = 0; i < m->n_species; i++)
      for (int j = i; j < m->n_species; j++)
        c->chi[gg_pair(i, j) * 2 * c->n + place + 1] =
            m->boltzmann ? 1
            : m->n_species == 1
                ? gg_common_contact_value_of(kind, filled)
                : gg_common_contact_value_mixture(
                      filled, over_d, 2 * m->diameter[i] * m->diameter[j] / (m->diameter[i] + m->diameter[j]));
  }
  set_most_chi(c);
  return beyond;
}

/* Longest step as a fraction of a thermal crossing of the channel, whether grains collide or not. */
#define MOST_OF_CROSSING 0.25

/* Longest step under gravity: a fall across the channel, or the time in which gravity adds so many thermal speeds of a
 * grain that leaves a thermal wall. In a longer flight contacts with walls would accumulate, and a run could not be
 * stopped for minutes. These limits do not depend on the temperature of grains, which in a bed falls with the step
 * (channel_flight.c: SHORTEST_HOP). */
#define MOST_FALL 16

static double longest_fall(const gg_model *m, double g)
{
  double longest = 2 * sqrt(m->box[1] / g), heaviest = 0;
  for (int s = 0; s < m->n_species; s++) heaviest = fmax(heaviest, m->mass[s]);
  for (int w = 0; w < m->n_surfaces; w++)
    if (m->surface[w].accommodation > 0)
      longest = fmin(longest, MOST_FALL * sqrt(m->surface[w].temperature / heaviest) / g);
  return longest;
}

/* Bias of the step as a fraction of the requested error. */
#define FRACTION_OF_ERROR 0.2

double gg_dsmc_channel_free_times(const gg_model *m)
{
  if (m->time_step > 0) return m->time_step;
  const double exact = m->asked_error > 0 ? sqrt(FRACTION_OF_ERROR * m->asked_error / GG_DSMC_CHANNEL_BIAS_OF_STEP) : 1;
  return fmin(exact, GG_DSMC_CHANNEL_FREE_TIMES_PER_STEP);
}

void gg_dsmc_channel_choose_step(gg_dsmc_channel *d)
{
  gg_dsmc_channel_state *s = &d->now;
  const double crossing = d->model.box[1] / sqrt(s->temperature);
  s->step = fmin(gg_dsmc_channel_free_times(&d->model) / s->rate, MOST_OF_CROSSING * crossing);
  const double g2 = gg_dot(d->gravity, d->gravity);
  if (g2 > 0) s->step = fmin(s->step, longest_fall(&d->model, sqrt(g2)));
}

static double temperature_of(const gg_dsmc_channel *d)
{
  double sum = 0;
  for (size_t i = 0; i < (size_t)d->model.n; i++) {
    const gg_vec c = d->grains.at[i].c;
    sum += d->model.mass[d->grains.species[i]] * gg_dot(c, c);
  }
  return sum / (3 * (double)d->model.n);
}

/* Enskog's contact value is that of the present density, so mean numbers are averaged over a thermal flight of a
 * diameter only. A longer average lowers the noise of contact values, but then the pressure responds late to density
 * waves across the channel, and these grow: at phi = 0.3 with 3000 grains, an average over a crossing of 12 diameters
 * raises the shear rate of the core of a Couette flow by 2 %, over four crossings by 5 %. */
void gg_dsmc_channel_measure(gg_dsmc_channel *d)
{
  gg_dsmc_channel_cells *c = &d->cells;
  gg_dsmc_channel_state *s = &d->now;
  const int species = d->model.n_species;
  const double t = s->unmeasured, speed = sqrt(s->temperature), crossing = d->model.box[1] / speed;
  const double weight = t / (t + gg_common_model_widest(&d->model) / speed);
  double hits = 0, squares = 0;
  for (int a = 0; a < c->n; a++) {
    double grains = 0;
    for (int k = a * species; k < (a + 1) * species; k++) {
      grains += c->counted[k] / t;
      c->mean[k] += weight * (c->counted[k] / t - c->mean[k]);
      c->counted[k] = 0;
    }
    hits += c->hits[a];
    if (grains > 0) squares += c->hits[a] * c->hits[a] / (grains * t);
    c->hits[a] = 0;
  }
  s->rate = hits > 0 ? squares / hits : 0.5 * s->rate;
  s->all_rate = 0.5 * hits / t;
  s->temperature = temperature_of(d);
  s->unmeasured = 0;
  gg_dsmc_channel_choose_step(d);
  const double overfilled = gg_dsmc_channel_set_chi(d) / (double)d->model.n;
  s->overfilled += t / (t + crossing) * (overfilled - s->overfilled);
}
