/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulations: start, advance, collision callbacks. */
#include "api/simulation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/extension.h"
#include "common/rng.h"
#include "files/positions.h"
#include "run/default_size.h"
#include "run/run.h"
#include "scene/model_of_scene.h"
#include "theory/near_steady.h"

static bool is_stopped(void *context)
{
  gg_simulation *s = context;
  if (gg_base_busy_is_freed(&s->busy) || atomic_load(&s->stopped)) return true;
  if (s->stop_callback && s->stop_callback(s->stop_context)) atomic_store(&s->stopped, true);
  return atomic_load(&s->stopped);
}

/* Before work that the stop callback may interrupt. */
static gg_status check_stop(gg_simulation *s, gg_error *err)
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

static gg_status give(gg_simulation *s, gg_status status, gg_simulation **simulation, gg_error *err)
{
  status = gg_base_callback_settle(status, err);
  if (status == GG_OK)
    *simulation = s;
  else
    gg_simulation_free(s);
  return status;
}

static void open_for_use(gg_simulation *s)
{
  gg_base_busy_init(&s->busy, "simulation", destroy, s);
  gg_common_extension_hold(s->scene.extension);
  s->stop = (gg_stop){is_stopped, s};
  s->model.stop = &s->stop;
}

/* The stop callback is polled here, because small systems start before the engine polls it, and theories never do. */
gg_status gg_api_simulation_prepare(const gg_scene *scene, int (*stop)(void *context), void *context,
                                    gg_simulation **simulation, gg_error *err)
{
  gg_simulation *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return GG_FAILED;
  s->scene = *scene; /* checked as it began: a rate of 0 or below is one on the way */
  if (scene->fixed.clock_rate != GG_AUTO && gg_flow_is_sheared(scene->flow))
    s->scene.shear.rate = scene->fixed.clock_rate;
  s->scene.fixed.clock_rate = GG_AUTO;
  gg_status status = gg_run_scene_finish(&s->scene, err);
  s->scene.shear.rate = scene->shear.rate;
  s->scene.fixed.clock_rate = scene->fixed.clock_rate;
  if (status == GG_OK) status = gg_scene_model_make(&s->scene, s->scene.engine, &s->model, err);
  if (status == GG_OK) status = gg_common_engine_of(s->scene.engine)->accepts(&s->model, err);
  if (status != GG_OK) return free(s), status;
  open_for_use(s);
  s->model.cuts_steps = true;
  s->stop_callback = stop, s->stop_context = context;
  status = check_stop(s, err);
  if (status == GG_OK && s->scene.start.temperature == GG_AUTO) status = gg_theory_start_near_steady(&s->model, err);
  return give(s, status, simulation, err);
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
  open_for_use(s);
  return s;
}

gg_status gg_api_simulation_hand_over(gg_simulation *s, gg_status status, gg_simulation **simulation, gg_error *err)
{
  s->stop_callback = NULL; /* that of the start */
  atomic_store(&s->stopped, false);
  return give(s, status, simulation, err);
}

gg_status gg_simulation_new(const gg_scene *scene, const gg_start_options *options, gg_simulation **simulation,
                            gg_error *err)
{
  GG_NEED(scene, simulation);
  gg_simulation *s;
  gg_scene at_start = *scene; /* may be the scene of a simulation whose shear rate has changed */
  at_start.fixed.clock_rate = GG_AUTO;
  gg_start_options o;
  GG_COPY_OPTIONS(o, options);
  GG_TRY(gg_api_simulation_prepare(&at_start, o.stop, o.context, &s, err));
  gg_positions start = {0};
  gg_status status = s->scene.engine == GG_MD ? gg_files_positions_read(&s->scene, &s->model, &start, err) : GG_OK;
  s->model.start = start.r ? &start.grains : NULL;
  if (status == GG_OK)
    status = gg_common_engine_of(s->scene.engine)
                 ->create(&s->model, s->scene.run.seed, o.stream * GG_STREAMS_PER_REPLICA, &s->engine, err);
  s->model.start = NULL;
  gg_files_positions_free(&start);
  return gg_api_simulation_hand_over(s, status, simulation, err);
}

/* Rescale the velocities once they have decreased fourfold. */
static gg_status rescale_if_cold(gg_simulation *s, double T, gg_error *err)
{
  if (!gg_flow_cools(s->model.flow) || T > s->model.temperature0 / 16) return GG_OK;
  gg_api_simulation_collect(s);
  GG_TRY(s->engine->ops->rescale(s->engine, 2, err));
  s->clock.power += 2;
  return GG_OK;
}

static void report_collision(void *context, const gg_collision_record *collision);

static bool is_observed(const gg_simulation *s)
{
  return s->callback || (s->record.events && *s->record.n < s->record.capacity);
}

/* Tell the engine, between two stretches, whether to report collisions: a callback may have changed this. */
static gg_status update_observation(gg_simulation *s, gg_error *err)
{
  const bool observed = is_observed(s);
  if (observed == s->observed) return GG_OK;
  GG_TRY(s->engine->ops->set_callback(s->engine, observed ? report_collision : NULL, s, err));
  s->observed = observed;
  return GG_OK;
}

/* Length of a stretch in mean free times, short enough to rescale a cooling gas in time. Inelastic collapse: a grain
 * collides COLLAPSE times more often in a stretch. */
enum { STRETCH = 20, COLLAPSE = 1000 };

/* Advance by at most one stretch, `time` (units of the start) and `most` collisions; both are reduced. */
static gg_status advance_once(gg_simulation *s, double *time, uint64_t *most, gg_error *err)
{
  double T = gg_api_simulation_temperature(s), unit = gg_api_simulation_unit(s), gone = 0;
  double free_time = 1 / gg_common_model_collision_rate(&s->model, T > 0 ? T : s->model.temperature0);
  double stretch = fmin(*time * unit, STRETCH * free_time);
  const gg_engine_state engine = gg_engine_state_of(s->engine);
  s->stretch_from = engine.time;
  uint64_t before = engine.collisions, pile = (uint64_t)(COLLAPSE * STRETCH * (double)s->model.n / 2) + 1000000;
  gg_status status = s->engine->ops->advance(s->engine, stretch, *most < pile ? *most : pile, &gone, err);
  uint64_t happened = gg_engine_state_of(s->engine).collisions - before;
  s->clock.time += gone / unit;
  *time = gone >= *time * unit ? 0 : *time - gone / unit;
  *most = happened < *most ? *most - happened : 0;
  if (status == GG_OK) status = update_observation(s, err);
  if (status != GG_OK) return status;
  if (happened >= pile) {
    gg_base_fail(
        err, GG_FAILED,
        "%s: inelastic collapse near time %g: collisions accumulate without end; give md.contact_time a larger value",
        s->engine->ops->name, s->clock.time);
    if (err) err->cause = GG_CAUSE_COLLAPSE;
    return GG_FAILED;
  }
  return rescale_if_cold(s, gg_api_simulation_temperature(s), err);
}

/* The stop callback is polled before each stretch: in small systems a stretch ends before the engine polls it. */
static gg_status advance_stretch(gg_simulation *s, double *time, uint64_t *most, gg_error *err)
{
  GG_TRY(update_observation(s, err)); /* the last advance may have been interrupted */
  gg_status status = check_stop(s, err);
  if (status == GG_OK) status = advance_once(s, time, most, err);
  return gg_base_callback_settle(status, err);
}

gg_status gg_simulation_advance(gg_simulation *simulation, double time, gg_error *err)
{
  GG_NEED(simulation);
  if (!(time >= 0 && time < INFINITY)) return GG_REFUSE(err, "gg_simulation_advance: cannot advance by %g", time);
  GG_USE_ALONE(simulation);
  for (uint64_t most = UINT64_MAX; time > 0;) GG_TRY(advance_stretch(simulation, &time, &most, err));
  return GG_OK;
}

/* Consecutive stretches without a collision after which the advance fails; 20 collisions per grain are expected in
 * each. */
enum { MOST_EMPTY_STRETCHES = 100 };

gg_status gg_simulation_collide(gg_simulation *simulation, uint64_t collisions_more, gg_error *err)
{
  GG_NEED_ALONE(simulation);
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
  s->stop_callback = stop;
  s->stop_context = context;
}

/* Allowed from callbacks of this simulation: they run on the thread of the call in progress. */
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

static void report_collision(void *context, const gg_collision_record *collision)
{
  gg_simulation *s = context;
  if (collision->wall || !is_observed(s) || gg_base_busy_is_freed(&s->busy)) return;
  double unit = gg_api_simulation_unit(s);
  const gg_engine_state engine = gg_engine_state_of(s->engine);
  gg_collision_event event = {.grain = {(size_t)collision->id[0], (size_t)collision->id[1]},
                              .species = {collision->species[0], collision->species[1]},
                              .normal_speed = gg_dot(collision->k, collision->c12) * unit,
                              .time = s->clock.time + (engine.time - s->stretch_from) / unit};
  put(event.k, collision->k, 1);
  put(event.velocity, collision->c12, unit);
  put(event.impulse, collision->J, unit);
  if (s->record.events && *s->record.n < s->record.capacity) s->record.events[(*s->record.n)++] = event;
  if (s->callback) s->callback(s->context, &event);
}

gg_status gg_api_simulation_observe(gg_simulation *s, gg_engine *engine, gg_error *err)
{
  return s->observed ? engine->ops->set_callback(engine, report_collision, s, err) : GG_OK;
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
  s->observed = !is_observed(s); /* forces an update: the engine of a loaded simulation may still report collisions */
  gg_status status = update_observation(s, err);
  if (status == GG_OK)
    s->context = context;
  else
    s->callback = before;
  return status;
}

gg_status gg_simulation_record(gg_simulation *simulation, gg_collision_event *events, size_t capacity, size_t *n,
                               gg_error *err)
{
  GG_NEED(simulation);
  if (events && !n) return GG_REFUSE(err, "gg_simulation_record: argument 'n' is missing (NULL)");
  GG_USE_ALONE(simulation);
  simulation->record.events = events;
  simulation->record.capacity = capacity;
  simulation->record.n = n;
  if (n) *n = 0;
  gg_status status = update_observation(simulation, err);
  if (status != GG_OK) simulation->record.events = NULL;
  return status;
}

const gg_scene *gg_simulation_scene(const gg_simulation *simulation)
{
  return simulation ? &simulation->scene : NULL;
}
