/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulations: made, advanced, with a callback for their collisions. */
#include "api/simulation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/sized.h"
#include "base/memory.h"
#include "common/extension.h"
#include "common/rng.h"
#include "run/run.h"
#include "scene/model_of_scene.h"

static bool is_stopped(void *context)
{
  gg_simulation *s = context;
  if (gg_base_busy_is_freed(&s->busy) || atomic_load(&s->stopped)) return true;
  if (s->asks && s->asks(s->asks_context)) atomic_store(&s->stopped, true);
  return atomic_load(&s->stopped);
}

void gg_api_simulation_forget_stop(gg_simulation *s)
{
  s->asks = NULL;
  atomic_store(&s->stopped, false);
}

gg_status gg_api_simulation_check_stop(gg_simulation *s, gg_error *err)
{
  atomic_store(&s->stopped, false);
  return gg_stop_asked(&s->stop) ? gg_base_fail(err, GG_INTERRUPTED, "stopped by its caller") : GG_OK;
}

static void destroy(void *simulation)
{
  gg_simulation *s = simulation;
  if (s->engine) s->engine->ops->destroy(s->engine);
  gg_common_extension_release(s->scene.extension);
  free(s);
}

void gg_simulation_free(gg_simulation *s)
{
  if (s) gg_base_busy_free(&s->busy);
}

/* Small systems start before the engine looks whether to stop, and no theory may. */
gg_status gg_api_simulation_prepare(const gg_scene *scene, int (*stop)(void *context), void *context,
                                    gg_simulation **simulation, gg_error *err)
{
  gg_simulation *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return GG_FAILED;
  gg_base_busy_init(&s->busy, "simulation", destroy, s);
  gg_status status = gg_api_scene_finish(scene, &s->scene, err);
  s->scene.fixed.clock_rate = scene->fixed.clock_rate;
  if (status == GG_OK) status = gg_scene_model_make(&s->scene, s->scene.engine, &s->model, err);
  if (status == GG_OK) status = gg_common_engine_of(s->scene.engine)->accepts(&s->model, err);
  if (status != GG_OK) {
    free(s);
    return status;
  }
  gg_common_extension_hold(s->scene.extension);
  s->stop = (gg_stop){is_stopped, s};
  s->model.stop = &s->stop;
  s->model.cuts_steps = true;
  s->asks = stop, s->asks_context = context;
  status = gg_api_simulation_check_stop(s, err);
  if (status == GG_OK && s->scene.start.temperature == GG_AUTO) status = gg_run_start_near_steady(&s->model, err);
  status = gg_base_callback_settle(status, err);
  if (status == GG_OK)
    *simulation = s;
  else
    gg_simulation_free(s);
  return status;
}

gg_simulation *gg_api_simulation_like(const gg_simulation *other, gg_error *err)
{
  gg_simulation *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return NULL;
  s->scene = other->scene;
  s->model = other->model;
  s->clock = other->clock;
  s->strained = other->strained;
  s->stretch_from = other->stretch_from;
  gg_base_busy_init(&s->busy, "simulation", destroy, s);
  gg_common_extension_hold(s->scene.extension);
  s->stop = (gg_stop){is_stopped, s};
  s->model.stop = &s->stop;
  return s;
}

gg_status gg_api_simulation_started(gg_simulation *s, gg_status status, gg_simulation **simulation, gg_error *err)
{
  gg_api_simulation_forget_stop(s);
  status = gg_base_callback_settle(status, err);
  if (status != GG_OK) {
    gg_simulation_free(s);
    return status;
  }
  s->engine->ops->keep_sums(s->engine, true);
  *simulation = s;
  return GG_OK;
}

gg_status gg_simulation_new(const gg_scene *scene, const gg_start_options *options, gg_simulation **simulation,
                            gg_error *err)
{
  GG_NEED(scene, simulation);
  gg_simulation *s;
  gg_scene at_start = *scene; /* it may be that of a simulation whose shear rate has changed */
  at_start.fixed.clock_rate = GG_AUTO;
  const gg_start_options none = {0}, *o = options ? options : &none;
  GG_TRY(gg_api_simulation_prepare(&at_start, o->stop, o->context, &s, err));
  gg_status status = gg_common_engine_of(s->scene.engine)
                         ->create(&s->model, s->scene.run.seed, o->stream * GG_STREAMS_PER_REPLICA, &s->engine, err);
  return gg_api_simulation_started(s, status, simulation, err);
}

static uint64_t collisions(const gg_simulation *s)
{
  gg_engine_state state;
  s->engine->ops->state(s->engine, &state);
  return state.collisions;
}

/* Velocities that have fallen fourfold are brought back. */
static gg_status rescale_if_cold(gg_simulation *s, double T, gg_error *err)
{
  if (!gg_flow_cools(s->model.flow) || T > s->model.temperature0 / 16) return GG_OK;
  gg_api_simulation_collect(s);
  GG_TRY(s->engine->ops->rescale(s->engine, 2, err));
  s->clock.power += 2;
  return GG_OK;
}

static void show(void *context, const gg_collision_record *collision);

static bool is_observed(const gg_simulation *s)
{
  return s->callback || (s->record.events && *s->record.n < s->record.capacity);
}

/* A callback may have set or removed the collision callback: the engine follows between two stretches. */
static gg_status settle_callback(gg_simulation *s, gg_error *err)
{
  const bool observed = is_observed(s);
  if (observed == s->observed) return GG_OK;
  GG_TRY(s->engine->ops->set_callback(s->engine, observed ? show : NULL, s, err));
  s->observed = observed;
  return GG_OK;
}

/* Free times of a grain that one stretch lasts: so few that a cooling gas is brought back in time. A stretch in which a
 * grain collides a thousand times more often is a collapse. */
enum { STRETCH = 20, COLLAPSE = 1000 };

/* Within at most `time` (units of the start) and `most` collisions; both are lessened by what has gone. */
static gg_status advance_once(gg_simulation *s, double *time, uint64_t *most, gg_error *err)
{
  double T = gg_api_simulation_temperature(s), unit = gg_api_simulation_unit(s), gone = 0;
  double free_time = 1 / gg_common_model_collision_rate(&s->model, T > 0 ? T : s->model.temperature0);
  double stretch = fmin(*time * unit, STRETCH * free_time);
  gg_engine_state engine;
  s->engine->ops->state(s->engine, &engine);
  s->stretch_from = engine.time;
  uint64_t before = engine.collisions, pile = (uint64_t)(COLLAPSE * STRETCH * (double)s->model.n / 2) + 1000000;
  gg_status status = s->engine->ops->advance(s->engine, stretch, *most < pile ? *most : pile, &gone, err);
  uint64_t happened = collisions(s) - before;
  s->clock.time += gone / unit;
  *time = gone >= *time * unit ? 0 : *time - gone / unit;
  *most = happened < *most ? *most - happened : 0;
  if (status == GG_OK) status = settle_callback(s, err);
  if (status != GG_OK) return status;
  if (happened >= pile) {
    gg_base_fail(err, GG_FAILED,
                 "%s: inelastic collapse near time %g: collisions accumulate without end; give md.contact_time a larger "
                 "value",
                 s->engine->ops->name, s->clock.time);
    if (err) err->cause = GG_CAUSE_COLLAPSE;
    return GG_FAILED;
  }
  return rescale_if_cold(s, gg_api_simulation_temperature(s), err);
}

/* The callback is called before the first stretch, too: with small systems an advance ends before the engine looks. */
static gg_status advance_stretch(gg_simulation *s, double *time, uint64_t *most, gg_error *err)
{
  GG_TRY(settle_callback(s, err)); /* of an advance that was stopped */
  gg_status status = gg_api_simulation_check_stop(s, err);
  if (status == GG_OK) status = advance_once(s, time, most, err);
  return gg_base_callback_settle(status, err);
}

gg_status gg_simulation_advance(gg_simulation *simulation, double time, gg_error *err)
{
  GG_NEED(simulation);
  if (!(time >= 0 && time < INFINITY))
    return gg_base_fail(err, GG_BAD_INPUT, "gg_simulation_advance: cannot advance by %g", time);
  GG_USE_ALONE(simulation);
  for (uint64_t most = UINT64_MAX; time > 0;) GG_TRY(advance_stretch(simulation, &time, &most, err));
  return GG_OK;
}

/* Stretches in a row without a collision after which there will be none: a grain expects twenty in each. */
enum { MOST_EMPTY_STRETCHES = 100 };

gg_status gg_simulation_collide(gg_simulation *simulation, uint64_t collisions_more, gg_error *err)
{
  GG_NEED(simulation);
  GG_USE_ALONE(simulation);
  double time = INFINITY;
  for (int empty = 0; collisions_more > 0; empty++) {
    uint64_t before = collisions_more;
    GG_TRY(advance_stretch(simulation, &time, &collisions_more, err));
    if (collisions_more < before) empty = -1;
    if (empty == MOST_EMPTY_STRETCHES)
      return gg_base_fail(
          err, GG_FAILED,
          "gg_simulation_collide: the grains do not meet: no collision in %d mean free times up to time %g",
          STRETCH * MOST_EMPTY_STRETCHES, simulation->clock.time);
  }
  return GG_OK;
}

static void set_stop(gg_simulation *s, int (*stop)(void *context), void *context)
{
  s->asks = stop;
  s->asks_context = context;
}

/* A callback may replace itself, and the other one: the call in progress is of its own thread. */
gg_status gg_simulation_on_stop(gg_simulation *simulation, int (*stop)(void *context), void *context, gg_error *err)
{
  GG_NEED(simulation);
  if (gg_base_busy_is_inside(&simulation->busy)) return set_stop(simulation, stop, context), GG_OK;
  GG_USE_ALONE(simulation);
  return set_stop(simulation, stop, context), GG_OK;
}

static void put(double to[3], gg_vec v, double factor)
{
  to[0] = v.x * factor, to[1] = v.y * factor, to[2] = v.z * factor;
}

static void show(void *context, const gg_collision_record *collision)
{
  gg_simulation *s = context;
  if (collision->wall || !is_observed(s) || gg_base_busy_is_freed(&s->busy)) return;
  double unit = gg_api_simulation_unit(s);
  gg_engine_state engine;
  s->engine->ops->state(s->engine, &engine);
  gg_collision_event event = {.grain = {(size_t)collision->id[0], (size_t)collision->id[1]},
                              .species = {collision->species[0], collision->species[1]},
                              .normal_speed = gg_dot(collision->k, collision->c12) * unit,
                              .time = s->clock.time + (engine.time - s->stretch_from) / unit};
  put(event.k, collision->k, 1);
  put(event.velocity, collision->c12, unit);
  put(event.impulse, collision->J, unit);
  if (s->record.events && *s->record.n < s->record.capacity)
    memcpy(s->record.events + (*s->record.n)++ * s->record.size, &event, s->record.size);
  if (s->callback) s->callback(s->context, &event);
}

gg_status gg_api_simulation_watch(gg_simulation *s, gg_engine *engine, gg_error *err)
{
  return s->observed ? engine->ops->set_callback(engine, show, s, err) : GG_OK;
}

gg_status gg_simulation_on_collision(gg_simulation *simulation, gg_on_collision *callback, void *context, gg_error *err)
{
  GG_NEED(simulation);
  gg_simulation *s = simulation;
  if (gg_base_busy_is_inside(&s->busy)) {
    s->callback = callback;
    s->context = context;
    return GG_OK;
  }
  GG_USE_ALONE(simulation);
  gg_on_collision *const before = s->callback;
  s->callback = callback;
  s->observed = !is_observed(s); /* the engine is to know in any case: one that was loaded may still have its records */
  gg_status status = settle_callback(s, err);
  if (status == GG_OK)
    s->context = context;
  else
    s->callback = before;
  return status;
}

gg_status gg_simulation_record_sized(gg_simulation *simulation, gg_collision_event *events, size_t capacity, size_t *n,
                                     gg_error *err, size_t event_size)
{
  GG_NEED(simulation);
  GG_SIZE(gg_collision_event, event_size);
  if (events && !n) return gg_base_fail(err, GG_BAD_INPUT, "gg_simulation_record: argument 'n' is missing (NULL)");
  GG_USE_ALONE(simulation);
  simulation->record.events = (char *)events;
  simulation->record.size = event_size;
  simulation->record.capacity = capacity;
  simulation->record.n = n;
  if (n) *n = 0;
  gg_status status = settle_callback(simulation, err);
  if (status != GG_OK) simulation->record.events = NULL;
  return status;
}

gg_status gg_simulation_record(gg_simulation *simulation, gg_collision_event *events, size_t capacity, size_t *n,
                               gg_error *err)
{
  return gg_simulation_record_sized(simulation, events, capacity, n, err, sizeof *events);
}

const gg_scene *gg_simulation_scene(const gg_simulation *simulation)
{
  return simulation ? &simulation->scene : NULL;
}
