/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine behind the interface that all engines share. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "md/epoch.h"
#include "md/event_loops.h"
#include "md/grid.h"
#include "md/images.h"
#include "md/kicks.h"
#include "md/md_allocate.h"
#include "md/md_operations.h"
#include "md/md_thermostat.h"
#include "md/parallel/parallel.h"
#include "md/row_motion.h"
#include "md/start/start.h"
#include "md/verify.h"

static void destroy(gg_engine *engine)
{
  gg_md_free((gg_md *)engine);
}

/* Take clock, counts and random stream from another engine. */
static void take_over(gg_md *e, const gg_md *before)
{
  gg_md_counts *k = &e->k;
  *(e->heat == GG_HEAT_SCALES ? &k->outer_time : &k->epoch_start) = gg_md_time(before);
  k->collisions = k->epoch_collisions = before->k.collisions;
  k->events = k->epoch_events = e->check_at = before->k.events;
  k->treated = before->k.treated;
  k->wall_treated = before->k.wall_treated;
  k->clamped = before->k.clamped;
  k->worst_overlap = before->k.worst_overlap;
  k->power = before->k.power;
  k->rng = before->k.rng;
  k->image_turns = gg_md_turns(before);
}

static gg_status begin_with(gg_md *e, uint64_t seed, uint64_t stream, const gg_grain_arrays *grains,
                            const gg_md *before, gg_error *err)
{
  if (before) e->box.offset0 = gg_md_offset(&before->box, before->k.now);
  GG_TRY(gg_md_start(e, seed, stream, grains, err));
  if (before) take_over(e, before);
  if (before && before->image) GG_TRY(gg_md_take_images(e, before, err));
  if (gg_flow_of(e->model.flow)->frame != GG_LABORATORY && grains->c && gg_md_has_drift(e))
    gg_md_follow_centre_of_mass(e);
  const double T = gg_md_temperature(e);
  return gg_md_begin_at(e, T > 0 ? T : e->model.temperature0, err);
}

static gg_status create_with(const gg_model *model, uint64_t seed, uint64_t stream, const gg_grain_arrays *grains,
                             const gg_engine *before, gg_engine **engine, gg_error *err)
{
  gg_md *e;
  GG_TRY(gg_md_accepts(model, err));
  if (!grains->r && !before && gg_md_starts_in_equilibrium(model))
    return gg_md_create_in_equilibrium(&gg_md_ops, model, seed, stream, grains, engine, err);
  GG_TRY(gg_md_allocate(model, &e, err));
  e->base.ops = &gg_md_ops;
  gg_status status = begin_with(e, seed, stream, grains, (const gg_md *)before, err);
  if (status == GG_OK)
    *engine = &e->base;
  else
    gg_md_free(e);
  return status;
}

static gg_status create(const gg_model *model, uint64_t seed, uint64_t stream, gg_engine **engine, gg_error *err)
{
  gg_md *e;
  if (model->start) {
    const gg_status status = create_with(model, seed, stream, model->start, NULL, engine, err);
    return status == GG_BAD_INPUT ? gg_base_error_prefix(err, status, "start.positions") : status;
  }
  GG_TRY(gg_md_accepts(model, err));
  if (gg_md_starts_in_equilibrium(model))
    return gg_md_create_in_equilibrium(&gg_md_ops, model, seed, stream, NULL, engine, err);
  GG_TRY(gg_md_allocate(model, &e, err));
  e->base.ops = &gg_md_ops;
  gg_status status = gg_md_start(e, seed, stream, NULL, err);
  if (status == GG_OK) status = gg_md_begin(e, err);
  if (status == GG_OK)
    *engine = &e->base;
  else
    gg_md_free(e);
  return status;
}

static gg_status restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  GG_TRY(gg_md_restore(model, archive, engine, err));
  (*engine)->ops = &gg_md_ops;
  return GG_OK;
}

enum {
  EVENTS_PER_POLL = 1 << 14,  /* between polls of `stop`: some milliseconds */
  EVENTS_BETWEEN_WINDOWS = 16 /* serial events after parallel windows */
};

/* Run events up to k.stop. False: stopped. If time does not advance between two polls, a grain comes to rest on a wall
 * without the contact-time rule: time will never advance again. */
static bool run_leg(gg_md *e)
{
  for (;;) {
    const double before = e->k.now;
    if (e->parallel && gg_md_run_windows(e)) e->look_at = e->k.events + EVENTS_BETWEEN_WINDOWS;
    if (e->out_of_memory) return true;
    e->kernel->run(e);
    if (e->k.events < e->look_at) return true;
    e->stands_still = e->k.now == before && e->model.walled && e->model.contact_time == 0;
    if (e->stands_still) return true;
    e->look_at = e->k.events + EVENTS_PER_POLL;
    if (!gg_md_check_numbers(e)) return true;
    if (gg_stop_asked(e->model.stop)) return false;
  }
}

/* Bring every grain to the present time, and begin a new epoch there. */
static void bring_to_present(gg_md *e)
{
  gg_md_counts *k = &e->k;
  const double now = k->now;
  gg_md_move_images(e, now);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->r = gg_md_position(e, e->falls, g, now);
    g->t = 0;
  }
  gg_md_turn_spins(e, now);
  k->epoch_start += now, k->mark -= now;
  k->now = k->window_time = 0;
  k->window_collisions = 0;
  k->epoch_collisions = k->collisions, k->epoch_events = k->events;
  if (gg_md_search_has_rows(e->search.kind)) gg_md_align_rows(e);
}

/* Predict all after velocities have changed at the present time, to which all grains were brought. The lists are made
 * anew, since skins shrink at another rate. It is not stopped midway: the engine would be no state to continue from. */
static gg_status predict_present(gg_md *e, gg_error *err)
{
  const gg_stop *const stop = e->model.stop;
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS) gg_md_set_skins(e, e->search.lists.radius);
  if (gg_md_search_has_rows(e->search.kind)) gg_md_align_rows(e), gg_md_separate_rows(e);
  e->model.stop = NULL;
  const gg_status status = gg_md_predict_anew(e, err);
  e->model.stop = stop;
  return status;
}

/* The Gaussian thermostat under shear: see kicks.h. */
static void compensate(gg_md *e)
{
  const double now = e->k.now;
  bring_to_present(e);
  gg_md_kicks_move(e, now);
  const double energy = 1.5 * e->n * gg_md_follow_centre_of_mass(e), lost = e->k.kinetic0 - e->k.kinetic;
  const double factor = energy > 0 ? sqrt(1 + lost / energy) : 1;
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    const double flow = e->model.shear_rate * (g->r.y - 0.5 * e->box.edge[1]);
    g->v = (gg_vec){flow + factor * (g->v.x - flow), factor * g->v.y, factor * g->v.z};
    if (e->last) e->last[i] -= now;
  }
  e->k.kinetic = e->k.kinetic0;
  e->k.next_kick = gg_md_compensation_interval(e);
  if (predict_present(e, NULL) != GG_OK) e->out_of_memory = true;
}

/* Run events with kicks in between; each kick ends a leg. k.stop is shifted at the end of an epoch, so the rest of the
 * advance is stored as a difference. */
static bool run_legs(gg_md *e)
{
  while (e->k.beyond_kick >= 0) {
    e->k.stop = e->k.next_kick;
    if (!run_leg(e)) return false;
    if (!e->k.collisions_left) return true;
    e->k.now = e->k.next_kick;
    if (gg_md_compensates(e))
      compensate(e);
    else
      gg_md_kick(e);
    e->k.beyond_kick -= e->k.next_kick - e->k.now;
  }
  if (e->k.beyond_kick > -INFINITY) e->k.stop = e->k.next_kick + e->k.beyond_kick;
  e->k.beyond_kick = -INFINITY;
  return run_leg(e);
}

/* Continue the present advance to its end, to its last collision, or to a stop. */
static gg_status go_on(gg_engine *engine, double *elapsed, gg_error *err)
{
  gg_md *e = (gg_md *)engine;
  e->look_at = e->k.events + EVENTS_PER_POLL;
  bool ended = !gg_md_check_numbers(e) || run_legs(e);
  if (e->out_of_memory) return gg_base_out_of_memory_for(err, "cells and events of md");
  if (e->no_number)
    return gg_base_fail(err, GG_FAILED,
                        "md: a velocity or position became NaN or infinite after %.3g collisions per grain",
                        2 * (double)e->k.collisions / e->n);
  if (e->stands_still)
    return gg_base_fail(
        err, GG_FAILED,
        "md: contacts with a wall accumulate without end near time %g, as a grain comes to rest there; give "
        "md.contact_time a value above 0",
        gg_md_time(e));
  bool whole = ended && e->k.collisions_left && e->k.stop < INFINITY;
  if (whole) e->k.now = e->k.stop;
  *elapsed = whole ? e->k.asked : gg_md_outer_time(e);
  if (!ended) return gg_base_fail(err, GG_INTERRUPTED, "md: stopped");
  e->k.outer_time += *elapsed;
  e->k.outer = 0;
  e->k.mark = e->k.now;
  return GG_OK;
}

static gg_status advance(gg_engine *engine, double dt, uint64_t max_collisions, double *elapsed, gg_error *err)
{
  gg_md *e = (gg_md *)engine;
  double unused;
  if (!(dt >= 0)) return gg_base_fail(err, GG_BAD_INPUT, "a run cannot advance by %g", dt);
  e->k.outer_time += gg_md_outer_time(e); /* of an advance that was stopped and is not continued */
  e->k.outer = 0;
  e->k.mark = e->k.now;
  e->k.asked = dt;
  e->k.stop = e->k.now + dt * e->k.scale;
  e->k.beyond_kick = e->k.next_kick < INFINITY ? e->k.stop - e->k.next_kick : -INFINITY;
  e->k.collisions_left = max_collisions;
  return go_on(engine, elapsed ? elapsed : &unused, err);
}

static void take_sums(gg_engine *engine, gg_collision_sums *transfer)
{
  gg_md *e = (gg_md *)engine;
  *transfer = e->k.transfer;
  memset(&e->k.transfer, 0, sizeof e->k.transfer);
}

/* Smaller systems are as fast on one thread. */
static void threads(gg_engine *engine, int threads)
{
  gg_md *e = (gg_md *)engine;
  gg_md_use_threads(e, e->n < GG_MD_FEWEST_PARALLEL ? 1 : threads, true);
}

static void state(const gg_engine *engine, gg_engine_state *s)
{
  const gg_md *e = (const gg_md *)engine;
  *s = (gg_engine_state){.time = gg_md_time(e),
                         .collisions = e->k.collisions,
                         .events = e->k.events,
                         .treated = e->k.treated,
                         .offset = gg_md_offset(&e->box, e->k.now),
                         .turns = gg_md_turns(e),
                         .wall_treated = e->k.wall_treated,
                         .clamped = e->k.clamped,
                         .worst_overlap = e->k.worst_overlap,
                         .others_cpu = gg_md_parallel_cpu(e)};
}

/* Begin the next sweep of a linear response: multiply the peculiar velocities, keep flow and clock, re-predict all. */
static gg_status begin_sweep(gg_md *e, int power, gg_error *err)
{
  bring_to_present(e);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    const double flow = e->model.shear_rate * (g->r.y - 0.5 * e->box.edge[1]);
    g->v.x = ldexp(g->v.x - flow, power) + flow;
    g->v.y = ldexp(g->v.y, power), g->v.z = ldexp(g->v.z, power);
    if (e->spin) e->spin[i] = gg_scale(ldexp(1, power), e->spin[i]);
  }
  e->k.power += power;
  return gg_md_begin_at(e, gg_md_temperature(e), err);
}

/* Laboratory velocities change with the flow. */
static gg_status shear(gg_engine *engine, double rate, gg_error *err)
{
  gg_md *e = (gg_md *)engine;
  const double now = e->k.now, more = rate - e->model.shear_rate;
  if (!gg_model_is_sheared(&e->model)) return gg_base_fail(err, GG_BAD_INPUT, "md: this flow is not sheared");
  bring_to_present(e);
  gg_md_kicks_move(e, now);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->v.x += more * (g->r.y - 0.5 * e->box.edge[1]);
    if (e->last) e->last[i] -= now;
  }
  e->model.shear_rate = rate;
  e->box.image_velocity = rate * e->box.edge[1];
  return predict_present(e, err);
}

/* Multiply all times and velocities by exact powers of two. */
static gg_status rescale(gg_engine *engine, int power, gg_error *err)
{
  gg_md *e = (gg_md *)engine;
  if (e->model.linear_response) return begin_sweep(e, power, err);
  if (gg_model_is_sheared(&e->model) || e->model.walled || e->heat != GG_UNHEATED || e->model.turns)
    return gg_base_fail(err, GG_BAD_INPUT, "velocities cannot be rescaled in a driven flow: the drive sets the clock");
  double v = ldexp(1, power), t = ldexp(1, -power);
  e->k.power += power;
  for (uint32_t i = 0; i < e->n; i++) {
    e->grain[i].v = gg_scale(v, e->grain[i].v);
    e->grain[i].t *= t;
    e->node[i].time *= t;
    e->node[i].collision *= t;
    if (e->spin) e->spin[i] = gg_scale(v, e->spin[i]);
    if (e->last) e->last[i] *= t;
    e->node[i].skin_time *= t;
  }
  gg_md_queue_rescale(&e->queue, t);
  double *times[] = {&e->k.now,         &e->k.epoch_start, &e->k.contact_time, &e->k.mean_free_time,
                     &e->k.window_time, &e->k.mark};
  for (size_t k = 0; k < sizeof times / sizeof *times; k++) *times[k] *= t;
  return GG_OK;
}

static gg_status set_callback(gg_engine *engine, gg_collision_callback *callback, void *context, gg_error *err)
{
  gg_md *e = (gg_md *)engine;
  if (callback && !e->last) GG_TRY(gg_md_allocate_last(e, err));
  e->callback = callback;
  e->callback_context = context;
  gg_md_select(e);
  return GG_OK;
}

const gg_engine_ops gg_md_ops = {
    .name = "md",
    .doc = "event-driven molecular dynamics of hard spheres",
    .accepts = gg_md_accepts,
    .bytes = gg_md_bytes,
    .nanoseconds = gg_md_nanoseconds,
    .create = create,
    .create_with = create_with,
    .destroy = destroy,
    .advance = advance,
    .keep_images = gg_md_keep_images,
    .take_sums = take_sums,
    .set_callback = set_callback,
    .threads = threads,
    .state = state,
    .snapshot = gg_md_snapshot,
    .rescale = rescale,
    .shear = shear,
    .save = gg_md_save,
    .restore = restore,
    .describe = gg_md_describe,
    .go_on = go_on,
};
