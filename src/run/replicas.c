#include "run/campaign.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "run/clock.h"
#include "run/start.h"

static gg_status create_replicas(gg_campaign *c, gg_error *err)
{
  for (int i = 0; i < c->n; i++) GG_TRY(gg_replica_create(&c->replicas[i], &c->scene, &c->model, i, err));
  return GG_OK;
}

/* Threads go to replicas first; what is left over, in equal parts to each. */
static void share_threads(gg_campaign *c)
{
  for (int i = 0; i < c->n; i++) {
    gg_engine *engine = c->replicas[i].engine;
    if (c->threads >= 2 * c->n && engine->ops->threads) engine->ops->threads(engine, c->threads / c->n);
  }
}

gg_status gg_campaign_create(gg_campaign *c, const gg_scene *scene, const gg_archive *resume, int threads,
                             const gg_hooks *hooks, gg_error *err)
{
  *c = (gg_campaign){.scene = *scene, .threads = threads, .n = (int)scene->run.replicas, .hooks = hooks};
  GG_TRY(gg_model_make(scene, scene->engine, &c->model, err));
  GG_TRY(gg_engine_ops_of(scene->engine)->accepts(&c->model, err));
  if (scene->temperature == GG_AUTO) gg_start_near_steady(&c->model);
  c->plan = gg_plan_of(scene, &c->model);
  c->replicas = gg_new_array((size_t)c->n, sizeof *c->replicas, err);
  if (!c->replicas) return GG_FAILED;
  gg_status status = resume ? gg_campaign_restore(c, resume, err) : create_replicas(c, err);
  if (status == GG_OK)
    share_threads(c);
  else
    gg_campaign_clear(c);
  c->started = c->last_checkpoint = gg_wall_now();
  return status;
}

void gg_campaign_clear(gg_campaign *c)
{
  for (int i = 0; c->replicas && i < c->n; i++) gg_replica_clear(&c->replicas[i]);
  free(c->replicas);
  c->replicas = NULL;
}

/* Replicas share out their threads: worker w takes w, w + threads, ... Nothing of a replica depends on who runs it. */
typedef struct worker {
  gg_campaign *campaign;
  int first, stride;
  bool adapt;
  gg_status status;
  gg_error err;
} worker;

static void *work(void *argument)
{
  worker *w = argument;
  gg_campaign *c = w->campaign;
  for (int i = w->first; i < c->n && w->status == GG_OK; i += w->stride)
    w->status = gg_replica_sample(&c->replicas[i], c->state.due, w->adapt, c->hooks, &w->err);
  return NULL;
}

static gg_status sample_all(gg_campaign *c, bool adapt, gg_error *err)
{
  enum { MOST_THREADS = 64 };
  int n = c->threads < c->n ? c->threads : c->n;
  n = n < 1 ? 1 : n > MOST_THREADS ? MOST_THREADS : n;
  worker workers[MOST_THREADS];
  pthread_t threads[MOST_THREADS];
  bool running[MOST_THREADS] = {false};
  for (int w = 0; w < n; w++) {
    workers[w] = (worker){.campaign = c, .first = w, .stride = n, .adapt = adapt, .status = GG_OK};
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

/* Share of the phase that is done: by samples, or by the square of the error still missing. */
static double fraction_done(const gg_campaign *c)
{
  if (!c->state.averaging) return (double)c->state.due / (double)(c->plan.warmup ? c->plan.warmup : 1);
  double window = (double)(c->state.due - c->state.window_at);
  if (c->plan.most && !(c->plan.relative_error > 0)) return window / (double)c->plan.most;
  double by_length = window / (double)c->plan.least;
  double by_error = c->last.relative_error > 0 ? pow(c->plan.relative_error / c->last.relative_error, 2) : 0;
  double done = fmin(by_length, by_error);
  return c->plan.most ? fmax(done, window / (double)c->plan.most) : done;
}

static void tell_progress(gg_campaign *c)
{
  if (!c->hooks || !c->hooks->progress) return;
  double collisions = 0, cpu = 0;
  for (int i = 0; i < c->n; i++) {
    collisions += gg_replica_collisions_per_grain(&c->replicas[i]) * (double)c->model.n / 2;
    cpu += c->replicas[i].clock.cpu;
  }
  double elapsed = gg_wall_now() - c->started, done = fmin(fraction_done(c), 1);
  gg_progress p = {
      .engine = c->replicas[0].engine->ops->name,
      .phase = c->state.averaging ? "averaging" : "warm-up",
      .fraction = done,
      .collisions = (uint64_t)collisions,
      .rate = cpu > 0 ? collisions / cpu : 0,
      .relative_error = c->state.averaging ? c->last.relative_error : NAN,
      .time_left = c->state.averaging && done > 0.02 ? elapsed * (1 - done) / done : NAN,
      .replica = 0,
      .replicas = c->n,
  };
  c->hooks->progress(c->hooks->context, &p);
}

static gg_status store_checkpoint(gg_campaign *c, gg_error *err)
{
  gg_archive archive = {0};
  gg_status status = gg_campaign_save(c, &archive, err);
  if (status == GG_OK) status = c->hooks->checkpoint(c->hooks->context, &archive, err);
  gg_archive_clear(&archive);
  c->last_checkpoint = gg_wall_now();
  return status;
}

static bool checkpoints(const gg_campaign *c)
{
  return c->scene.output.checkpoint_every > 0 && c->hooks && c->hooks->checkpoint;
}

static bool out_of_time(const gg_campaign *c)
{
  return c->plan.time_limit > 0 && c->state.wall + gg_wall_now() - c->started > c->plan.time_limit;
}

/* Is there no point in going on, whatever was asked? */
static bool is_over(const gg_campaign *c)
{
  return out_of_time(c) || c->state.standstill > 0;
}

/* Let every replica reach `due` samples, in short rounds with a word to the user and a checkpoint between them. */
static gg_status go_to(gg_campaign *c, uint64_t due, gg_error *err)
{
  while (c->state.due < due || c->replicas[c->n - 1].clock.samples < c->state.due) {
    if (c->replicas[c->n - 1].clock.samples >= c->state.due) {
      uint64_t step = 1 + (uint64_t)(2e5 / (double)c->model.n); /* some tens of milliseconds */
      c->state.due = c->state.due + step < due ? c->state.due + step : due;
    }
    gg_status status = sample_all(c, !c->state.averaging || c->model.flow == GG_HCS || !c->model.steady, err);
    if (status == GG_INTERRUPTED && checkpoints(c)) GG_TRY(store_checkpoint(c, NULL));
    if (status != GG_OK) return status;
    gg_campaign_look_for_standstill(c);
    tell_progress(c);
    if (checkpoints(c) && gg_wall_now() - c->last_checkpoint > c->scene.output.checkpoint_every)
      GG_TRY(store_checkpoint(c, err));
    if (is_over(c)) return GG_OK;
  }
  return GG_OK;
}

/* A window of this length that still drifts is given up, and averaging begins anew after it; but not for ever. */
enum { MOST_RESTARTS = 6 };

/* Length that the window is to reach before it is judged again: grows by a quarter a time, and by half once errors are
 * as small as asked (see `finished`). */
static uint64_t next_length(const gg_campaign *c, uint64_t window)
{
  uint64_t least = c->plan.least << c->state.restarts;
  uint64_t next = window < least ? least : window + window / (c->state.exact ? 2 : 4);
  return c->plan.most && next > c->plan.most ? c->plan.most : next;
}

static gg_status open_window(gg_campaign *c, gg_error *err)
{
  for (int i = 0; i < c->n; i++) GG_TRY(gg_replica_open_window(&c->replicas[i], err));
  c->state.averaging = 1;
  c->state.exact = 0;
  c->state.window_at = c->state.due;
  c->state.goal = c->state.due + next_length(c, 0);
  return GG_OK;
}

static bool exact_enough(const gg_campaign *c, const gg_judgement *j, uint64_t window)
{
  return c->plan.relative_error > 0 && window >= c->plan.least && j->trusted &&
         j->relative_error <= c->plan.relative_error;
}

/* Is the window long, steady and exact enough? Who judges again and again, and stops as soon as an estimate of the
 * error is small, stops where it is too small. So the window goes on for half its length, and it is that estimate which
 * counts, and stands. */
static bool finished(gg_campaign *c, const gg_judgement *j, uint64_t window)
{
  if (c->plan.most && window >= c->plan.most) return true;
  if (window >= c->plan.longest << c->state.restarts) return true;
  bool before = c->state.exact;
  c->state.exact = exact_enough(c, j, window);
  return before && c->state.exact;
}

/* The next judging point belongs to the state, so that a resumed run judges where the uninterrupted one does. */
gg_status gg_campaign_execute(gg_campaign *c, gg_error *err)
{
  if (!c->state.averaging) {
    GG_TRY(go_to(c, c->plan.warmup, err));
    if (!is_over(c)) GG_TRY(open_window(c, err));
  }
  while (!is_over(c)) {
    GG_TRY(go_to(c, c->state.goal, err));
    if (c->state.due < c->state.goal) break; /* over on the way */
    uint64_t window = c->state.due - c->state.window_at;
    gg_judgement j;
    GG_TRY(gg_campaign_judge(c, &j, err));
    if (j.drifting && c->plan.find_steady && c->state.restarts < MOST_RESTARTS && window >= c->plan.least) {
      c->state.restarts++;
      GG_TRY(open_window(c, err));
    } else if (finished(c, &j, window)) {
      return GG_OK;
    } else {
      c->state.goal = c->state.window_at + next_length(c, window);
    }
  }
  return checkpoints(c) ? store_checkpoint(c, err) : GG_OK; /* over before its time */
}
