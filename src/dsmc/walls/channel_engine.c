/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine in a channel, behind the interface that all engines share. */
#include <math.h>
#include <string.h>

#include "dsmc/walls/channel.h"

enum { STEPS_BETWEEN_MEASUREMENTS = 8 };

static gg_dsmc_channel *channel_of(gg_engine *engine)
{
  return (gg_dsmc_channel *)engine;
}
static const gg_dsmc_channel *const_channel_of(const gg_engine *engine)
{
  return (const gg_dsmc_channel *)engine;
}

static void count(gg_dsmc_channel_cells *c, int species, double dt)
{
  for (int k = 0; k < c->n * species; k++) c->counted[k] += dt * (c->start[k + 1] - c->start[k]);
}

/* Take a step: half a flight, collisions, half a flight (Strang, SIAM J. Numer. Anal. 5 (1968) 506). The last half is
 * pending: the next step flies both halves at once. */
static double step(gg_dsmc_channel *d, double left, double wanted)
{
  gg_dsmc_channel_state *s = &d->now;
  double dt = s->step;
  if (!(d->model.time_step > 0)) dt = fmin(fmin(dt, left), fmax(wanted / s->all_rate, 1e-3 * dt));
  gg_dsmc_channel_fly(d, s->pending + 0.5 * dt);
  gg_dsmc_channel_sort(d);
  count(&d->cells, d->model.n_species, dt);
  if (d->heated) gg_dsmc_channel_heat_before(d, dt);
  d->collide(d, dt);
  if (d->heated) gg_dsmc_channel_heat_after(d, dt);
  s->pending = 0.5 * dt;
  s->time += dt;
  s->unmeasured += dt;
  if (++s->steps % STEPS_BETWEEN_MEASUREMENTS == 0) gg_dsmc_channel_measure(d);
  return dt;
}

static gg_status go_on(gg_engine *engine, double *elapsed, gg_error *err)
{
  gg_dsmc_channel *d = channel_of(engine);
  gg_dsmc_channel_state *s = &d->now;
  bool stopped = false;
  for (uint64_t work = 0; !stopped && !gg_dsmc_advance_is_over(&s->advance, s->collisions);) {
    const uint64_t before = s->candidates;
    GG_TRY(gg_dsmc_check_temperature(&d->model, s->temperature, 1e-300, 1e300, s->collisions, err));
    s->advance.gone += step(d, s->advance.asked - s->advance.gone, (double)(s->advance.last_collision - s->collisions));
    stopped = gg_dsmc_advance_is_stopped(&d->model, &work, s->candidates - before + (uint64_t)d->model.n);
  }
  *elapsed = s->advance.gone;
  if (stopped) return gg_base_fail(err, GG_INTERRUPTED, "dsmc: stopped");
  gg_dsmc_channel_fly(d, s->pending);
  s->pending = 0;
  return GG_OK;
}

static gg_status advance(gg_engine *engine, double dt, uint64_t max_collisions, double *elapsed, gg_error *err)
{
  gg_dsmc_channel_state *s = &channel_of(engine)->now;
  double unused;
  gg_dsmc_advance_begin(&s->advance, dt, max_collisions, s->collisions);
  return go_on(engine, elapsed ? elapsed : &unused, err);
}

static void take_over(gg_dsmc_channel *d, const gg_dsmc_channel *before)
{
  gg_dsmc_channel_state *s = &d->now;
  const gg_dsmc_channel_state *b = &before->now;
  s->streams = b->streams;
  s->time = b->time;
  s->steps = b->steps;
  s->collisions = b->collisions;
  s->candidates = b->candidates;
  s->overflows = b->overflows;
  s->forced_rebounds = b->forced_rebounds;
  s->clamped = b->clamped;
}

static gg_status create_with(const gg_model *model, uint64_t seed, uint64_t stream, const gg_grain_arrays *grains,
                             const gg_engine *before, gg_engine **engine, gg_error *err)
{
  gg_dsmc_channel *d;
  GG_TRY(gg_dsmc_channel_accepts(model, err));
  GG_TRY(gg_dsmc_channel_allocate(model, &d, err));
  d->base.ops = &gg_dsmc_channel_ops;
  const gg_status status = gg_dsmc_channel_start(d, seed, stream, grains, err);
  if (status != GG_OK) {
    gg_dsmc_channel_destroy(&d->base);
    return status;
  }
  if (before) take_over(d, const_channel_of(before));
  *engine = &d->base;
  return GG_OK;
}

static gg_status create(const gg_model *model, uint64_t seed, uint64_t stream, gg_engine **engine, gg_error *err)
{
  return create_with(model, seed, stream, NULL, NULL, engine, err);
}

static void take_sums(gg_engine *engine, gg_collision_sums *sums)
{
  gg_collision_sums *t = &channel_of(engine)->now.transfer;
  *sums = *t;
  memset(t, 0, sizeof *t);
}

static gg_status set_callback(gg_engine *engine, gg_collision_callback *callback, void *context, gg_error *err)
{
  gg_dsmc_channel *d = channel_of(engine);
  if (callback) GG_TRY(gg_dsmc_channel_allocate_last(d, err));
  d->callback = callback;
  d->callback_context = context;
  return GG_OK;
}

/* More threads than slabs that collide at once would be idle. */
static void threads(gg_engine *engine, int threads)
{
  gg_dsmc_channel *d = channel_of(engine);
  gg_base_thread_pool_free(d->pool);
  d->pool = d->slabs > 1 ? gg_base_thread_pool_new(threads < d->slabs / 2 ? threads : d->slabs / 2) : NULL;
}

static void state(const gg_engine *engine, gg_engine_state *state)
{
  const gg_dsmc_channel_state *s = &const_channel_of(engine)->now;
  const double h = s->step * s->rate;
  *state = (gg_engine_state){.time = s->time,
                             .collisions = s->collisions,
                             .events = s->candidates,
                             .overflows = s->overflows,
                             .clamped = s->clamped,
                             .wall_treated = s->forced_rebounds,
                             .others_cpu = gg_base_thread_pool_cpu(const_channel_of(engine)->pool),
                             .overfilled = s->overfilled,
                             .time_step = s->step,
                             .time_step_bias = GG_DSMC_CHANNEL_BIAS_OF_STEP * h * h};
}

enum { SHOWN = 256 }; /* grains of a chunk: they stay in the first cache until they have been sampled */

/* Apply the pending flight to a copy of a grain; random streams of the walls are unchanged, and contacts do not count.
 */
static void fly_on(const gg_dsmc_channel *d, gg_dsmc_channel_contacts *unused, gg_dsmc_channel_grain *p)
{
  gg_rng rng = d->now.streams.walls[0];
  gg_dsmc_channel_fly_grain(d, d->now.pending, &rng, p, unused);
}

GG_INLINE void put(double out[9][SHOWN], int first, size_t slot, gg_vec v)
{
  out[first][slot] = v.x, out[first + 1][slot] = v.y, out[first + 2][slot] = v.z;
}

static void show_grain(const gg_dsmc_channel *d, size_t i, gg_dsmc_channel_contacts *unused, size_t slot,
                       double out[9][SHOWN])
{
  const gg_dsmc_channel_grains *g = &d->grains;
  gg_dsmc_channel_grain p = {.r = {0, g->at[i].y, 0}, .c = g->at[i].c, .species = g->species[i]};
  if (g->s) p.s = g->s[i];
  fly_on(d, unused, &p);
  put(out, 0, slot, p.r), put(out, 3, slot, p.c), put(out, 6, slot, p.s);
}

/* The same where no flight is pending. */
static void show_grains(const gg_dsmc_channel_grains *g, size_t first, size_t n, double out[9][SHOWN])
{
  for (size_t k = 0; k < n; k++) put(out, 0, k, (gg_vec){0, g->at[first + k].y, 0}), put(out, 3, k, g->at[first + k].c);
  for (size_t k = 0; g->s && k < n; k++) put(out, 6, k, g->s[first + k]);
}

static void snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context)
{
  const gg_dsmc_channel *d = channel_of(engine);
  gg_dsmc_channel_contacts unused = {0};
  double out[9][SHOWN];
  int64_t id[SHOWN];
  const size_t n = (size_t)d->model.n;
  for (size_t first = 0; first < n; first += SHOWN) {
    gg_chunk chunk = {.n = n - first < SHOWN ? n - first : SHOWN};
    for (size_t k = 0; k < chunk.n; k++) id[k] = d->grains.id[first + k];
    if (d->now.pending > 0)
      for (size_t k = 0; k < chunk.n; k++) show_grain(d, first + k, &unused, k, out);
    else
      show_grains(&d->grains, first, chunk.n, out);
    for (int a = 0; a < 3; a++) {
      chunk.r[a] = positions ? out[a] : NULL;
      chunk.c[a] = out[3 + a];
      chunk.s[a] = d->grains.s ? out[6 + a] : NULL;
    }
    chunk.species = d->model.n_species > 1 ? d->grains.species + first : NULL;
    chunk.id = positions ? id : NULL;
    visit(context, &chunk);
  }
}

/* In a periodic channel without a thermostat: velocities by the factor, times by its inverse. */
static gg_status rescale(gg_engine *engine, int power, gg_error *err)
{
  gg_dsmc_channel *d = channel_of(engine);
  gg_dsmc_channel_state *s = &d->now;
  const double factor = ldexp(1, power);
  if (!d->periodic || d->heated)
    return gg_base_fail(err, GG_BAD_INPUT, "velocities cannot be rescaled between walls or with a thermostat");
  for (size_t i = 0; i < (size_t)d->model.n; i++) {
    d->grains.at[i].c = gg_scale(factor, d->grains.at[i].c);
    if (d->grains.s) d->grains.s[i] = gg_scale(factor, d->grains.s[i]);
    if (d->grains.last) d->grains.last[i] /= factor;
  }
  for (int k = 0; k < d->cells.n * d->model.n_species; k++) d->cells.counted[k] /= factor;
  double *const times[] = {&s->time, &s->pending, &s->step, &s->unmeasured};
  for (size_t i = 0; i < sizeof times / sizeof *times; i++) *times[i] /= factor;
  s->rate *= factor, s->all_rate *= factor, s->temperature *= factor * factor;
  for (int p = 0; p < gg_pairs_of(d->model.n_species); p++)
    s->transfer.loss[p] *= factor * factor, s->transfer.given[p] *= factor * factor;
  return GG_OK;
}

static gg_status restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  GG_TRY(gg_dsmc_channel_restore(model, archive, engine, err));
  (*engine)->ops = &gg_dsmc_channel_ops;
  return GG_OK;
}

const gg_engine_ops gg_dsmc_channel_ops = {
    .name = "dsmc",
    .doc = "Enskog Monte Carlo between walls, or across a periodic channel",
    .accepts = gg_dsmc_channel_accepts,
    .bytes = gg_dsmc_channel_bytes,
    .create = create,
    .create_with = create_with,
    .destroy = gg_dsmc_channel_destroy,
    .advance = advance,
    .take_sums = take_sums,
    .set_callback = set_callback,
    .threads = threads,
    .state = state,
    .snapshot = snapshot,
    .rescale = rescale,
    .save = gg_dsmc_channel_save,
    .restore = restore,
    .describe = gg_dsmc_channel_describe,
    .go_on = go_on,
};
