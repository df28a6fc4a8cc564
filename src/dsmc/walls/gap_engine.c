/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine between walls, behind the interface that all engines share. */
#include <math.h>
#include <string.h>

#include "dsmc/walls/gap.h"

/* Between looks at whether to stop, in candidates and flights; steps between measurements. */
enum { WORK_BETWEEN_LOOKS = 1 << 16, STEPS_BETWEEN_MEASUREMENTS = 8 };

static gg_dsmc_gap *gap_of(gg_engine *engine)
{
  return (gg_dsmc_gap *)engine;
}
static const gg_dsmc_gap *const_gap_of(const gg_engine *engine)
{
  return (const gg_dsmc_gap *)engine;
}

static void count(gg_dsmc_gap_cells *c, int species, double dt)
{
  for (int k = 0; k < c->n * species; k++) c->counted[k] += dt * (c->start[k + 1] - c->start[k]);
}

/* Half a flight, collisions, half a flight (Strang, SIAM J. Numer. Anal. 5 (1968) 506): the last half is left to the
 * next step, which flies both at once. */
static double step(gg_dsmc_gap *d, double left, double wanted)
{
  gg_dsmc_gap_state *s = &d->now;
  double dt = s->step;
  if (!(d->model.time_step > 0)) dt = fmin(fmin(dt, left), fmax(wanted / s->all_rate, 1e-3 * dt));
  gg_dsmc_gap_fly(d, s->owed + 0.5 * dt);
  gg_dsmc_gap_sort(d);
  count(&d->cells, d->model.n_species, dt);
  d->collide(d, dt);
  s->owed = 0.5 * dt;
  s->time += dt;
  s->unmeasured += dt;
  if (++s->steps % STEPS_BETWEEN_MEASUREMENTS == 0) gg_dsmc_gap_measure(d);
  return dt;
}

static gg_status check_temperature(const gg_dsmc_gap *d, gg_error *err)
{
  if (d->now.temperature > 1e-300 && d->now.temperature < 1e300) return GG_OK;
  return gg_base_fail(err, GG_FAILED,
                      "the temperature left the range of double precision (%g) after %.3g collisions per grain",
                      d->now.temperature, 2 * (double)d->now.collisions / (double)d->model.n);
}

static gg_status go_on(gg_engine *engine, double *elapsed, gg_error *err)
{
  gg_dsmc_gap *d = gap_of(engine);
  gg_dsmc_gap_state *s = &d->now;
  bool stopped = false;
  for (uint64_t work = 0; !stopped && s->gone < s->asked && s->collisions < s->last_collision;) {
    const uint64_t before = s->candidates;
    GG_TRY(check_temperature(d, err));
    s->gone += step(d, s->asked - s->gone, (double)(s->last_collision - s->collisions));
    work += s->candidates - before + (uint64_t)d->model.n;
    if (work < WORK_BETWEEN_LOOKS) continue;
    work = 0;
    stopped = gg_stop_asked(d->model.stop);
  }
  *elapsed = s->gone;
  if (stopped) return gg_base_fail(err, GG_INTERRUPTED, "dsmc: stopped");
  gg_dsmc_gap_fly(d, s->owed);
  s->owed = 0;
  return GG_OK;
}

static gg_status advance(gg_engine *engine, double dt, uint64_t max_collisions, double *elapsed, gg_error *err)
{
  gg_dsmc_gap_state *s = &gap_of(engine)->now;
  double unused;
  s->asked = dt;
  s->gone = 0;
  s->last_collision = max_collisions < UINT64_MAX - s->collisions ? s->collisions + max_collisions : UINT64_MAX;
  return go_on(engine, elapsed ? elapsed : &unused, err);
}

static void take_over(gg_dsmc_gap *d, const gg_dsmc_gap *before)
{
  gg_dsmc_gap_state *s = &d->now;
  const gg_dsmc_gap_state *b = &before->now;
  s->streams = b->streams;
  s->time = b->time;
  s->steps = b->steps;
  s->collisions = b->collisions;
  s->candidates = b->candidates;
  s->overflows = b->overflows;
  s->rests = b->rests;
  s->clamped = b->clamped;
}

static gg_status create_with(const gg_model *model, uint64_t seed, uint64_t stream, const gg_grain_arrays *grains,
                             const gg_engine *before, gg_engine **engine, gg_error *err)
{
  gg_dsmc_gap *d;
  GG_TRY(gg_dsmc_gap_accepts(model, err));
  GG_TRY(gg_dsmc_gap_allocate(model, &d, err));
  const gg_status status = gg_dsmc_gap_start(d, seed, stream, grains, err);
  if (status != GG_OK) {
    gg_dsmc_gap_destroy(&d->base);
    return status;
  }
  if (before) take_over(d, const_gap_of(before));
  *engine = &d->base;
  return GG_OK;
}

static gg_status create(const gg_model *model, uint64_t seed, uint64_t stream, gg_engine **engine, gg_error *err)
{
  return create_with(model, seed, stream, NULL, NULL, engine, err);
}

static void keep_sums(gg_engine *engine, bool keep)
{
  gap_of(engine)->now.keeps_sums = keep;
}

static void take_sums(gg_engine *engine, gg_collision_sums *sums)
{
  gg_collision_sums *t = &gap_of(engine)->now.transfer;
  *sums = *t;
  memset(t, 0, sizeof *t);
}

static gg_status set_callback(gg_engine *engine, gg_collision_callback *callback, void *context, gg_error *err)
{
  gg_dsmc_gap *d = gap_of(engine);
  if (callback) GG_TRY(gg_dsmc_gap_allocate_last(d, err));
  d->callback = callback;
  d->callback_context = context;
  return GG_OK;
}

/* At most as many as there are slabs that collide at once. */
static void threads(gg_engine *engine, int threads)
{
  gg_dsmc_gap *d = gap_of(engine);
  gg_base_thread_pool_free(d->pool);
  d->pool = d->slabs > 1 ? gg_base_thread_pool_new(threads < d->slabs / 2 ? threads : d->slabs / 2) : NULL;
}

static void state(const gg_engine *engine, gg_engine_state *state)
{
  const gg_dsmc_gap_state *s = &const_gap_of(engine)->now;
  const double h = s->step * s->rate;
  *state = (gg_engine_state){.time = s->time,
                             .collisions = s->collisions,
                             .events = s->candidates,
                             .overflows = s->overflows,
                             .clamped = s->clamped,
                             .wall_treated = s->rests,
                             .others_cpu = gg_base_thread_pool_cpu(const_gap_of(engine)->pool),
                             .overfilled = const_gap_of(engine)->cells.overfilled,
                             .time_step = s->step,
                             .time_step_bias = GG_GAP_BIAS_OF_STEP * h * h};
}

enum { SHOWN = 256 };

/* Where the flight that is still owed takes it; the walls know nothing of it. */
static void fly_on(const gg_dsmc_gap *d, gg_dsmc_gap_grain *p)
{
  gg_dsmc_gap_contacts unused = {0};
  gg_rng rng = d->now.streams.walls[0];
  gg_dsmc_gap_fly_grain(d, d->now.owed, &rng, p, &unused);
}

static void show_grain(const gg_dsmc_gap *d, size_t i, size_t slot, double out[9][SHOWN])
{
  const gg_dsmc_gap_grains *g = &d->grains;
  gg_dsmc_gap_grain p = {.r = {0, g->at[i].y, 0}, .c = g->at[i].c, .species = g->species[i]};
  if (g->s) p.s = g->s[i];
  if (d->now.owed > 0) fly_on(d, &p);
  const gg_vec parts[] = {p.r, p.c, p.s};
  for (int k = 0; k < 9; k++) out[k][slot] = gg_along(&parts[k / 3], k % 3);
}

static void snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context)
{
  const gg_dsmc_gap *d = gap_of(engine);
  double out[9][SHOWN];
  int64_t id[SHOWN];
  const size_t n = (size_t)d->model.n;
  for (size_t first = 0; first < n; first += SHOWN) {
    gg_chunk chunk = {.n = n - first < SHOWN ? n - first : SHOWN};
    for (size_t k = 0; k < chunk.n; k++) show_grain(d, first + k, k, out), id[k] = d->grains.id[first + k];
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

static gg_status rescale(gg_engine *engine, int power, gg_error *err)
{
  (void)engine, (void)power;
  return gg_base_fail(err, GG_BAD_INPUT, "velocities cannot be rescaled between walls: the drive sets the clock");
}

const gg_engine_ops gg_dsmc_gap_ops = {
    .name = "dsmc",
    .doc = "Enskog Monte Carlo between walls",
    .accepts = gg_dsmc_gap_accepts,
    .bytes = gg_dsmc_gap_bytes,
    .create = create,
    .create_with = create_with,
    .destroy = gg_dsmc_gap_destroy,
    .advance = advance,
    .keep_sums = keep_sums,
    .take_sums = take_sums,
    .set_callback = set_callback,
    .threads = threads,
    .state = state,
    .snapshot = snapshot,
    .rescale = rescale,
    .save = gg_dsmc_gap_save,
    .restore = gg_dsmc_gap_restore,
    .describe = gg_dsmc_gap_describe,
    .go_on = go_on,
};
