/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine behind the interface that all engines share. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/thread_pool.h"
#include "dsmc/dsmc.h"
#include "dsmc/walls/channel.h"
#include "simd/clones.h"

static gg_dsmc *dsmc_of(gg_engine *engine)
{
  return (gg_dsmc *)engine;
}
static const gg_dsmc *const_dsmc_of(const gg_engine *engine)
{
  return (const gg_dsmc *)engine;
}

/* Work of a step by itself, in candidates. */
enum { WORK_OF_A_STEP = 32 };

/* Work of the present step: its candidates, and all grains that a thermostat heats. */
static uint64_t work_of_step(const gg_dsmc *d, uint64_t candidates_before)
{
  const uint64_t heated = d->heat != GG_UNHEATED || d->model.turns ? (uint64_t)d->model.n : 0;
  return WORK_OF_A_STEP + (d->now.candidates - candidates_before) + heated;
}

static gg_status check_temperature(const gg_dsmc *d, gg_error *err)
{
  const double largest = d->model.single ? 0x1p60 : 0x1p900; /* the square of such a temperature is finite, too */
  return gg_dsmc_check_temperature(&d->model, d->now.temperature, 1 / largest, largest, d->now.collisions, err);
}

static gg_status go_on(gg_engine *engine, double *elapsed, gg_error *err)
{
  gg_dsmc *d = dsmc_of(engine);
  gg_dsmc_state *s = &d->now;
  bool stopped = false;
  for (uint64_t work = 0; !stopped && !gg_dsmc_advance_is_over(&s->advance, s->collisions);) {
    uint64_t before = s->candidates;
    GG_TRY(check_temperature(d, err));
    s->advance.gone +=
        gg_dsmc_step(d, s->advance.asked - s->advance.gone, (double)(s->advance.last_collision - s->collisions));
    stopped = gg_dsmc_advance_is_stopped(&d->model, &work, work_of_step(d, before));
  }
  *elapsed = s->advance.gone;
  return stopped ? gg_base_fail(err, GG_INTERRUPTED, "dsmc: stopped") : GG_OK;
}

static gg_status advance(gg_engine *engine, double dt, uint64_t max_collisions, double *elapsed, gg_error *err)
{
  gg_dsmc_state *s = &dsmc_of(engine)->now;
  double unused;
  gg_dsmc_advance_begin(&s->advance, dt, max_collisions, s->collisions);
  return go_on(engine, elapsed ? elapsed : &unused, err);
}

static gg_status create(const gg_model *model, uint64_t seed, uint64_t stream, gg_engine **engine, gg_error *err)
{
  if (gg_dsmc_channel_has(model)) return gg_dsmc_channel_ops.create(model, seed, stream, engine, err);
  GG_TRY(gg_dsmc_accepts(model, err));
  gg_dsmc *d;
  GG_TRY(gg_dsmc_allocate(model, &d, err));
  d->base.ops = &gg_dsmc_ops;
  if (d->schedule) gg_dsmc_schedule_start(d->schedule, seed, stream);
  gg_rng start = gg_common_rng_seed(seed, stream + GG_STREAM_START);
  if (!gg_dsmc_ensemble_start(model, &d->ensemble, &start)) {
    gg_dsmc_destroy(&d->base);
    return gg_base_fail(err, GG_INTERRUPTED, "dsmc: stopped at the start");
  }
  d->now.rng = gg_common_rng_seed(seed, stream + GG_STREAM_ENGINE);
  gg_dsmc_rng_lanes_seed(&d->now.lanes, seed, stream + GG_STREAM_LANES);
  gg_dsmc_synchronise(d);
  gg_dsmc_start_majorants(d);
  d->now.kept = 1.5 * (double)model->n * model->temperature0;
  *engine = &d->base;
  return GG_OK;
}

/* Take given grains: those of each species in the order of their numbers. */
static void take_grains(gg_dsmc_ensemble *e, const gg_grain_arrays *grains, int64_t n)
{
  uint32_t next[GG_MAX_SPECIES] = {0};
  for (size_t i = 0; i < (size_t)n; i++) {
    const int species = grains->species ? grains->species[i] : 0;
    gg_dsmc_population *p = &e->of[species];
    const uint32_t at = next[species]++;
    const double *c = grains->c ? grains->c + 3 * i : NULL, *s = grains->s ? grains->s + 3 * i : NULL;
    if (c) gg_dsmc_block_set(p, p->c, at, (gg_vec){c[0], c[1], c[2]});
    if (s && p->s) gg_dsmc_block_set(p, p->s, at, (gg_vec){s[0], s[1], s[2]});
  }
}

static void take_over(gg_dsmc *d, const gg_dsmc *before)
{
  const gg_dsmc_state *b = &before->now;
  gg_dsmc_state *s = &d->now;
  s->rng = b->rng;
  s->lanes = b->lanes;
  s->time = b->time;
  s->collisions = b->collisions;
  s->candidates = b->candidates;
  s->overflows = b->overflows;
  s->clamped = b->clamped;
  s->power = b->power;
  if (d->schedule && before->schedule) memcpy(d->schedule, before->schedule, gg_dsmc_schedule_size(d->model.n_species));
}

/* Measure given grains. The first synchronisation measures the temperature, which scales the bounds of the next one,
 * and the velocity of the centre of mass, which the next one removes unless it is of the order of rounding: velocities
 * that come from a run stay unchanged. */
static void measure(gg_dsmc *d)
{
  const gg_vec none = {0, 0, 0};
  d->now.temperature = 0;
  d->now.centre = none;
  gg_dsmc_synchronise(d);
  if (gg_dot(d->now.centre, d->now.centre) <= 1e-18 * d->now.temperature) d->now.centre = none;
  gg_dsmc_synchronise(d);
}

static gg_status create_with(const gg_model *model, uint64_t seed, uint64_t stream, const gg_grain_arrays *grains,
                             const gg_engine *before, gg_engine **engine, gg_error *err)
{
  if (gg_dsmc_channel_has(model))
    return gg_dsmc_channel_ops.create_with(model, seed, stream, grains, before, engine, err);
  GG_TRY(create(model, seed, stream, engine, err));
  gg_dsmc *d = dsmc_of(*engine);
  take_grains(&d->ensemble, grains, model->n);
  measure(d);
  if (before) take_over(d, const_dsmc_of(before));
  const gg_status status = check_temperature(d, err);
  if (status != GG_OK) {
    gg_dsmc_destroy(*engine);
    *engine = NULL;
    return gg_base_fail(err, GG_BAD_INPUT, "dsmc: grains at rest, or too fast to compute with");
  }
  gg_dsmc_start_majorants(d);
  d->now.kept = 1.5 * (double)model->n * d->now.temperature;
  return GG_OK;
}

static void take_sums(gg_engine *engine, gg_collision_sums *transfer)
{
  gg_dsmc_state *s = &dsmc_of(engine)->now;
  *transfer = s->transfer;
  s->transfer = (gg_collision_sums){0};
}

/* More threads than pairs of segments in a round would be idle. */
static void threads(gg_engine *engine, int threads)
{
  gg_dsmc_ensemble *e = &dsmc_of(engine)->ensemble;
  gg_base_thread_pool_free(e->pool);
  e->pool = e->segments > 1 ? gg_base_thread_pool_new(threads < e->segments / 2 ? threads : e->segments / 2) : NULL;
}

static void state(const gg_engine *engine, gg_engine_state *state)
{
  const gg_dsmc_state *s = &const_dsmc_of(engine)->now;
  *state = (gg_engine_state){.time = s->time,
                             .collisions = s->collisions,
                             .events = s->candidates,
                             .overflows = s->overflows,
                             .clamped = s->clamped,
                             .time_step = s->step.splitting,
                             .time_step_bias = s->step.bias,
                             .others_cpu = gg_base_thread_pool_cpu(const_dsmc_of(engine)->ensemble.pool)};
}

/* Convert a run of blocks to flat arrays of peculiar velocities; the arrays have room for whole blocks. */
GG_CLONES static void unpack(const gg_dsmc_block *b, size_t n, double strain, double *restrict x, double *restrict y,
                             double *restrict z)
{
  for (size_t i = 0; i < n; i += GG_DSMC_LANES, b++)
    for (size_t l = 0; l < GG_DSMC_LANES; l++) {
      x[i + l] = b->x[l] - strain * b->y[l];
      y[i + l] = b->y[l];
      z[i + l] = b->z[l];
    }
}

enum { SHOWN = 256 }; /* grains of a chunk: they stay in the first cache until they have been sampled */

/* Convert `n` grains from `first`, a multiple of eight, of p->c or p->s. */
static void lay_out(const gg_dsmc_population *p, const void *blocks, size_t first, size_t n, double strain,
                    double v[3][SHOWN])
{
  gg_dsmc_block room[SHOWN / GG_DSMC_LANES];
  const gg_dsmc_block *b =
      gg_dsmc_blocks_in_double(p, blocks, first / GG_DSMC_LANES, (n + GG_DSMC_LANES - 1) / GG_DSMC_LANES, room);
  unpack(b, n, strain, v[0], v[1], v[2]);
}

static void snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context)
{
  (void)positions; /* a homogeneous gas has no positions */
  gg_dsmc *d = dsmc_of(engine);
  double v[6][SHOWN];
  uint8_t kind[SHOWN];
  for (int i = 0; i < d->ensemble.n_species; i++) {
    const gg_dsmc_population *p = &d->ensemble.of[i];
    memset(kind, i, sizeof kind);
    for (size_t first = 0; first < (size_t)p->n; first += SHOWN) {
      size_t left = (size_t)p->n - first;
      gg_chunk chunk = {.n = left < SHOWN ? left : SHOWN, .c = {v[0], v[1], v[2]}};
      lay_out(p, p->c, first, chunk.n, d->now.strain, v);
      if (p->s) {
        lay_out(p, p->s, first, chunk.n, 0, v + 3);
        for (int a = 0; a < 3; a++) chunk.s[a] = v[3 + a];
      }
      if (d->ensemble.n_species > 1) chunk.species = kind;
      visit(context, &chunk);
    }
  }
}

/* Visit blocks: in double all at once in place, in single precision in chunks. */
static void blocks(gg_engine *engine, gg_visit_blocks *visit, void *context)
{
  gg_dsmc *d = dsmc_of(engine);
  gg_dsmc_block c[SHOWN / GG_DSMC_LANES], s[SHOWN / GG_DSMC_LANES];
  for (int i = 0; i < d->ensemble.n_species; i++) {
    const gg_dsmc_population *p = &d->ensemble.of[i];
    const size_t all = (size_t)p->n, most = p->single ? SHOWN : all;
    for (size_t first = 0; first < all; first += most) {
      gg_block_run run = {.n = all - first < most ? all - first : most, .species = i, .strain = d->now.strain};
      const size_t at = first / GG_DSMC_LANES, n = (run.n + GG_DSMC_LANES - 1) / GG_DSMC_LANES;
      run.c = gg_dsmc_blocks_in_double(p, p->c, at, n, c)->x;
      if (p->s) run.s = gg_dsmc_blocks_in_double(p, p->s, at, n, s)->x;
      visit(context, &run);
    }
  }
}

static gg_status rescale(gg_engine *engine, int power, gg_error *err)
{
  gg_dsmc *d = dsmc_of(engine);
  const bool next_sweep = d->model.linear_response; /* of the reduced shear rate; the clock continues */
  if ((d->heat != GG_UNHEATED || d->model.turns) && !next_sweep)
    return gg_base_fail(err, GG_BAD_INPUT, "a heated gas cannot be rescaled: it keeps its temperature");
  if (d->model.shear_rate != 0 && !next_sweep)
    return gg_base_fail(err, GG_BAD_INPUT, "a sheared gas cannot be rescaled: its shear rate sets the unit of time");
  if (power < -1000 || power > 1000) return gg_base_fail(err, GG_BAD_INPUT, "rescaling by 2^%d is out of range", power);
  double factor = ldexp(1, power);
  d->now.power += power;
  gg_dsmc_ensemble_scale(&d->ensemble, factor);
  gg_dsmc_rescale_callback(d, factor, next_sweep ? d->now.time : 0);
  if (!next_sweep) {
    d->now.time /= factor;
    d->now.unsynchronised /= factor;
  }
  d->now.lost *= factor * factor;
  d->now.fastest *= factor;
  d->now.centre = gg_scale(factor, d->now.centre);
  d->now.temperature *= factor * factor;
  d->now.step = gg_dsmc_time_step_choose(&d->model, d->now.temperature);
  for (int p = 0; p < gg_pairs_of(d->model.n_species); p++)
    d->now.transfer.loss[p] *= factor * factor, d->now.transfer.given[p] *= factor * factor;
  return GG_OK;
}

/* Majorants go on: a larger rate raises them, as every relative velocity does that exceeds them. */
static gg_status shear(gg_engine *engine, double rate, gg_error *err)
{
  gg_dsmc *d = dsmc_of(engine);
  if (!gg_model_is_sheared(&d->model)) return gg_base_fail(err, GG_BAD_INPUT, "dsmc: this flow is not sheared");
  d->model.shear_rate = rate;
  gg_dsmc_synchronise(d);
  return GG_OK;
}

static gg_status accepts(const gg_model *model, gg_error *err)
{
  return (gg_dsmc_channel_has(model) ? gg_dsmc_channel_accepts : gg_dsmc_accepts)(model, err);
}

static double bytes(const gg_model *model)
{
  return (gg_dsmc_channel_has(model) ? gg_dsmc_channel_bytes : gg_dsmc_bytes)(model);
}

static gg_status restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  if (gg_dsmc_channel_has(model)) return gg_dsmc_channel_ops.restore(model, archive, engine, err);
  GG_TRY(gg_dsmc_restore(model, archive, engine, err));
  (*engine)->ops = &gg_dsmc_ops;
  return GG_OK;
}

static void describe(const gg_model *model, void (*line)(void *context, const char *text), void *context)
{
  (gg_dsmc_channel_has(model) ? gg_dsmc_channel_describe : gg_dsmc_describe)(model, line, context);
}

const gg_engine_ops gg_dsmc_ops = {
    .name = "dsmc",
    .doc = "Enskog Monte Carlo (direct simulation of the Enskog or Boltzmann equation)",
    .ensemble = true,
    .accepts = accepts,
    .bytes = bytes,
    .nanoseconds = gg_dsmc_nanoseconds,
    .create = create,
    .create_with = create_with,
    .destroy = gg_dsmc_destroy,
    .advance = advance,
    .take_sums = take_sums,
    .set_callback = gg_dsmc_set_callback,
    .callback_slows = gg_dsmc_callback_slows,
    .threads = threads,
    .state = state,
    .snapshot = snapshot,
    .blocks = blocks,
    .rescale = rescale,
    .shear = shear,
    .save = gg_dsmc_save,
    .restore = restore,
    .describe = describe,
    .go_on = go_on,
};
