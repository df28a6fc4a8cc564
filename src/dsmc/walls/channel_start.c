/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of an engine in a channel, and its initial state. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/shear_wave.h"
#include "dsmc/ensemble.h"
#include "dsmc/walls/channel.h"

/* Allocate n grains and one more, so that a cell after the last grain can be read. None crosses a cache line. */
static gg_dsmc_channel_motion *new_motion(size_t n, gg_error *err)
{
  const size_t bytes = ((n + 1) * sizeof(gg_dsmc_channel_motion) + 63) / 64 * 64;
  gg_dsmc_channel_motion *at = aligned_alloc(64, bytes);
  if (at) return memset(at, 0, bytes);
  gg_base_out_of_memory(err);
  return NULL;
}

static gg_status allocate_grains(gg_dsmc_channel_grains *g, size_t n, bool spins, gg_error *err)
{
  g->at = new_motion(n, err);
  if (spins) g->s = gg_base_array_new(n, sizeof *g->s, err);
  g->id = gg_base_array_new(n, sizeof *g->id, err);
  g->species = gg_base_array_new(n, sizeof *g->species, err);
  return g->at && (g->s || !spins) && g->id && g->species ? GG_OK : GG_FAILED;
}

static void free_grains(gg_dsmc_channel_grains *g)
{
  free(g->at);
  free(g->s);
  free(g->last);
  free(g->id);
  free(g->species);
}

/* Set the range of heights of centres, and the contact distances. */
static void set_heights(gg_dsmc_channel *d)
{
  const gg_model *m = &d->model;
  const gg_surface *lower = gg_surface_at(m, 1, -1), *upper = gg_surface_at(m, 1, 1);
  for (int s = 0; s < m->n_species; s++) {
    d->radius[s] = m->boltzmann ? 0 : 0.5 * m->diameter[s];
    d->low[s] = d->periodic ? 0 : lower->place + d->radius[s];
    d->high[s] = d->periodic ? m->box[1] : upper ? upper->place - d->radius[s] : INFINITY;
  }
  for (int p = 0; p < gg_pairs_of(m->n_species); p++) d->reach[p] = m->boltzmann ? 0 : m->sigma[p];
}

#define COLLIDE(set, name) [set] = gg_dsmc_channel_collide_##name,
gg_dsmc_channel_collide *const gg_dsmc_channel_collide_of[GG_INSTRUCTION_SETS] = {GG_EACH_COMPILED_SET(COLLIDE)};

gg_status gg_dsmc_channel_allocate(const gg_model *model, gg_dsmc_channel **made, gg_error *err)
{
  GG_TRY(gg_simd_instructions_check(err));
  gg_dsmc_channel *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return GG_FAILED;
  d->collide = gg_dsmc_channel_collide_of[gg_simd_instructions_best()];
  d->model = *model;
  d->gravity = (gg_vec){model->gravity[0], model->gravity[1], model->gravity[2]};
  const bool spins = model->rule != GG_SMOOTH;
  d->wall_rule = spins ? model->rule : model->wall_rule;
  d->periodic = model->wave > 0;
  d->heated = d->periodic && gg_dsmc_channel_is_heated(model);
  set_heights(d);
  const size_t n = (size_t)model->n;
  gg_status status = allocate_grains(&d->grains, n, spins, err);
  if (status == GG_OK) status = allocate_grains(&d->sorted, n, spins, err);
  if (status == GG_OK && !(d->place = gg_base_array_new(n, sizeof *d->place, err))) status = GG_FAILED;
  if (status == GG_OK) status = gg_dsmc_channel_cells_new(d, err);
  if (status == GG_OK) status = gg_common_coefficient_tables_new(model, &d->tables, err);
  if (status != GG_OK) {
    gg_dsmc_channel_destroy(&d->base);
    return status;
  }
  *made = d;
  return GG_OK;
}

gg_status gg_dsmc_channel_allocate_last(gg_dsmc_channel *d, gg_error *err)
{
  const size_t n = (size_t)d->model.n;
  double **last = &d->grains.last, **room = &d->sorted.last;
  if (*last) return GG_OK;
  *room = gg_base_array_new(n, sizeof **room, err);
  if (*room) *last = gg_base_array_new(n, sizeof **last, err);
  if (!*last) {
    free(*room);
    *room = NULL;
    return GG_FAILED;
  }
  for (size_t i = 0; i < n; i++) (*last)[i] = -INFINITY;
  return GG_OK;
}

void gg_dsmc_channel_destroy(gg_engine *engine)
{
  gg_dsmc_channel *d = (gg_dsmc_channel *)engine;
  if (!d) return;
  free_grains(&d->grains);
  free_grains(&d->sorted);
  free(d->place);
  gg_dsmc_channel_cells_free(&d->cells);
  gg_base_thread_pool_free(d->pool);
  free(d->slab);
  gg_common_coefficient_tables_free(d->tables);
  free(d);
}

/* Place grains uniformly from wall to wall; under an open top up to the height of the box. */
static void place_grains(gg_dsmc_channel *d, gg_rng *rng)
{
  size_t i = 0;
  for (int s = 0; s < d->model.n_species; s++)
    for (int64_t k = 0; k < d->model.n_of[s]; k++, i++) {
      d->grains.id[i] = (uint32_t)i;
      d->grains.species[i] = (uint8_t)s;
      d->grains.at[i].y = d->low[s] + gg_rng_uniform(rng) * (fmin(d->high[s], d->model.box[1]) - d->low[s]);
    }
}

static gg_vec *motion_of(gg_dsmc_channel_grains *g, bool spin, size_t i)
{
  return spin ? &g->s[i] : &g->at[i].c;
}

/* Draw Gaussian velocities or spins with energy exactly 3 N T/2; the total momentum is zero. `weight` of a species:
 * mass, or moment of inertia. */
static gg_status set_motion(gg_dsmc_channel *d, bool spin, const double *weight, double T, gg_rng *rng, gg_error *err)
{
  const size_t n = (size_t)d->model.n;
  gg_vec momentum = {0, 0, 0};
  double all = 0, energy = 0;
  for (size_t i = 0; i < n; i++) {
    if (gg_dsmc_start_is_stopped(&d->model, i)) return gg_base_fail(err, GG_INTERRUPTED, "dsmc: stopped at the start");
    const double w = weight[d->grains.species[i]];
    gg_vec *v = motion_of(&d->grains, spin, i);
    *v = gg_scale(sqrt(T / w), gg_common_rng_normal_vec(rng));
    momentum = gg_axpy(w, *v, momentum);
    all += w;
  }
  for (size_t i = 0; i < n; i++) {
    gg_vec *v = motion_of(&d->grains, spin, i);
    if (!spin) *v = gg_axpy(-1 / all, momentum, *v);
    energy += weight[d->grains.species[i]] * gg_dot(*v, *v);
  }
  const double scale = energy > 0 ? sqrt(3 * (double)n * T / energy) : 0;
  for (size_t i = 0; i < n; i++) *motion_of(&d->grains, spin, i) = gg_scale(scale, *motion_of(&d->grains, spin, i));
  return GG_OK;
}

/* Add the laminar profile between moving walls. */
static void add_flow(gg_dsmc_channel *d)
{
  const gg_surface *lower = gg_surface_at(&d->model, 1, -1), *upper = gg_surface_at(&d->model, 1, 1);
  if (!upper) return;
  const double rate = (upper->velocity.x - lower->velocity.x) / d->model.box[1];
  for (size_t i = 0; i < (size_t)d->model.n; i++)
    d->grains.at[i].c.x += rate * (d->grains.at[i].y - 0.5 * d->model.box[1]);
}

static void add_wave(gg_dsmc_channel *d)
{
  const gg_model *m = &d->model;
  gg_wave_sums sums = {0};
  for (size_t i = 0; i < (size_t)m->n; i++) {
    const gg_dsmc_channel_motion *at = &d->grains.at[i];
    gg_wave_add(&sums, m->mass[d->grains.species[i]], gg_wave_profile(m, at->y), at->c.x);
  }
  for (size_t i = 0; i < (size_t)m->n; i++)
    d->grains.at[i].c.x += gg_wave_start(m, &sums, gg_wave_profile(m, d->grains.at[i].y));
}

static gg_status take_grains(gg_dsmc_channel *d, const gg_grain_arrays *given, gg_error *err)
{
  gg_dsmc_channel_grains *g = &d->grains;
  for (size_t i = 0; i < (size_t)d->model.n; i++) {
    if (given->species) g->species[i] = (uint8_t)given->species[i];
    const int s = g->species[i];
    gg_dsmc_channel_motion *at = &g->at[i];
    if (given->r) at->y = given->r[3 * i + 1];
    if (!(at->y >= d->low[s] - 1e-9 && at->y <= d->high[s] + 1e-9))
      return gg_base_fail(err, GG_BAD_INPUT, "grain %zu overlaps the %s wall by %g d", i,
                          at->y < d->low[s] ? "lower" : "upper", fmax(d->low[s] - at->y, at->y - d->high[s]));
    at->y = fmin(fmax(at->y, d->low[s]), d->high[s]);
    if (given->c) at->c = (gg_vec){given->c[3 * i], given->c[3 * i + 1], given->c[3 * i + 2]};
    if (given->s && g->s) g->s[i] = (gg_vec){given->s[3 * i], given->s[3 * i + 1], given->s[3 * i + 2]};
  }
  return GG_OK;
}

/* Set values for the first steps: mean numbers of a uniform gas, rates of Enskog's theory, safe majorants. */
static void begin(gg_dsmc_channel *d)
{
  gg_dsmc_channel_state *s = &d->now;
  gg_dsmc_channel_cells *c = &d->cells;
  const int species = d->model.n_species;
  double fastest = 0, energy = 0, most = 0, chi = 0;
  for (size_t i = 0; i < (size_t)d->model.n; i++) {
    const gg_vec v = d->grains.at[i].c;
    if (gg_dot(v, v) > fastest) fastest = gg_dot(v, v); /* gcc 12 for ARM fails to compile a reduction by fmax */
    energy += d->model.mass[d->grains.species[i]] * gg_dot(v, v);
  }
  s->temperature = energy / (3 * (double)d->model.n);
  d->kept = 0.5 * energy;
  s->rate = gg_common_model_collision_rate(&d->model, s->temperature);
  s->all_rate = 0.5 * (double)d->model.n * s->rate;
  gg_dsmc_channel_choose_step(d);
  gg_dsmc_channel_fly(d, 0);
  gg_dsmc_channel_sort(d);
  for (int k = 0; k < c->n * species; k++) {
    const int cell = k / species, of = k % species;
    const double from = fmax(c->from + cell * c->width, d->low[of]),
                 to = fmin(c->from + (cell + 1) * c->width, fmin(d->high[of], d->model.box[1]));
    c->mean[k] = (double)d->model.n_of[of] * fmax(to - from, 0) / (fmin(d->high[of], d->model.box[1]) - d->low[of]);
    if (c->start[k + 1] - c->start[k] > most) most = c->start[k + 1] - c->start[k];
  }
  gg_dsmc_channel_set_chi(d);
  for (int k = 0; k < gg_pairs_of(species) * 2 * c->n; k++)
    if (c->chi[k + 1] > chi) chi = c->chi[k + 1];
  const double scale = c->block > 0 ? 1 : chi * most;
  for (int k = 0; k < c->n * species * species; k++)
    gg_dsmc_majorant_start(&c->majorant[k], 2 * sqrt(fastest) * scale, sqrt(s->temperature));
}

static void seed_streams(gg_dsmc_channel_streams *s, uint64_t seed, uint64_t next)
{
  for (int k = 0; k < GG_DSMC_CHANNEL_MOST_PARTS; k++) s->walls[k] = gg_common_rng_seed(seed, next++);
  for (int k = 0; k < GG_DSMC_CHANNEL_MOST_SLABS; k++, next += GG_DSMC_LANES) {
    s->cells[k] = gg_common_rng_seed(seed, next++);
    gg_dsmc_rng_lanes_seed(&s->lanes[k], seed, next);
  }
}

gg_status gg_dsmc_channel_start(gg_dsmc_channel *d, uint64_t seed, uint64_t stream, const gg_grain_arrays *given,
                                gg_error *err)
{
  gg_rng rng = gg_common_rng_seed(seed, stream + GG_STREAM_START);
  const gg_model *m = &d->model;
  double inertia[GG_MAX_SPECIES];
  for (int i = 0; i < m->n_species; i++) inertia[i] = m->inertia[i] * m->mass[i];
  seed_streams(&d->now.streams, seed, stream + GG_STREAM_SEGMENTS);
  place_grains(d, &rng);
  GG_TRY(set_motion(d, false, m->mass, m->temperature0, &rng, err));
  add_flow(d);
  if (d->periodic) add_wave(d);
  if (d->grains.s) GG_TRY(set_motion(d, true, inertia, m->ratio0 * m->temperature0, &rng, err));
  if (given) GG_TRY(take_grains(d, given, err));
  begin(d);
  if (!(d->now.temperature > 0 && d->now.temperature < 1e300))
    return gg_base_fail(err, GG_BAD_INPUT, "dsmc: grains at rest, or too fast to compute with");
  return GG_OK;
}
