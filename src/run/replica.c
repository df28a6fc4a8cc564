/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/replica.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "common/engine_grains.h"
#include "common/linear_response.h"
#include "common/rng.h"
#include "run/protocol_times.h"
#include "scene/fields.h"

/* Without a warm-up the window is open from the start. */
static bool leaves_out_warmup(const gg_scene *scene)
{
  return scene->output.after == GG_AFTER_WARMUP && scene->run.warmup != 0;
}

static gg_status keep_images(gg_replica *r, gg_error *err)
{
  r->images = r->trajectory_every > 0 && r->engine->ops->keep_images;
  return r->images ? r->engine->ops->keep_images(r->engine, err) : GG_OK;
}

static void sample_row(gg_replica *r, double elapsed)
{
  gg_measure_sampler_row(&r->sampler, r->engine, elapsed, r->clock.velocity_factor, r->clock.averaging);
  r->clock.velocity_factor = 1;
}

static gg_status observe_collisions(gg_replica *r, gg_error *err)
{
  return gg_measure_sampler_observe(&r->sampler, r->engine, r->clock.window_samples, r->clock.part, err);
}

gg_status gg_run_replica_create(gg_replica *r, const gg_scene *scene, const gg_model *model, int index, gg_error *err)
{
  memset(r, 0, sizeof *r);
  r->model = *model;
  r->scene = *scene;
  r->clock.temperature = model->temperature0;
  r->logged = index == 0 && *scene->output.log;
  r->trajectory_every = r->clock.frame_every = index == 0 ? scene->output.trajectory_every : 0;
  r->frames_of_window = leaves_out_warmup(scene);
  r->clock.velocity_factor = 1;
  const gg_engine_ops *ops = gg_common_engine_of(scene->engine);
  uint64_t stream = (uint64_t)index * GG_STREAMS_PER_REPLICA;
  gg_status status = gg_run_replica_setup_observables(r, scene, err);
  if (status == GG_OK) status = ops->create(model, scene->run.seed, stream, &r->engine, err);
  if (status != GG_OK) {
    gg_run_replica_clear(r);
    return status;
  }
  GG_TRY(keep_images(r, err));
  r->clock.interval = GG_SAMPLING_INTERVAL / gg_common_model_collision_rate(model, model->temperature0);
  sample_row(r, 0);
  if (gg_scene_is_followed(scene))
    gg_statistics_series_add(&r->series, 0, r->sampler.row); /* curves begin at the start */
  return GG_OK;
}

void gg_run_replica_clear(gg_replica *r)
{
  gg_measure_sampler_clear(&r->sampler);
  if (r->engine) r->engine->ops->destroy(r->engine);
  gg_statistics_series_clear(&r->series);
  memset(r, 0, sizeof *r);
}

static uint64_t collisions(const gg_replica *r)
{
  return gg_engine_state_of(r->engine).collisions;
}

double gg_run_replica_collisions_per_grain(const gg_replica *r)
{
  return 2 * (double)collisions(r) / (double)r->model.n;
}

/* Processor time of all threads that work for the replica. */
static double cpu_used(const gg_replica *r)
{
  return gg_base_clock_cpu() + gg_engine_state_of(r->engine).others_cpu;
}

/* Largest number of collisions of an interval, which ends there whatever the time. While intervals adapt: 16 times the
 * expected number, since the rate may have risen, as after a cold start. Later 1000 times: see check_collapse. */
static uint64_t most_collisions(const gg_replica *r, bool adapt)
{
  double expected = GG_SAMPLING_INTERVAL * (double)r->model.n / 2;
  return adapt ? (uint64_t)(16 * expected) + 1000 : (uint64_t)(1000 * expected) + 1000000;
}

/* Advance by one part of an interval, or by the rest of a part that was stopped. */
static gg_status advance_part(gg_replica *r, int part, int parts, bool adapt, gg_error *err)
{
  const gg_engine_ops *ops = r->engine->ops;
  bool cut = r->clock.part == part;
  r->clock.part = part;
  if (cut) return ops->go_on(r->engine, &r->clock.part_gone, err);
  return ops->advance(r->engine, r->clock.interval / parts, most_collisions(r, adapt), &r->clock.part_gone, err);
}

/* Advance by one sampling interval, whose parts end with snapshots of observables, or finish one that was stopped. */
static gg_status advance_interval(gg_replica *r, bool adapt, double *elapsed, uint64_t *happened, gg_error *err)
{
  struct gg_replica_clock *c = &r->clock;
  const int last = c->averaging ? gg_measure_sampler_parts(&r->sampler, c->interval, c->temperature) : 1;
  if (!c->part) c->gone = 0, c->happened = collisions(r);
  if (c->averaging) GG_TRY(observe_collisions(r, err));
  for (int part = c->part ? (int)c->part : 1; part <= last; part++) {
    GG_TRY(advance_part(r, part, last, adapt, err));
    c->gone += c->part_gone;
    if (c->averaging)
      gg_measure_sampler_curves(&r->sampler, r->engine, part, last, c->part_gone, c->velocity_factor,
                                c->window_samples);
  }
  if (c->averaging) c->window_samples++;
  *elapsed = c->gone;
  *happened = collisions(r) - c->happened;
  c->part = 0;
  return GG_OK;
}

/* Adapt the interval to the collision rate, by at most a factor of four at a time. The counted rate is that of the
 * middle of the interval. In a gas that cools or heats for ever the rate in the middle of the next interval differs by
 * the factor from the beginning of this one (temperature `before`) to now. Without this correction samples at e = 0
 * would be 1.5 collisions per grain apart. In other gases differences of temperature are noise. */
static void adapt_interval(gg_replica *r, double elapsed, uint64_t happened, double before)
{
  double per_grain = 2 * (double)happened / (double)r->model.n, now = r->clock.temperature;
  double factor = per_grain > 0 ? GG_SAMPLING_INTERVAL / per_grain : 4;
  if (!gg_model_keeps_temperature(&r->model) && before > 0 && now > 0) factor *= sqrt(before / now);
  r->clock.interval = elapsed * fmin(fmax(factor, 0.25), 4);
}

static gg_status rescale(gg_replica *r, int power, gg_error *err)
{
  GG_TRY(r->engine->ops->rescale(r->engine, power, err));
  r->clock.velocity_factor = ldexp(1, power);
  for (int k = 0; k < r->sampler.n_observables; k++)
    if (r->sampler.observable[k]->rescaled)
      r->sampler.observable[k]->rescaled(r->sampler.self[k], r->clock.velocity_factor);
  r->clock.interval = ldexp(r->clock.interval, -power);
  r->clock.temperature = ldexp(r->clock.temperature, 2 * power);
  return GG_OK;
}

/* Free cooling: bring the velocities back when they have fallen fourfold (T sixteenfold), the clock with them. Linear
 * response: at the end of a sweep of the reduced shear rate, which the collision rate shows, back to its beginning. */
static gg_status rescale_if_due(gg_replica *r, gg_error *err)
{
  if (!gg_flow_cools(r->model.flow) && !r->model.linear_response) return GG_OK;
  double T0 = r->model.temperature0, slowdown = r->clock.interval * gg_common_model_collision_rate(&r->model, T0);
  slowdown /= GG_SAMPLING_INTERVAL;
  if (r->model.linear_response) {
    bool over = gg_common_linear_response_ends(&r->model, T0 / (slowdown * slowdown));
    return over ? rescale(r, gg_common_linear_response_of(&r->model).power, err) : GG_OK;
  }
  if (gg_scene_is_followed(&r->scene)) slowdown = sqrt(T0 / r->clock.temperature);
  if (slowdown < 4) return GG_OK;
  r->clock.power += 2;
  return rescale(r, 2, err);
}

void gg_run_replica_date_frame(const gg_replica *r, gg_frame *frame)
{
  double unit = ldexp(1, -(int)r->clock.power), unit_time = ldexp(1, (int)r->clock.power);
  frame->time = r->clock.time + (r->clock.part ? unit_time * (r->clock.gone + r->clock.part_gone) : 0);
  for (size_t i = 0; i < 3 * frame->n && r->clock.power; i++) {
    frame->velocity[i] *= unit;
    if (frame->spin) frame->spin[i] *= unit;
  }
}

/* Frames are due at the multiples of trajectory_every, and at the first sample. */
static double next_frame(const gg_replica *r)
{
  return r->trajectory_every * (floor(gg_run_replica_collisions_per_grain(r) / r->trajectory_every) + 1);
}

static gg_status emit_frame(gg_replica *r, const gg_run_callbacks *callbacks, gg_error *err)
{
  if (!(r->trajectory_every > 0) || gg_run_replica_collisions_per_grain(r) < r->clock.next_frame) return GG_OK;
  r->clock.next_frame = next_frame(r);
  if (r->frames_of_window && !r->clock.window_collisions) return GG_OK; /* no window was opened yet */
  if (!callbacks || !callbacks->frame) return GG_OK;
  GG_CLEARED(gg_measure_frame_free) gg_frame frame = {0};
  GG_TRY(gg_measure_frame_take(r->engine, &r->model, r->images, &frame, err));
  gg_run_replica_date_frame(r, &frame);
  return callbacks->frame(callbacks->context, &frame, err);
}

/* Temperature in the engine's units, from the last row: rows hold log T in units of the start; in linear response,
 * whose sweeps go through any scale, T itself. The starting temperature where T is not measured. */
static double temperature_now(const gg_replica *r)
{
  const gg_observable *o = r->sampler.n_observables ? r->sampler.observable[0] : NULL;
  const double *row = o ? r->sampler.row + r->sampler.offset[0] : NULL;
  gg_function f;
  if (r->model.linear_response && o && gg_measure_derived_find(o->rows->derived, GG_Q_TEMPERATURE, &f))
    return gg_function_value(f, row, &r->model);
  if (!o || !o->rows->log_temperature) return r->model.temperature0;
  return exp(o->rows->log_temperature(row) + 2 * M_LN2 * (double)r->clock.power);
}

gg_status gg_run_replica_collapsed(const gg_replica *r, gg_error *err)
{
  const char *unit = gg_common_model_contact_unit(&r->model), *name = r->engine->ops->name;
  gg_base_fail(err, GG_FAILED,
               "%s: collisions accumulate without end (inelastic collapse) near time %g; give md.contact_time a larger "
               "value (it is %g %s)",
               name, r->clock.time, r->model.contact_time, unit);
  if (err) err->cause = GG_CAUSE_COLLAPSE;
  return GG_FAILED;
}

/* Detect inelastic collapse. An interval ends early where the collision rate has risen, as from a cold start; the rate
 * then fits the temperature. A rate a thousand times that of the temperature is a collapse that no contact-time rule
 * prevented, and so are many early ends in a row. */
static gg_status check_collapse(gg_replica *r, bool adapt, double elapsed, uint64_t happened, gg_error *err)
{
  enum { MOST_CUT_SHORT = 60 };
  bool cut_short = happened >= most_collisions(r, adapt);
  r->clock.cut_short = cut_short ? r->clock.cut_short + 1 : 0;
  if (!cut_short) return GG_OK;
  double per_grain = 2 * (double)happened / (double)r->model.n;
  bool runaway = !(per_grain < 1000 * elapsed * gg_common_model_collision_rate(&r->model, r->clock.temperature));
  if (runaway || r->clock.cut_short >= MOST_CUT_SHORT) return gg_run_replica_collapsed(r, err);
  if (adapt) return GG_OK;
  return gg_base_fail(err, GG_FAILED,
                      "%s: collisions come a thousand times faster near time %g than when averaging began: the gas "
                      "still heats up; give run.warmup a larger value",
                      r->engine->ops->name, r->clock.time);
}

/* Set the interval of a transient run to end at the next sampling time, in the engine's units; rounding may have left
 * no time, so it is at least 1e-9 of the distance. */
static void set_interval_to_next_time(gg_replica *r)
{
  const double from = gg_run_protocol_time(&r->scene, r->clock.samples),
               to = gg_run_protocol_time(&r->scene, r->clock.samples + 1);
  r->clock.interval = ldexp(fmax(to - r->clock.time, 1e-9 * (to - from)), -(int)r->clock.power);
}

/* The engine continues with what the protocol changes at this sample. */
static gg_status change(gg_replica *r, const gg_model *model, gg_error *err)
{
  gg_engine *next;
  GG_TRY(gg_common_engine_continue(r->engine, model, &next, err));
  r->engine->ops->destroy(r->engine);
  r->engine = next;
  r->model = *model; /* which the observables borrow */
  if (r->clock.averaging) r->clock.window_samples = 0;
  gg_measure_sampler_change(&r->sampler, r->engine, r->clock.averaging);
  return GG_OK;
}

static gg_status change_if_due(gg_replica *r, gg_error *err)
{
  if (!gg_scene_is_followed(&r->scene)) return GG_OK;
  const int changes = gg_run_protocol_changes(&r->scene, r->clock.samples);
  if (changes == r->clock.changes) return GG_OK;
  GG_FREED gg_model *model = gg_base_array_new(1, sizeof *model, err);
  if (!model) return GG_FAILED;
  GG_TRY(gg_run_protocol_model(&r->scene, &r->model, changes, model, err));
  if (gg_scene_shear_steps(&r->scene) > 0) model->shear_rate = r->model.shear_rate;
  GG_TRY(change(r, model, err));
  return r->clock.changes = changes, GG_OK;
}

/* The next step of a shear rate that is a formula of time. */
static gg_status shear_if_due(gg_replica *r, gg_error *err)
{
  if (gg_scene_shear_steps(&r->scene) == 0) return GG_OK;
  const double rate = gg_run_protocol_shear_rate(&r->scene, r->clock.samples);
  if (rate != r->model.shear_rate) GG_TRY(r->engine->ops->shear(r->engine, rate, err));
  r->model.shear_rate = rate;
  return GG_OK;
}

static gg_status take_sample(gg_replica *r, bool adapt, gg_error *err)
{
  double elapsed;
  uint64_t happened;
  const double before = r->clock.temperature;
  GG_TRY(change_if_due(r, err)); /* a change that was interrupted */
  if (gg_scene_is_followed(&r->scene) && !r->clock.part) set_interval_to_next_time(r);
  GG_TRY(advance_interval(r, adapt, &elapsed, &happened, err));
  sample_row(r, elapsed);
  r->clock.temperature = temperature_now(r);
  r->clock.time += ldexp(elapsed, (int)r->clock.power);
  if (!isfinite(r->clock.temperature)) /* NaN never recovers: fail now */
    return gg_base_fail(err, GG_FAILED, "%s: the temperature became NaN or infinite near time %g", r->engine->ops->name,
                        r->clock.time);
  GG_TRY(check_collapse(r, adapt, elapsed, happened, err));
  gg_statistics_series_add(&r->series, r->clock.time, r->sampler.row);
  r->clock.samples++;
  if (adapt) adapt_interval(r, elapsed, happened, before);
  GG_TRY(shear_if_due(r, err));
  GG_TRY(change_if_due(r, err));
  return rescale_if_due(r, err);
}

static gg_status sample_once(gg_replica *r, bool adapt, gg_error *err)
{
  double start = cpu_used(r);
  gg_status status = take_sample(r, adapt, err);
  r->clock.cpu += cpu_used(r) - start;
  return status;
}

gg_status gg_run_replica_advance(gg_replica *r, uint64_t samples, bool adapt, const gg_run_callbacks *callbacks,
                                 gg_error *err)
{
  gg_status status = GG_OK;
  adapt = adapt && !gg_scene_is_followed(&r->scene);
  while (status == GG_OK && r->clock.samples < samples) {
    if (gg_stop_asked(r->model.stop)) status = gg_base_fail(err, GG_INTERRUPTED, "interrupted");
    if (status == GG_OK) status = sample_once(r, adapt, err);
    if (status == GG_OK && r->logged && callbacks && callbacks->sample)
      status = callbacks->sample(callbacks->context, r, err);
    if (status == GG_OK) status = emit_frame(r, callbacks, err);
  }
  return gg_base_callback_settle(status, err);
}

bool gg_run_replica_interval_fits(const gg_replica *r, double most)
{
  if (gg_scene_is_followed(&r->scene)) return true; /* sampling times are given */
  if (r->model.gravity[1] != 0) return true;        /* grains at rest have any collision rate */
  double per_grain = r->clock.interval * gg_common_model_collision_rate(&r->model, r->clock.temperature);
  return !r->clock.cut_short && per_grain > GG_SAMPLING_INTERVAL / most;
}

gg_status gg_run_replica_open_window(gg_replica *r, gg_error *err)
{
  gg_statistics_series_open_window(&r->series);
  r->clock.window_collisions = collisions(r);
  r->clock.window_cpu = r->clock.cpu;
  r->clock.averaging = 1;
  r->clock.window_samples = 0;
  gg_measure_sampler_restart(&r->sampler, r->engine);
  return observe_collisions(r, err);
}

gg_status gg_run_replica_save(const gg_replica *r, gg_archive *a, gg_error *err)
{
  GG_TRY(r->engine->ops->save(r->engine, a, err));
  GG_TRY(gg_statistics_series_save(&r->series, a, err));
  GG_TRY(gg_base_archive_put(a, "replica/clock", GG_ITEM_U8, &r->clock, sizeof r->clock, err));
  return gg_measure_sampler_save(&r->sampler, a, err);
}

/* Validate the restored clock. */
static gg_status check_clock(const gg_replica *r, gg_error *err)
{
  const struct gg_replica_clock *c = &r->clock;
  const double plain[] = {c->temperature, c->velocity_factor, c->gone, c->part_gone, c->cpu, c->window_cpu};
  bool good = c->time >= 0 /* or infinite */ && c->interval > 0 && c->interval < 1e300 && c->part >= 0 &&
              c->part <= gg_measure_sampler_parts(&r->sampler, c->interval, c->temperature) && c->power > -1000000000 &&
              c->power < 1000000000 && !isnan(c->next_frame) && !isnan(c->frame_every);
  for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) good = good && isfinite(plain[i]);
  return good ? GG_OK : gg_base_fail(err, GG_BAD_FILE, "the checkpoint is damaged: the clock of a replica");
}

static gg_status restore_changes(gg_replica *r, int changes, gg_error *err)
{
  GG_FREED gg_model *model = gg_base_array_new(1, sizeof *model, err);
  if (!model) return GG_FAILED;
  GG_TRY(gg_run_protocol_model(&r->scene, &r->model, changes, model, err));
  return r->model = *model, GG_OK;
}

/* Apply the changes of the protocol, and the shear rate, that the saved engine had. */
static gg_status restore_model(gg_replica *r, gg_error *err)
{
  const int64_t changes = r->clock.changes;
  if (changes < 0 || changes > gg_scene_protocol_count(&r->scene, INFINITY))
    return gg_base_fail(err, GG_BAD_FILE, "the checkpoint is damaged: the protocol of a replica");
  if (changes) GG_TRY(restore_changes(r, (int)changes, err));
  if (gg_scene_shear_steps(&r->scene) > 0)
    r->model.shear_rate = gg_run_protocol_shear_rate(&r->scene, r->clock.samples);
  return GG_OK;
}

gg_status gg_run_replica_restore(gg_replica *r, const gg_archive *a, const gg_scene *scene, const gg_model *model,
                                 int index, gg_error *err)
{
  memset(r, 0, sizeof *r);
  r->model = *model;
  r->scene = *scene;
  r->trajectory_every = index == 0 ? scene->output.trajectory_every : 0;
  r->logged = index == 0 && *scene->output.log;
  r->frames_of_window = leaves_out_warmup(scene);
  gg_status status = gg_base_archive_get(a, "replica/clock", GG_ITEM_U8, &r->clock, sizeof r->clock, err);
  if (status == GG_OK) status = restore_model(r, err);
  if (status == GG_OK) status = gg_run_replica_setup_observables(r, scene, err);
  if (status == GG_OK) status = check_clock(r, err);
  if (status == GG_OK) status = gg_common_engine_of(scene->engine)->restore(&r->model, a, &r->engine, err);
  if (status == GG_OK) status = keep_images(r, err);
  if (status == GG_OK) status = gg_statistics_series_restore(&r->series, a, err);
  if (status == GG_OK) status = gg_measure_sampler_restore(&r->sampler, a, err);
  if (status == GG_OK && r->clock.frame_every != r->trajectory_every) {
    /* a resumed run may request frames at other intervals */
    r->clock.frame_every = r->trajectory_every;
    if (r->trajectory_every > 0 && r->clock.samples > 0) r->clock.next_frame = next_frame(r);
  }
  if (status != GG_OK) gg_run_replica_clear(r);
  return status;
}
