/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gg_sweep_run: runs the missing points of a folder, several at a time. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "api/api.h"
#include "api/run.h"
#include "base/clock.h"
#include "base/memory.h"
#include "base/text.h"
#include "run/scheduler.h"
#include "sweep/folder.h"

typedef enum item_state { PENDING, RUNNING, ELSEWHERE, ENDED, REPORTED } item_state;

typedef struct item { /* a missing point */
  size_t i;           /* index in the sweep */
  item_state state;   /* ELSEWHERE: another process ran it at the last check */
  gg_status status;
  bool incomplete; /* ended before its stopping criteria */
  bool here;       /* run by this process */
  double checked;  /* wall time of the last check; before the run the estimated seconds */
  double fraction, relative_error;
  char message[512];
} item;

typedef struct sweep_run {
  gg_sweep *sweep;
  const char *folder;
  gg_sweep_options options;
  int threads_each;            /* threads of a point */
  gg_run_scheduler *scheduler; /* shared by all points; NULL: that of the workers */
  atomic_bool stopped;
  pthread_mutex_t lock; /* protects all members below */
  pthread_cond_t changed;
  size_t n;
  item *item;
  size_t done_before, incomplete_before; /* points with a file at the start; of these, incomplete ones */
  double started;                        /* wall time */
  size_t working;                        /* controllers that have not ended */
  gg_string_list warnings;
  size_t warned; /* number of reported warnings */
} sweep_run;

typedef struct controller {
  gg_run_controller thread;
  sweep_run *all;
  item *item;
  bool incomplete; /* the present point */
} controller;

static uint64_t id_of(const controller *c)
{
  return c->all->sweep->point[c->item->i].id;
}

static int note_progress(void *context, const gg_progress *progress)
{
  controller *c = context;
  GG_LOCKED(&c->all->lock);
  c->item->fraction = progress->fraction;
  c->item->relative_error = progress->relative_error;
  return 0;
}

static int is_stopped(void *context)
{
  return atomic_load(&((controller *)context)->all->stopped);
}

static void note_warning(void *context, const char *message)
{
  sweep_run *all = ((controller *)context)->all;
  GG_LOCKED(&all->lock);
  for (size_t i = 0; i < all->warnings.n; i++)
    if (strcmp(all->warnings.text[i], message) == 0) return;
  gg_base_string_list_add(&all->warnings, "%s", message);
}

/* Rename NAME.work.h5 by the status of the run. */
static gg_status commit(void *context, gg_status run, gg_error *err)
{
  const controller *c = context;
  return gg_sweep_point_publish(c->all->folder, id_of(c), run == GG_FAILED, err);
}

static gg_status evaluate(controller *c, const gg_scene *scene, const gg_run_options *options, gg_error *err)
{
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *made = NULL;
  gg_result_file file;
  GG_TRY(gg_theories_evaluate(scene, NULL, is_stopped, c, &made, err));
  for (int k = 0; k < GG_N_ENGINES; k++) snprintf(made->refusal[k], sizeof made->refusal[k], "it was not run");
  GG_TRY(gg_files_result_file_open(&file, options->output, options->command, err));
  GG_TRY(gg_files_result_file_finish_comparison(&file, made, err));
  return commit(c, GG_OK, err);
}

/* Run a point; *resume_lost: the checkpoint cannot be resumed. */
static gg_status simulate(controller *c, const gg_scene *scene, const gg_run_options *options, bool *resume_lost,
                          gg_error *err)
{
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *made = NULL;
  gg_point_call point = {.scheduler = c->all->scheduler, .commit = commit, .context = c};
  const bool both = c->all->sweep->settings.does == GG_DOES_COMPARE;
  gg_status status = gg_api_run_simulate(&point, scene, options, both, &made, err);
  c->incomplete = status == GG_FAILED && made;
  *resume_lost = point.resume_lost;
  return status;
}

/* Resume a point. If the checkpoint is damaged, the point starts again, with the same bits. If the disk cannot be
 * written, the checkpoint stays. */
static gg_status resume(controller *c, const gg_scene *scene, gg_run_options *options, gg_error *err)
{
  char text[600];
  bool lost = true;
  gg_status status = gg_checkpoint_about(options->checkpoint, &(gg_checkpoint_info){0}, NULL, err);
  options->resume = options->checkpoint;
  if (status == GG_OK) status = simulate(c, scene, options, &lost, err);
  if (!lost) return status;
  snprintf(text, sizeof text, "the point begins anew: %.500s", err->message);
  note_warning(c, text);
  options->resume = NULL;
  return simulate(c, scene, options, &lost, err);
}

/* Whether there is a checkpoint. While it is replaced, only the previous one exists. */
static bool has_checkpoint(const controller *c)
{
  char path[2][PATH_MAX];
  gg_sweep_point_path(c->all->folder, id_of(c), ".checkpoint.h5", path[0]);
  gg_sweep_point_path(c->all->folder, id_of(c), ".checkpoint.h5.1", path[1]);
  return access(path[0], F_OK) == 0 || access(path[1], F_OK) == 0;
}

/* Run or resume the point that this controller has claimed, within the scheduler. */
static gg_status do_point(controller *c, gg_error *err)
{
  bool lost;
  gg_scene scene;
  const sweep_run *all = c->all;
  char work[PATH_MAX], checkpoint[PATH_MAX];
  gg_run_options options = {.threads = all->threads_each,
                            .command = all->options.command,
                            .input = all->options.input,
                            .workers = all->options.workers,
                            .accept_version = all->options.accept_version,
                            .context = c,
                            .progress = note_progress,
                            .stop = is_stopped,
                            .warn = note_warning};
  options.output = gg_sweep_point_path(all->folder, id_of(c), ".work.h5", work);
  gg_status status = gg_sweep_resolve(all->sweep, c->item->i, &scene, err);
  if (status != GG_OK) return status;
  if (*scene.output.log) note_warning(c, "output.log has no effect in a sweep: it is one file, and points are many");
  *scene.output.log = '\0';
  if (all->sweep->settings.does == GG_DOES_THEORY) return evaluate(c, &scene, &options, err);
  if (!(scene.output.checkpoint_every > 0)) return simulate(c, &scene, &options, &lost, err);
  options.checkpoint = gg_sweep_point_path(all->folder, id_of(c), ".checkpoint.h5", checkpoint);
  return has_checkpoint(c) ? resume(c, &scene, &options, err) : simulate(c, &scene, &options, &lost, err);
}

/* Called without the lock: until the end, the item belongs to this controller. */
static void do_item(controller *c)
{
  gg_error err = {0};
  gg_file_lock lock;
  sweep_run *all = c->all;
  item *it = c->item;
  gg_point_state there = GG_POINT_MISSING;
  c->incomplete = false;
  gg_status status = gg_sweep_point_claim(all->folder, id_of(c), &lock, &err);
  const bool claimed = status == GG_OK && lock.fd >= 0;
  if (claimed) {
    gg_run_scheduler_enter(all->scheduler);
    status = do_point(c, &err);
    gg_run_scheduler_leave(all->scheduler);
  } else if (status == GG_OK) {
    there = gg_sweep_point_status(all->folder, id_of(c));
  }
  gg_io_file_lock_release(&lock);
  GG_LOCKED(&all->lock);
  it->status = status;
  it->here = claimed;
  it->incomplete = c->incomplete || there == GG_POINT_SHORT;
  it->fraction = 1;
  it->checked = gg_base_clock_wall();
  snprintf(it->message, sizeof it->message, "%.500s", err.message);
  it->state = status == GG_OK && !claimed && there == GG_POINT_MISSING ? ELSEWHERE : ENDED;
  pthread_cond_signal(&all->changed);
}

/* The next pending item; otherwise the item of another process with the oldest check, if a check is due; NULL: none.
 * *any: items of other processes remain. */
static item *next_item(sweep_run *all, bool *any)
{
  item *old = NULL;
  size_t elsewhere = 0;
  for (size_t k = 0; k < all->n && !atomic_load(&all->stopped); k++) {
    item *it = &all->item[k];
    if (it->state == PENDING) return it;
    if (it->state != ELSEWHERE) continue;
    elsewhere++;
    if (!old || it->checked < old->checked) old = it;
  }
  *any = elsewhere > 0;
  const double every = fmax(0.5, 0.0625 * (double)elsewhere); /* seconds; spares file servers where there are many */
  return old && gg_base_clock_wall() - old->checked > every ? old : NULL;
}

static void control(void *context)
{
  controller *c = context;
  sweep_run *all = c->all;
  bool any = true;
  pthread_mutex_lock(&all->lock);
  for (;;) {
    c->item = next_item(all, &any);
    if (!c->item && !any) break;
    if (c->item) c->item->state = RUNNING, c->item->relative_error = NAN, c->item->fraction = 0;
    pthread_mutex_unlock(&all->lock);
    if (c->item)
      do_item(c);
    else
      nanosleep(&(struct timespec){0, 50 * 1000 * 1000}, NULL);
    pthread_mutex_lock(&all->lock);
  }
  all->working--;
  pthread_cond_signal(&all->changed);
  pthread_mutex_unlock(&all->lock);
}

/* The time left follows from the cost estimates of all points and the fractions that are done. */
static void report_progress(sweep_run *all)
{
  const gg_sweep_options *o = &all->options;
  gg_sweep_progress p = {.points = all->n + all->done_before,
                         .done = all->done_before,
                         .fell_short = all->incomplete_before,
                         .time_left = NAN,
                         .relative_error = NAN};
  double left = 0, gone = 0;
  if (!o->progress) return;
  pthread_mutex_lock(&all->lock);
  for (size_t k = 0; k < all->n; k++) {
    const item *it = &all->item[k];
    const double seconds = all->sweep->point[it->i].seconds;
    bool ended = it->state >= ENDED, good = it->status == GG_OK || it->incomplete;
    p.done += ended && good;
    p.failed += ended && !good && it->status != GG_INTERRUPTED;
    p.fell_short += ended && it->incomplete;
    p.running += it->state == RUNNING;
    p.elsewhere += it->state == ELSEWHERE;
    if (it->state == RUNNING) p.relative_error = fmax(p.relative_error, it->relative_error);
    if (!ended && it->state != ELSEWHERE) left += seconds * (1 - it->fraction);
    if (ended ? it->here : it->state == RUNNING) gone += seconds * it->fraction;
  }
  pthread_mutex_unlock(&all->lock);
  double elapsed = gg_base_clock_wall() - all->started;
  if (gone > 0 && elapsed > 1) p.time_left = left * elapsed / gone;
  o->progress(o->context, &p);
}

/* Report the end of an item that this process ran, or failed to claim. Called with the lock, which is released during
 * the callback. */
static void report_end(sweep_run *all, item *it)
{
  char file[PATH_MAX];
  const gg_sweep_options *o = &all->options;
  it->state = REPORTED;
  bool ours = it->here || it->status != GG_OK;
  if (!ours || !o->ended || it->status == GG_INTERRUPTED) return;
  const char *ending = it->incomplete ? ".short.h5" : ".h5";
  bool some = it->status == GG_OK || it->incomplete;
  gg_sweep_point_path(all->folder, all->sweep->point[it->i].id, ending, file);
  pthread_mutex_unlock(&all->lock);
  o->ended(o->context, it->i, it->status, some ? file : NULL, it->message);
  pthread_mutex_lock(&all->lock);
}

/* Report warnings and ended points. Called with the lock. */
static void report_ended_points(sweep_run *all)
{
  const gg_sweep_options *o = &all->options;
  for (; all->warned < all->warnings.n; all->warned++)
    if (o->warn) o->warn(o->context, all->warnings.text[all->warned]);
  for (size_t k = 0; k < all->n; k++)
    if (all->item[k].state == ENDED) report_end(all, &all->item[k]);
}

/* Run all points, `at_once` at a time, with reports. GG_OK even if points fail. */
static gg_status do_all(sweep_run *all, size_t at_once, gg_error *err)
{
  const gg_sweep_options *o = &all->options;
  GG_FREED controller *c = gg_base_array_new(at_once, sizeof *c, err);
  if (!c) return GG_FAILED;
  pthread_mutex_lock(&all->lock);
  size_t n = 0;
  for (; n < at_once; n++, all->working++) {
    c[n].all = all;
    if (!gg_run_controller_start(&c[n].thread, control, &c[n])) break;
  }
  while (all->working) {
    gg_base_condition_wait(&all->changed, &all->lock, 0.1);
    report_ended_points(all);
    pthread_mutex_unlock(&all->lock);
    if (o->stop && o->stop(o->context)) atomic_store(&all->stopped, true);
    report_progress(all);
    if (gg_base_callback_failed()) atomic_store(&all->stopped, true);
    pthread_mutex_lock(&all->lock);
  }
  report_ended_points(all);
  pthread_mutex_unlock(&all->lock);
  for (size_t k = 0; k < n; k++) gg_run_controller_join(&c[k].thread);
  return n ? GG_OK : gg_base_fail(err, GG_FAILED, "no thread could be started");
}

static gg_status sum_up(const sweep_run *all, gg_error *err)
{
  size_t failed = 0, incomplete = all->incomplete_before;
  for (size_t k = 0; k < all->n; k++) {
    incomplete += all->item[k].incomplete;
    failed += all->item[k].status != GG_OK && all->item[k].status != GG_INTERRUPTED && !all->item[k].incomplete;
  }
  if (atomic_load(&all->stopped))
    return gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted; continue with the same command", all->folder);
  if (!failed && !incomplete) return GG_OK;
  return gg_base_fail(err, GG_FAILED,
                      "%s: of %zu points %zu failed, and %zu did not reach the requested accuracy (*.short.h5)",
                      all->folder, all->n + all->done_before, failed, incomplete);
}

/* Order of execution: the longest first, so that no long point starts last; then by index. */
static int by_length(const void *a, const void *b)
{
  const item *one = a, *two = b;
  if (one->checked != two->checked) return one->checked > two->checked ? -1 : 1;
  return one->i < two->i ? -1 : 1;
}

typedef struct known {
  uint64_t id;
  size_t i;
} known;

static int by_id(const void *a, const void *b)
{
  const known *one = a, *two = b;
  if (one->id != two->id) return one->id < two->id ? -1 : 1;
  return one->i < two->i ? -1 : 1;
}

static void report_aside(const sweep_run *all, size_t other, size_t damaged)
{
  char text[400];
  if (!all->options.warn || other + damaged == 0) return;
  snprintf(text, sizeof text,
           "%zu points are by another build of graingas, %zu are damaged: they run again, and their files stay as "
           "*.old.h5%s",
           other, damaged, other ? "; --accept-version (in programs accept_version) keeps points of other builds" : "");
  all->options.warn(all->options.context, text);
}

/* List the missing points; of several points with the same scene, only the first. */
static gg_status list_missing(sweep_run *all, size_t first, size_t end, gg_error *err)
{
  const gg_sweep *sweep = all->sweep;
  size_t aside[3] = {0}; /* by gg_point_file */
  GG_FREED known *ids = gg_base_array_new(end - first, sizeof *ids, err);
  all->item = gg_base_array_new(end - first, sizeof *all->item, err);
  if (!ids || !all->item) return GG_FAILED;
  for (size_t i = first; i < end; i++) ids[i - first] = (known){sweep->point[i].id, i};
  qsort(ids, end - first, sizeof *ids, by_id);
  for (size_t k = 0; k < end - first; k++) {
    if (k && ids[k].id == ids[k - 1].id) continue;
    aside[gg_sweep_point_set_aside(all->folder, ids[k].id, all->options.accept_version)]++;
    gg_point_state state = gg_sweep_point_status(all->folder, ids[k].id);
    all->done_before += state != GG_POINT_MISSING;
    all->incomplete_before += state == GG_POINT_SHORT;
    if (state == GG_POINT_MISSING)
      all->item[all->n++] = (item){.i = ids[k].i, .checked = sweep->point[ids[k].i].seconds};
  }
  report_aside(all, aside[GG_POINT_FILE_OTHER_BUILD], aside[GG_POINT_FILE_DAMAGED]);
  qsort(all->item, all->n, sizeof *all->item, by_length);
  return GG_OK;
}

/* Number of points in progress: two per thread of all processes, so that no thread is idle at the end of a point's
 * window; limited by what one process can hold. */
static size_t points_at_once(const sweep_run *all)
{
  enum { MOST_AT_ONCE = 512 };
  const gg_sweep_settings *s = &all->sweep->settings;
  int threads = all->options.workers ? gg_workers_threads(all->options.workers) : all->options.threads;
  size_t n = s->at_once ? (size_t)s->at_once : threads < MOST_AT_ONCE / 2 ? 2 * (size_t)threads : MOST_AT_ONCE;
  return n < all->n ? n : all->n;
}

static gg_status do_missing(sweep_run *all, gg_error *err)
{
  const size_t n = points_at_once(all);
  all->threads_each = n > 1 && !all->options.workers ? 1 : all->options.threads;
  if (!all->options.workers) GG_TRY(gg_run_scheduler_new(all->options.threads, false, &all->scheduler, err));
  all->started = gg_base_clock_wall();
  gg_status status = n ? do_all(all, n, err) : GG_OK;
  report_progress(all);
  return status == GG_OK ? sum_up(all, err) : status;
}

/* Run the points first <= i < end. */
static gg_status run(gg_sweep *sweep, const char *folder, size_t first, size_t end, const gg_sweep_options *options,
                     gg_error *err)
{
  sweep_run all = {.sweep = sweep, .folder = folder};
  all.options = *options;
  if (all.options.threads < 1) all.options.threads = 1;
  if (sweep->settings.does == GG_DOES_THEORY)
    all.options.workers = NULL; /* workers share replicas, and theories have none */
  if (!all.options.command) all.options.command = "the graingas library";
  if (gg_files_positions_are_read(sweep->base) && access(sweep->base->start.positions, R_OK) != 0)
    return gg_base_fail(err, GG_BAD_FILE, "%s: key 'start.positions': %s: cannot be read: %s", sweep->name,
                        sweep->base->start.positions, strerror(errno));
  GG_TRY(gg_sweep_folder_prepare(folder, "the results of a sweep are a folder with a file for each point", err));
  GG_TRY(gg_sweep_folder_note(sweep, folder, err));
  gg_sweep_folder_tidy(folder);
  pthread_mutex_init(&all.lock, NULL);
  gg_base_condition_init(&all.changed);
  atomic_init(&all.stopped, false);
  gg_status status = list_missing(&all, first, end, err);
  if (status == GG_OK) status = do_missing(&all, err);
  gg_run_scheduler_free(all.scheduler);
  gg_base_string_list_clear(&all.warnings);
  pthread_mutex_destroy(&all.lock);
  pthread_cond_destroy(&all.changed);
  free(all.item);
  return gg_base_callback_settle(status, err);
}

gg_status gg_sweep_run(gg_sweep *sweep, const char *folder, const gg_sweep_options *options, gg_error *err)
{
  gg_sweep_options own;
  GG_NEED(sweep, folder);
  GG_COPY_OPTIONS(own, options);
  GG_TRY(gg_sweep_check(sweep, err));
  GG_USE_READING(sweep);
  return run(sweep, folder, 0, sweep->n, &own, err);
}

gg_status gg_sweep_run_point(gg_sweep *sweep, const char *folder, size_t i, const gg_sweep_options *options,
                             gg_error *err)
{
  gg_sweep_options own;
  GG_NEED(sweep, folder);
  GG_COPY_OPTIONS(own, options);
  GG_TRY(gg_sweep_check(sweep, err));
  GG_USE_READING(sweep);
  if (i >= sweep->n)
    return GG_REFUSE(err, "%s: there is no point %zu; the sweep has %zu", sweep->name, i + 1, sweep->n);
  return run(sweep, folder, i, i + 1, &own, err);
}
