/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells: who is in them, mean numbers, contact values; and the step, from the rate of collisions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/contact_value.h"
#include "dsmc/walls/gap.h"
#include "simd/clones.h"

/* Bias of transport by cells of width w: 0.11 (w/l)^2, l the mean free path (Alexander, Garcia & Alder, Phys. Fluids 10
 * (1998) 1540). */
#define PATHS_PER_CELL 0.15
/* Cells a diameter, to resolve the layers at walls: at the densest, and over phi where these fade. */
#define DIAMETERS_PER_CELL 0.1
#define LAYERS_FADE 0.005
/* At least so many cells across the gap; of an open top, up to so many heights of the box. */
enum { LEAST_CELLS = 20, OPEN_HEIGHTS = 8 };
/* Contact values rise without end towards close packing; mean numbers of a start, or of a bed that gravity packs, go
 * beyond. */
#define MOST_FILLED 0.63

double gg_dsmc_gap_cell_width(const gg_model *m)
{
  double path = 1 / (sqrt(2) * M_PI * m->density * m->chi[0]);
  double width = fmin(PATHS_PER_CELL * path, m->box[1] / LEAST_CELLS);
  return m->boltzmann ? width : fmin(width, fmax(DIAMETERS_PER_CELL, LAYERS_FADE / m->phi));
}

/* Integral of the cross-section pi (R^2 - z^2) of a grain up to z, over all of it. */
static double share_below(double radius, double z)
{
  const double u = fmin(fmax(z / radius, -1), 1);
  return 0.25 * (2 + 3 * u - u * u * u);
}

/* Fischer & Methfessel, Phys. Rev. A 22 (1980) 2836: the contact value is that of the density averaged over a sphere
 * about the point of contact; that is the share of the volume that grains fill there. */
static void set_kernels(gg_dsmc_gap *d)
{
  gg_dsmc_gap_cells *c = &d->cells;
  for (int s = 0; s < d->model.n_species; s++)
    for (int k = 0; k <= c->reach; k++) { /* places are half cells away */
      const double z = 0.5 * k * c->width, radius = 0.5 * d->model.diameter[s];
      c->kernel[s * (c->reach + 1) + k] =
          share_below(radius, z + 0.5 * c->width) - share_below(radius, z - 0.5 * c->width);
    }
}

static double lowest(const gg_dsmc_gap *d)
{
  double low = d->low[0];
  for (int s = 1; s < d->model.n_species; s++) low = fmin(low, d->low[s]);
  return low;
}

static double highest(const gg_dsmc_gap *d)
{
  if (gg_common_surface_is_open_above(&d->model)) return OPEN_HEIGHTS * d->model.box[1];
  double high = d->high[0];
  for (int s = 1; s < d->model.n_species; s++) high = fmax(high, d->high[s]);
  return high;
}

/* A slab reaches beyond its ends as far as partners are, roundings included. */
static gg_status partition(gg_dsmc_gap *d, gg_error *err)
{
  const gg_dsmc_gap_cells *c = &d->cells;
  const int64_t bins = (int64_t)c->n * d->model.n_species, n = d->model.n;
  double reach = 0;
  for (int p = 0; p < gg_pairs_of(d->model.n_species); p++) reach = fmax(reach, d->reach[p] * c->inverse);
  d->parts = (int)fmin(GG_GAP_MOST_PARTS, fmax(1, (double)(n / (16 * bins))));
  d->slabs = (int)fmin(GG_GAP_MOST_SLABS, floor(c->n / (2 * (ceil(reach) + 1)) / 2) * 2);
  if (n < GG_GAP_LEAST_SHARED) d->parts = 1;
  if (n < GG_GAP_LEAST_SHARED || d->slabs < 4) d->slabs = 1;
  const size_t bytes = (size_t)d->slabs * sizeof *d->slab;
  if (!(d->slab = aligned_alloc(64, bytes))) return gg_base_out_of_memory(err);
  memset(d->slab, 0, bytes);
  for (int k = 0; k < d->slabs; k++) {
    d->slab[k].first = (int)((int64_t)c->n * k / d->slabs);
    d->slab[k].end = (int)((int64_t)c->n * (k + 1) / d->slabs);
  }
  return GG_OK;
}

gg_status gg_dsmc_gap_cells_new(gg_dsmc_gap *d, gg_error *err)
{
  const gg_model *m = &d->model;
  gg_dsmc_gap_cells *c = &d->cells;
  const size_t species = (size_t)m->n_species, pairs = (size_t)gg_pairs_of(m->n_species);
  c->from = lowest(d);
  const double gap = highest(d) - c->from;
  c->n = (int)fmin(ceil(gap / gg_dsmc_gap_cell_width(m) * (1 - 1e-12)), 1e7);
  c->width = gap / c->n;
  c->inverse = c->n / gap;
  c->volume = m->box[0] * m->box[2] * c->width;
  c->reach = (int)fmin(1 + ceil(gg_common_model_widest(m) * c->inverse), 2 * c->n);
  const size_t n = (size_t)c->n;
  c->start_below = gg_base_array_new((n + 2) * species + 1, sizeof *c->start, err);
  c->counted = gg_base_array_new(n * species, sizeof *c->counted, err);
  c->mean = gg_base_array_new(n * species, sizeof *c->mean, err);
  c->hits = gg_base_array_new(n, sizeof *c->hits, err);
  c->chi = gg_base_array_new(pairs * 2 * n + 2, sizeof *c->chi, err);
  c->kernel = gg_base_array_new(species * (size_t)(c->reach + 1), sizeof *c->kernel, err);
  c->majorant = gg_base_array_new(n * species * species, sizeof *c->majorant, err);
  GG_TRY(partition(d, err));
  c->stride = (n * species + 15) / 16 * 16;
  c->next = gg_base_array_new((size_t)d->parts * c->stride, sizeof *c->next, err);
  if (!c->start_below || !c->next || !c->counted || !c->mean || !c->hits || !c->chi || !c->kernel || !c->majorant)
    return GG_FAILED;
  c->start = c->start_below + species;
  set_kernels(d);
  return GG_OK;
}

void gg_dsmc_gap_cells_free(gg_dsmc_gap_cells *c)
{
  free(c->start_below);
  free(c->next);
  free(c->counted);
  free(c->mean);
  free(c->hits);
  free(c->chi);
  free(c->kernel);
  free(c->majorant);
}

/* Where the grains of each part go in each cell. */
static void number(gg_dsmc_gap *d)
{
  gg_dsmc_gap_cells *c = &d->cells;
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

/* A height and a velocity are moved at once. */
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
  const gg_dsmc_gap *d = context;
  const gg_dsmc_gap_grains from = d->grains, to = d->sorted;
  const size_t first = gg_dsmc_gap_part(d, part), end = gg_dsmc_gap_part(d, part + 1);
  move_all(first, end, d->place, d->cells.next + (size_t)part * d->cells.stride, (const row *)from.at, (row *)to.at,
           from.id, to.id);
  for (size_t i = first; from.s && i < end; i++) to.s[d->place[i]] = from.s[i];
  for (size_t i = first; from.last && i < end; i++) to.last[d->place[i]] = from.last[i];
  for (size_t i = first; d->model.n_species > 1 && i < end; i++) to.species[d->place[i]] = from.species[i];
}

void gg_dsmc_gap_sort(gg_dsmc_gap *d)
{
  number(d);
  gg_base_thread_pool_for(d->pool, d->parts, order_part, d);
  const gg_dsmc_gap_grains from = d->grains;
  d->grains = d->sorted;
  d->sorted = from;
}

/* Grains fill a share `filled` of the place, and of each species' share 1/d. */
static void filling_at(const gg_dsmc_gap *d, int place, double *filled, double *over_d)
{
  const gg_dsmc_gap_cells *c = &d->cells;
  const int species = d->model.n_species;
  *filled = *over_d = 0;
  for (int s = 0; s < species; s++) {
    const double diameter = d->model.diameter[s], *kernel = c->kernel + s * (c->reach + 1);
    double grains = 0;
    for (int b = (place - c->reach + 1) / 2 > 0 ? (place - c->reach + 1) / 2 : 0; b < c->n && 2 * b <= place + c->reach;
         b++)
      grains += c->mean[b * species + s] * kernel[abs(place - 2 * b)];
    const double share = M_PI / 6 * diameter * diameter * diameter * grains / c->volume;
    *filled += share, *over_d += share / diameter;
  }
}

double gg_dsmc_gap_set_chi(gg_dsmc_gap *d)
{
  const gg_model *m = &d->model;
  gg_dsmc_gap_cells *c = &d->cells;
  const gg_contact_value kind = m->contact_value;
  double beyond = 0;
  for (int place = 0; place < 2 * c->n; place++) {
    double filled = 0, over_d = 0;
    if (!m->boltzmann) filling_at(d, place, &filled, &over_d);
    if (filled > MOST_FILLED) {
      over_d *= MOST_FILLED / filled, filled = MOST_FILLED;
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
  return beyond;
}

/* Longer than this share of a thermal crossing of the gap no step is, whether grains collide or not. */
#define MOST_OF_CROSSING 0.25

/* Nor longer than gravity takes across the gap, or for so many thermal speeds of a grain that leaves a thermal wall:
 * else a flight cuts contacts with walls without end, and a run could not be stopped for minutes. Neither depends on
 * the temperature of grains, which in a bed falls with the step (gap_flight.c: the shortest hop). */
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

/* A run that asks for an error takes steps whose bias is so small a share of it. */
#define SHARE_OF_ERROR 0.2

double gg_dsmc_gap_free_times(const gg_model *m)
{
  if (m->time_step > 0) return m->time_step;
  const double exact = m->asked_error > 0 ? sqrt(SHARE_OF_ERROR * m->asked_error / GG_GAP_BIAS_OF_STEP) : 1;
  return fmin(exact, GG_GAP_FREE_TIMES_PER_STEP);
}

void gg_dsmc_gap_choose_step(gg_dsmc_gap *d)
{
  gg_dsmc_gap_state *s = &d->now;
  const double crossing = d->model.box[1] / sqrt(s->temperature);
  s->step = fmin(gg_dsmc_gap_free_times(&d->model) / s->rate, MOST_OF_CROSSING * crossing);
  const double g2 = gg_dot(d->gravity, d->gravity);
  if (g2 > 0) s->step = fmin(s->step, longest_fall(&d->model, sqrt(g2)));
}

static double temperature_of(const gg_dsmc_gap *d)
{
  double sum = 0;
  for (size_t i = 0; i < (size_t)d->model.n; i++) {
    const gg_vec c = d->grains.at[i].c;
    sum += d->model.mass[d->grains.species[i]] * gg_dot(c, c);
  }
  return sum / (3 * (double)d->model.n);
}

/* Enskog's contact value is that of the present density, so mean numbers forget within a thermal flight of a diameter.
 * A longer memory lowers noise of contact values, but then the pressure answers late to waves of density across the
 * gap, and these grow: at phi = 0.3 with 3000 grains, a memory of a crossing of 12 diameters raises the shear rate of
 * the core of a Couette flow by 2 %, one of four crossings by 5 %. */
void gg_dsmc_gap_measure(gg_dsmc_gap *d)
{
  gg_dsmc_gap_cells *c = &d->cells;
  gg_dsmc_gap_state *s = &d->now;
  const int species = d->model.n_species;
  const double t = s->unmeasured, speed = sqrt(s->temperature), crossing = d->model.box[1] / speed;
  const double share = t / (t + gg_common_model_widest(&d->model) / speed);
  double hits = 0, squares = 0;
  for (int a = 0; a < c->n; a++) {
    double grains = 0;
    for (int k = a * species; k < (a + 1) * species; k++) {
      grains += c->counted[k] / t;
      c->mean[k] += share * (c->counted[k] / t - c->mean[k]);
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
  gg_dsmc_gap_choose_step(d);
  const double overfilled = gg_dsmc_gap_set_chi(d) / (double)d->model.n;
  s->overfilled += t / (t + crossing) * (overfilled - s->overfilled);
}
