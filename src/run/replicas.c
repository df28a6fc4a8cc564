/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replicas are created and take samples, as tasks of the scheduler, until the run's callback or the time limit stops
 * them. */
#include "run/replicas.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "graingas.h"
#include "run/cost_estimate.h"
#include "run/protocol_times.h"
#include "run/run.h"
#include "run/workers/workers.h"
#include "scene/fields.h"

/* The replicas in an archive: everything needed to continue bit for bit. */

gg_status gg_run_replicas_save(const gg_replicas *all, gg_archive *a, gg_error *err)
{
  struct gg_replicas_state state = all->state;
  state.wall += gg_base_clock_wall() - all->started;
  GG_TRY(gg_scene_resumption_put(&all->scene, a, err));
  GG_TRY(gg_base_archive_put(a, "campaign/state", GG_ITEM_U8, &state, sizeof state, err));
  for (int i = 0; i < all->n; i++) {
    GG_CLEARED(gg_base_archive_clear) gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    GG_TRY(gg_run_replica_save(&all->replica[i], &one, err));
    GG_TRY(gg_base_archive_nest(a, prefix, &one, err));
  }
  return GG_OK;
}

static gg_status check_kind(const gg_archive *a, gg_error *err)
{
  if (gg_base_archive_find(a, "md/campaign/state") || gg_base_archive_find(a, "dsmc/campaign/state"))
    return GG_REFUSE(err, "the checkpoint is one of a comparison: only a comparison can resume it");
  if (gg_base_archive_find(a, "simulation/scene"))
    return GG_REFUSE(err, "the checkpoint is a saved simulation, not one of a run");
  return GG_OK;
}

static gg_status restore(gg_replicas *all, const gg_archive *a, gg_error *err)
{
  GG_TRY(check_kind(a, err));
  GG_TRY(gg_scene_resumption_check(&all->scene, a, err));
  GG_TRY(gg_base_archive_get(a, "campaign/state", GG_ITEM_U8, &all->state, sizeof all->state, err));
  for (int i = 0; i < all->n; i++) {
    GG_CLEARED(gg_base_archive_clear) gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    GG_TRY(gg_base_archive_unnest(&one, prefix, a, err));
    GG_TRY(gg_run_replica_restore(&all->replica[i], &one, &all->scene, &all->model, i, err));
  }
  return GG_OK;
}

/* Number of samples that every replica has, at most `due`. Replicas differ if a run was stopped within a step. */
static uint64_t least_samples(const gg_archive *a, uint64_t due)
{
  uint64_t least = due;
  for (int i = 0;; i++) {
    char name[48];
    struct gg_replica_clock clock;
    snprintf(name, sizeof name, "replica%d/replica/clock", i);
    if (gg_base_archive_get(a, name, GG_ITEM_U8, &clock, sizeof clock, NULL) != GG_OK) return least;
    if (clock.samples < least) least = clock.samples;
  }
}

gg_status gg_run_how_far(const gg_archive *a, gg_checkpoint_part *part, gg_error *err)
{
  struct gg_replicas_state state;
  GG_TRY(gg_base_archive_get(a, "campaign/state", GG_ITEM_U8, &state, sizeof state, err));
  const uint64_t taken = least_samples(a, state.due);
  double window = state.averaging && taken > state.window_at ? (double)(taken - state.window_at) : 0;
  part->phase = state.averaging ? "averaging" : "warm-up";
  part->collisions_per_grain = (double)taken * GG_SAMPLING_INTERVAL;
  part->averaged = window * GG_SAMPLING_INTERVAL;
  part->seconds = state.wall;
  return GG_OK;
}

static bool is_interrupted(gg_replicas *all)
{
  if (!all->callbacks || !all->callbacks->interrupted) return false;
  GG_LOCKED(&all->lock);
  return all->callbacks->interrupted(all->callbacks->context);
}

/* Report progress during dense starts, which take seconds. Any thread that polls is_stopped does it, since the
 * controller may itself be placing grains. */
static void report_start(gg_replicas *all)
{
  const double between = 0.5;
  if (!all->starting || !all->callbacks || !all->callbacks->progress) return;
  if (pthread_mutex_trylock(&all->lock) != 0) return;
  const double now = gg_base_clock_wall(), limit = all->criteria.time_limit;
  if (now - fmax(all->started, all->start_reported) > between) {
    all->start_reported = now;
    const gg_progress p = {.engine = gg_common_engine_of(all->scene.engine)->name,
                           .phase = "start",
                           .relative_error = NAN,
                           .time_left = NAN,
                           .limit_in = limit > 0 ? fmax(limit - (now - all->started), 0) : INFINITY,
                           .replicas = all->n};
    all->callbacks->progress(all->callbacks->context, &p);
  }
  pthread_mutex_unlock(&all->lock);
}

/* Polled by all threads that work on a replica, engines within an interval included. A stopped run stays stopped. */
static bool is_stopped(void *context)
{
  gg_replicas *all = context;
  report_start(all);
  if (atomic_load(&all->stopped) != GG_NOT_STOPPED || atomic_load(&all->tasks.stopping)) return true;
  const double limit = all->criteria.time_limit;
  int why = is_interrupted(all)                                                          ? GG_STOP_REQUESTED
            : limit > 0 && all->state.wall + gg_base_clock_wall() - all->started > limit ? GG_OUT_OF_TIME
                                                                                         : GG_NOT_STOPPED,
      before = GG_NOT_STOPPED;
  if (why != GG_NOT_STOPPED) atomic_compare_exchange_strong(&all->stopped, &before, why);
  return why != GG_NOT_STOPPED;
}

static gg_status locked_frame(void *context, const gg_frame *frame, gg_error *err)
{
  gg_replicas *all = context;
  GG_LOCKED(&all->lock);
  return all->callbacks->frame(all->callbacks->context, frame, err);
}

static gg_status locked_sample(void *context, const gg_replica *replica, gg_error *err)
{
  gg_replicas *all = context;
  GG_LOCKED(&all->lock);
  return all->callbacks->sample(all->callbacks->context, replica, err);
}

/* Replicas come first; threads that are left over go to their engines, in equal parts. */
static int threads_each(int threads, int replicas)
{
  return threads >= 2 * replicas ? threads / replicas : 1;
}

static gg_status find_scheduler(gg_replicas *all, int threads, gg_run_scheduler **scheduler, gg_error *err)
{
  *scheduler = all->callbacks ? all->callbacks->scheduler : NULL;
  if (*scheduler) return GG_OK;
  GG_TRY(gg_run_scheduler_new(threads, false, &all->own_scheduler, err));
  gg_run_scheduler_enter(all->own_scheduler);
  *scheduler = all->own_scheduler;
  return GG_OK;
}

static gg_status open_tasks(gg_replicas *all, int threads, gg_error *err)
{
  all->task_callbacks = (gg_run_callbacks){.context = all,
                                           .frame = all->callbacks && all->callbacks->frame ? locked_frame : NULL,
                                           .sample = all->callbacks && all->callbacks->sample ? locked_sample : NULL};
  all->tasks = (gg_run_tasks){.scene = &all->scene, .model = &all->model, .callbacks = &all->task_callbacks};
  gg_workers *workers = all->callbacks && !all->scene.extension ? all->callbacks->workers : NULL;
  gg_run_scheduler *scheduler = workers ? gg_run_workers_scheduler(workers) : NULL;
  if (!workers) GG_TRY(find_scheduler(all, threads, &scheduler, err));
  GG_TRY(gg_run_tasks_open(&all->tasks, scheduler, all->replica, all->n, threads_each(threads, all->n), err));
  return workers ? gg_run_distribution_open(workers, &all->tasks, err) : GG_OK;
}

/* The first failure, or else the first that was stopped, unless that was for a checkpoint. */
static gg_status outcome(gg_replicas *all, gg_error *err)
{
  const gg_run_task *worst = NULL;
  for (int i = 0; i < all->n; i++) {
    const gg_run_task *t = &all->tasks.task[i];
    if (t->status != GG_OK && (!worst || (worst->status == GG_INTERRUPTED && t->status != GG_INTERRUPTED))) worst = t;
  }
  if (!worst || (worst->status == GG_INTERRUPTED && atomic_load(&all->stopped) == GG_NOT_STOPPED)) return GG_OK;
  if (err) *err = worst->err;
  return worst->status;
}

gg_status gg_run_replicas_advance(gg_replicas *all, uint64_t due, bool adapt, bool (*pauses)(gg_replicas *all),
                                  gg_error *err)
{
  const double error = all->last.relative_error;
  gg_run_submit(&all->tasks, due, adapt, isnan(error) ? INFINITY : error);
  while (!gg_run_wait(&all->tasks))
    if (is_stopped(all) || (pauses && pauses(all))) gg_run_stop(&all->tasks);
  atomic_store(&all->tasks.stopping, false);
  return outcome(all, err);
}

static gg_status create_or_restore(gg_replicas *all, const gg_archive *resume, gg_error *err)
{
  if (!resume) {
    all->starting = true;
    const gg_status status = gg_run_replicas_advance(all, 0, false, NULL, err);
    all->starting = false;
    return status;
  }
  GG_TRY(restore(all, resume, err));
  for (int i = 0; i < all->n; i++) gg_run_task_update(&all->tasks.task[i]);
  return GG_OK;
}

/* A quantity with a requested error has a mean in this scene, by an observable that it measures. */
static gg_status check_until(const gg_replicas *all, gg_error *err)
{
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++) {
    if (!(all->scene.run.until[q] > 0)) continue;
    const char *why = gg_common_quantity_missing(&all->model, q);
    if (!why && !(all->scene.measure & GG_MEASURE_RHEOLOGY)) why = "measure has no rheology";
    if (why) return GG_REFUSE(err, "run.until: %s has no mean in this scene: %s", gg_common_quantity_name(q), why);
  }
  return GG_OK;
}

static gg_status prepare(gg_replicas *all, const gg_archive *resume, gg_error *err)
{
  const gg_scene *scene = &all->scene;
  const gg_model *made =
      all->callbacks && !resume && scene->fixed.contact_time == GG_AUTO ? all->callbacks->model : NULL;
  if (resume) GG_TRY(gg_scene_resumption_settle(&all->scene, resume, err));
  GG_TRY(gg_run_start_make(scene, made, &all->stop, &all->model, err));
  if (all->callbacks && all->callbacks->model) all->model.start = all->callbacks->model->start; /* also of one raised */
  GG_TRY(gg_common_engine_of(scene->engine)->accepts(&all->model, err));
  GG_TRY(check_until(all, err));
  GG_TRY(gg_run_protocol_check(scene, &all->model, err));
  all->criteria = gg_run_criteria_of(scene, &all->model);
  const gg_cost_estimate cost = gg_run_cost_estimate(scene, &all->model, scene->engine);
  GG_TRY(gg_run_cost_check_memory(&cost, gg_common_engine_of(scene->engine)->name, scene->run.replicas, err));
  all->replica = gg_base_array_new((size_t)all->n, sizeof *all->replica, err);
  return all->replica ? GG_OK : GG_FAILED;
}

gg_status gg_run_replicas_create(gg_replicas *all, const gg_scene *scene, const gg_archive *resume, int threads,
                                 const gg_run_callbacks *callbacks, gg_error *err)
{
  memset(all, 0, sizeof *all);
  all->scene = *scene;
  all->n = (int)scene->run.replicas;
  all->callbacks = callbacks;
  all->started = all->last_checkpoint = gg_base_clock_wall();
  all->last.relative_error = NAN; /* nothing is estimated yet */
  pthread_mutex_init(&all->lock, NULL);
  all->stop = (gg_stop){is_stopped, all};
  gg_status status = prepare(all, resume, err);
  all->model.threads = threads_each(threads, all->n);
  if (status == GG_OK) status = open_tasks(all, threads, err);
  if (status == GG_OK) status = create_or_restore(all, resume, err);
  if (status == GG_INTERRUPTED && all->stopped == GG_OUT_OF_TIME)
    status = gg_base_fail(err, GG_FAILED, "%s: time limit reached before the start was done",
                          gg_common_engine_of(scene->engine)->name);
  if (status != GG_OK) gg_run_replicas_clear(all);
  return status;
}

/* Contact times beyond change means: 1e-3, at the densest and most dissipative, by a few per cent. */
#define MOST_CONTACT_TIME 1e-3

bool gg_run_replicas_can_raise(const gg_replicas *all)
{
  const double t = all->model.contact_time;
  return all->scene.md.contact_time == GG_AUTO && t > 0 && t < MOST_CONTACT_TIME * (1 - 1e-9) &&
         !(all->scene.output.trajectory_every > 0);
}

gg_status gg_run_replicas_raise(gg_replicas *all, int threads, gg_error *err)
{
  gg_scene scene = all->scene;
  const gg_run_callbacks *callbacks = all->callbacks;
  const double wall = all->state.wall + gg_base_clock_wall() - all->started;
  scene.fixed.contact_time = 10 * all->model.contact_time;
  gg_run_replicas_clear(all);
  GG_TRY(gg_run_replicas_create(all, &scene, NULL, threads, callbacks, err));
  all->state.wall = wall;
  return GG_OK;
}

void gg_run_replicas_clear(gg_replicas *all)
{
  gg_run_distribution_close(&all->tasks);
  gg_run_tasks_close(&all->tasks);
  gg_run_scheduler_free(all->own_scheduler);
  all->own_scheduler = NULL;
  for (int i = 0; all->replica && i < all->n; i++) gg_run_replica_clear(&all->replica[i]);
  free(all->replica);
  all->replica = NULL;
  if (all->stop.asked) pthread_mutex_destroy(&all->lock);
  all->stop.asked = NULL;
}

uint64_t gg_run_replicas_least(const gg_replicas *all)
{
  uint64_t least = all->state.due;
  for (int i = 0; i < all->n; i++)
    if (all->replica[i].clock.samples < least) least = all->replica[i].clock.samples;
  return least;
}

bool gg_run_replicas_are_level(const gg_replicas *all)
{
  return gg_run_replicas_least(all) == all->state.due;
}

static void level_bins(gg_replicas *all, int k)
{
  size_t per_block = 0;
  for (int i = 0; i < all->n; i++)
    if (all->replica[i].sampler.bins[k].per_block > per_block) per_block = all->replica[i].sampler.bins[k].per_block;
  for (int i = 0; i < all->n; i++)
    if (all->replica[i].sampler.bins[k].sum) gg_statistics_bins_coarsen(&all->replica[i].sampler.bins[k], per_block);
}

void gg_run_replicas_level(gg_replicas *all)
{
  size_t per_row = 0, rows = SIZE_MAX;
  for (int i = 0; i < all->n; i++) {
    const gg_replica *r = &all->replica[i];
    if (r->clock.samples < all->state.due) all->state.due = r->clock.samples;
    if (r->series.per_row > per_row) per_row = r->series.per_row;
  }
  for (int i = 0; i < all->n; i++) {
    gg_statistics_series_coarsen(&all->replica[i].series, per_row);
    if (all->replica[i].series.n < rows) rows = all->replica[i].series.n;
  }
  for (int i = 0; i < all->n; i++) all->replica[i].series.n = rows;
  for (int k = 0; k < all->replica[0].sampler.n_observables; k++) level_bins(all, k);
}
