#include "run/replicas.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/memory.h"
#include "run/cost_estimate.h"
#include "run/scheduler.h"
#include "run/start_model.h"
#include "run/workers/workers.h"
#include "scene/fields.h"

static gg_status create_replicas(gg_replicas *all, gg_error *err)
{
  if (all->share) return gg_run_share_create(all->share, err);
  for (int i = 0; i < all->n; i++) GG_TRY(gg_run_replica_create(&all->replica[i], &all->scene, &all->model, i, err));
  return GG_OK;
}

/* Threads go to replicas first; what is left over, in equal parts to each. */
static void share_threads(gg_replicas *all)
{
  for (int i = 0; i < all->n; i++) {
    gg_engine *engine = all->replica[i].engine;
    if (all->threads >= 2 * all->n && engine->ops->threads) engine->ops->threads(engine, all->threads / all->n);
  }
}

gg_status gg_run_replicas_create(gg_replicas *all, const gg_scene *scene, const gg_archive *resume, int threads,
                                 const gg_hooks *hooks, gg_error *err)
{
  *all = (gg_replicas){.scene = *scene, .threads = threads, .n = (int)scene->run.replicas, .hooks = hooks};
  all->started = all->last_checkpoint = gg_base_clock_wall();
  all->last.relative_error = NAN; /* nothing is estimated yet */
  if (resume) GG_TRY(gg_scene_resumption_settle(&all->scene, resume, err));
  scene = &all->scene;
  GG_TRY(gg_run_start_make(scene, &all->model, err));
  GG_TRY(gg_run_engine_ops_of(scene->engine)->accepts(&all->model, err));
  all->plan = gg_run_criteria_of(scene, &all->model);
  const gg_forecast forecast = gg_run_cost_estimate(scene, &all->model, scene->engine);
  GG_TRY(gg_run_cost_check_memory(&forecast, gg_run_engine_ops_of(scene->engine)->name, scene->run.replicas, err));
  all->replica = gg_base_array_new((size_t)all->n, sizeof *all->replica, err);
  if (!all->replica) return GG_FAILED;
  gg_run_replicas_watch(all);
  gg_status status = gg_run_share_open(all, &all->share, err);
  if (status == GG_OK) status = resume ? gg_run_replicas_restore(all, resume, err) : create_replicas(all, err);
  if (status == GG_INTERRUPTED && all->stopped == GG_OUT_OF_TIME)
    status = gg_base_fail(err, GG_FAILED, "%s: the time limit struck before the start was done",
                          gg_run_engine_ops_of(scene->engine)->name);
  if (status != GG_OK)
    gg_run_replicas_clear(all);
  else if (!all->share)
    share_threads(all);
  return status;
}

void gg_run_replicas_clear(gg_replicas *all)
{
  gg_run_share_close(all->share);
  all->share = NULL;
  for (int i = 0; all->replica && i < all->n; i++) gg_run_replica_clear(&all->replica[i]);
  free(all->replica);
  all->replica = NULL;
  gg_run_replicas_unwatch(all);
}

static gg_status locked_frame(void *context, const gg_frame *frame, gg_error *err)
{
  gg_replicas *all = context;
  pthread_mutex_lock(&all->lock);
  gg_status status = all->hooks->frame(all->hooks->context, frame, err);
  pthread_mutex_unlock(&all->lock);
  return status;
}

/* Replicas are dealt out to threads: worker w takes w, w + threads, ... Nothing of a replica depends on who runs it. */
typedef struct worker {
  gg_replicas *all;
  int first, stride;
  uint64_t due;
  bool adapt;
  const gg_hooks *hooks;
  gg_status status;
  gg_error err;
} worker;

static void *work(void *argument)
{
  worker *w = argument;
  gg_replicas *all = w->all;
  for (int i = w->first; i < all->n && w->status == GG_OK; i += w->stride)
    w->status = gg_run_replica_advance(&all->replica[i], w->due, w->adapt, w->hooks, &w->err);
  return NULL;
}

gg_status gg_run_replicas_advance(gg_replicas *all, uint64_t due, bool adapt, gg_error *err)
{
  enum { MOST_THREADS = 64 };
  if (all->share) return gg_run_share_advance(all->share, due, adapt, err);
  gg_hooks hooks = {.context = all};
  if (all->hooks && all->hooks->frame) hooks.frame = locked_frame;
  if (all->hooks && all->hooks->crew) return gg_run_crew_advance(all->hooks->crew, all, due, adapt, &hooks, err);
  int n = all->threads < all->n ? all->threads : all->n;
  n = n < 1 ? 1 : n > MOST_THREADS ? MOST_THREADS : n;
  worker workers[MOST_THREADS];
  pthread_t threads[MOST_THREADS];
  bool running[MOST_THREADS] = {false};
  for (int w = 0; w < n; w++) {
    workers[w] =
        (worker){.all = all, .first = w, .stride = n, .due = due, .adapt = adapt, .hooks = &hooks, .status = GG_OK};
    if (w > 0) running[w] = pthread_create(&threads[w], NULL, work, &workers[w]) == 0;
  }
  for (int w = 0; w < n; w++)
    if (!running[w]) work(&workers[w]);
  for (int w = 0; w < n; w++)
    if (running[w]) pthread_join(threads[w], NULL);
  for (int w = 0; w < n; w++)
    if (workers[w].status != GG_OK) {
      if (err) *err = workers[w].err;
      return workers[w].status;
    }
  return GG_OK;
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
    if (all->replica[i].bins[k].per_block > per_block) per_block = all->replica[i].bins[k].per_block;
  for (int i = 0; i < all->n; i++)
    if (all->replica[i].bins[k].sum) gg_statistics_bins_coarsen(&all->replica[i].bins[k], per_block);
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
  for (int k = 0; k < all->replica[0].n_observables; k++) level_bins(all, k);
}
