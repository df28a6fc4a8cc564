/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps: what is missing of a folder is done, point beside point. */
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

typedef enum item_state { WAITS, RUNS, ELSEWHERE, ENDED, REPORTED } item_state;

typedef struct item { /* a point to be done */
  size_t i;           /* of the sweep */
  item_state state;   /* ELSEWHERE: another process was at it when it was last checked */
  gg_status status;
  bool fell_short, here; /* here: by this process */
  double checked;        /* when it was */
  double fraction, relative_error;
  char message[512];
} item;

typedef struct sweep_run {
  gg_sweep *sweep;
  const char *folder;
  gg_sweep_options options;
  int threads_each;            /* of a point */
  gg_run_scheduler *scheduler; /* of all points; NULL: the workers' */
  atomic_bool stopped;
  pthread_mutex_t lock; /* for all below */
  pthread_cond_t changed;
  size_t n;
  item *item;
  size_t done_before, short_before; /* points of which there was a file, and of these those that ended short */
  double started;                   /* clock reading */
  size_t working;                   /* controllers */
  gg_string_list warnings;
  size_t warned; /* of them reported */
} sweep_run;

/* A thread that does one point after another. */
typedef struct controller {
  gg_run_controller thread;
  sweep_run *all;
  item *item;
  bool fell_short; /* its point */
} controller;

static uint64_t id_of(const controller *c)
{
  return c->all->sweep->point[c->item->i].id;
}

/* Points that other processes are at are checked as often, in seconds; less often where they are many, for the sake of
 * file servers that many processes use. */
static double check_every(size_t elsewhere)
{
  return elsewhere < 8 ? 0.5 : 0.0625 * (double)elsewhere;
}

static int note_progress(void *context, const gg_progress *progress)
{
  controller *c = context;
  pthread_mutex_lock(&c->all->lock);
  c->item->fraction = progress->fraction;
  c->item->relative_error = progress->relative_error;
  pthread_mutex_unlock(&c->all->lock);
  return 0;
}

static int is_stopped(void *context)
{
  return atomic_load(&((controller *)context)->all->stopped);
}

static void note_warning(void *context, const char *message)
{
  sweep_run *all = ((controller *)context)->all;
  bool known = false;
  pthread_mutex_lock(&all->lock);
  for (size_t i = 0; i < all->warnings.n && !known; i++) known = strcmp(all->warnings.text[i], message) == 0;
  if (!known) gg_base_string_list_add(&all->warnings, "%s", message);
  pthread_mutex_unlock(&all->lock);
}

/* What it was written to is called work until it is known how it ended. */
static gg_status publish(void *context, gg_status run, gg_error *err)
{
  const controller *c = context;
  return gg_sweep_point_publish(c->all->folder, id_of(c), run == GG_FAILED, err);
}

static gg_status evaluate(controller *c, const gg_scene *scene, const gg_run_options *options, gg_error *err)
{
  gg_comparison *made = NULL;
  gg_result_file file;
  gg_status status = gg_theories_evaluate(scene, NULL, is_stopped, c, &made, err);
  for (int k = 0; made && k < GG_N_ENGINES; k++) snprintf(made->refusal[k], sizeof made->refusal[k], "it was not run");
  if (status == GG_OK) status = gg_files_result_file_open(&file, options->output, options->command, err);
  if (status == GG_OK) status = gg_files_result_file_finish_comparison(&file, made, err);
  if (status == GG_OK) status = publish(c, GG_OK, err);
  gg_comparison_free(made);
  return status;
}

/* *resume_lost: the checkpoint cannot be resumed from. */
static gg_status simulate(controller *c, const gg_scene *scene, const gg_run_options *options, bool *resume_lost,
                          gg_error *err)
{
  gg_comparison *made = NULL;
  gg_point_call point = {.scheduler = c->all->scheduler, .publish = publish, .context = c};
  const bool both = c->all->sweep->settings.does == GG_DOES_COMPARE;
  gg_status status = gg_api_run_simulate(&point, scene, options, both, &made, err);
  c->fell_short = status == GG_FAILED && made;
  *resume_lost = point.resume_lost;
  gg_comparison_free(made);
  return status;
}

/* A checkpoint that cannot be resumed from is none: the point begins anew, and comes to the same bits. Not where the
 * disk cannot be written to: then the checkpoint waits for better times. */
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

/* Between two checkpoints there is a moment with the one before alone. */
static bool is_begun(const controller *c)
{
  char path[2][PATH_MAX];
  gg_sweep_point_path(c->all->folder, id_of(c), ".checkpoint.h5", path[0]);
  gg_sweep_point_path(c->all->folder, id_of(c), ".checkpoint.h5.1", path[1]);
  return access(path[0], F_OK) == 0 || access(path[1], F_OK) == 0;
}

/* From its checkpoint, if there is one; the point's place is claimed, and the scheduler entered. */
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
  return is_begun(c) ? resume(c, &scene, &options, err) : simulate(c, &scene, &options, &lost, err);
}

/* Without the lock: until it is done the point belongs to this controller. */
static void do_item(controller *c)
{
  gg_error err = {0};
  gg_file_lock lock;
  sweep_run *all = c->all;
  item *it = c->item;
  gg_point_state there = GG_POINT_MISSING;
  c->fell_short = false;
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
  pthread_mutex_lock(&all->lock);
  it->status = status;
  it->here = claimed;
  it->fell_short = c->fell_short || there == GG_POINT_SHORT;
  it->fraction = 1;
  it->checked = gg_base_clock_wall();
  snprintf(it->message, sizeof it->message, "%.500s", err.message);
  it->state = status == GG_OK && !claimed && there == GG_POINT_MISSING ? ELSEWHERE : ENDED;
  pthread_cond_signal(&all->changed);
  pthread_mutex_unlock(&all->lock);
}

/* The next one that waits; of those that others are at, the one that was not checked for longest, if that is long
 * enough. *any: some are left. */
static item *next_item(sweep_run *all, bool *any)
{
  item *old = NULL;
  size_t elsewhere = 0;
  for (size_t k = 0; k < all->n && !atomic_load(&all->stopped); k++) {
    item *it = &all->item[k];
    if (it->state == WAITS) return it;
    if (it->state != ELSEWHERE) continue;
    elsewhere++;
    if (!old || it->checked < old->checked) old = it;
  }
  *any = elsewhere > 0;
  return old && gg_base_clock_wall() - old->checked > check_every(elsewhere) ? old : NULL;
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
    if (c->item) c->item->state = RUNS, c->item->relative_error = NAN, c->item->fraction = 0;
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

/* Time left: seconds of all points, by the cost estimate of each, and how far they are. */
static void report_progress(sweep_run *all)
{
  const gg_sweep_options *o = &all->options;
  gg_sweep_progress p = {.points = all->n + all->done_before,
                         .done = all->done_before,
                         .fell_short = all->short_before,
                         .time_left = NAN,
                         .relative_error = NAN};
  double left = 0, gone = 0;
  if (!o->progress) return;
  pthread_mutex_lock(&all->lock);
  for (size_t k = 0; k < all->n; k++) {
    const item *it = &all->item[k];
    const double seconds = all->sweep->point[it->i].seconds;
    bool ended = it->state >= ENDED, good = it->status == GG_OK || it->fell_short;
    p.done += ended && good;
    p.failed += ended && !good && it->status != GG_INTERRUPTED;
    p.fell_short += ended && it->fell_short;
    p.running += it->state == RUNS;
    p.elsewhere += it->state == ELSEWHERE;
    if (it->state == RUNS) p.relative_error = fmax(p.relative_error, it->relative_error);
    if (!ended && it->state != ELSEWHERE) left += seconds * (1 - it->fraction);
    if (ended ? it->here : it->state == RUNS) gone += seconds * it->fraction;
  }
  pthread_mutex_unlock(&all->lock);
  double elapsed = gg_base_clock_wall() - all->started;
  if (gone > 0 && elapsed > 1) p.time_left = left * elapsed / gone;
  o->progress(o->context, &p);
}

/* With the lock, but not during the callback. Another process reports what it did; but that a point could not even be
 * claimed, nobody else reports. */
static void report_end(sweep_run *all, item *it)
{
  char file[PATH_MAX];
  const gg_sweep_options *o = &all->options;
  it->state = REPORTED;
  bool ours = it->here || it->status != GG_OK;
  if (!ours || !o->ended || it->status == GG_INTERRUPTED) return;
  const char *ending = it->fell_short ? ".short.h5" : ".h5";
  bool some = it->status == GG_OK || it->fell_short;
  gg_sweep_point_path(all->folder, all->sweep->point[it->i].id, ending, file);
  pthread_mutex_unlock(&all->lock);
  o->ended(o->context, it->i, it->status, some ? file : NULL, it->message);
  pthread_mutex_lock(&all->lock);
}

/* With the lock: warnings, and points that have ended. */
static void report_ended_points(sweep_run *all)
{
  const gg_sweep_options *o = &all->options;
  for (; all->warned < all->warnings.n; all->warned++)
    if (o->warn) o->warn(o->context, all->warnings.text[all->warned]);
  for (size_t k = 0; k < all->n; k++)
    if (all->item[k].state == ENDED) report_end(all, &all->item[k]);
}

/* Do all points, `at_once` at a time, and report meanwhile; GG_OK whatever became of each. */
static gg_status do_all(sweep_run *all, size_t at_once, gg_error *err)
{
  const gg_sweep_options *o = &all->options;
  controller *c = gg_base_array_new(at_once, sizeof *c, err);
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
  free(c);
  return n ? GG_OK : gg_base_fail(err, GG_FAILED, "no thread could be started");
}

static gg_status sum_up(const sweep_run *all, gg_error *err)
{
  size_t failed = 0, fell_short = all->short_before;
  for (size_t k = 0; k < all->n; k++) {
    fell_short += all->item[k].fell_short;
    failed += all->item[k].status != GG_OK && all->item[k].status != GG_INTERRUPTED && !all->item[k].fell_short;
  }
  if (atomic_load(&all->stopped))
    return gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted; continue with the same command", all->folder);
  if (!failed && !fell_short) return GG_OK;
  return gg_base_fail(err, GG_FAILED,
                      "%s: of %zu points %zu failed, and %zu did not reach the requested accuracy (*.short.h5)",
                      all->folder, all->n + all->done_before, failed, fell_short);
}

/* Longest first, so that none is left over at the end; as they are listed where they take as long. */
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

/* Points that are the same scene are one: the first of them. */
static gg_status list_missing(sweep_run *all, size_t first, size_t end, gg_error *err)
{
  const gg_sweep *sweep = all->sweep;
  size_t aside[3] = {0}; /* by gg_point_file */
  known *ids = gg_base_array_new(end - first, sizeof *ids, err);
  all->item = gg_base_array_new(end - first, sizeof *all->item, err);
  if (!ids || !all->item) return free(ids), GG_FAILED;
  for (size_t i = first; i < end; i++) ids[i - first] = (known){sweep->point[i].id, i};
  qsort(ids, end - first, sizeof *ids, by_id);
  for (size_t k = 0; k < end - first; k++) {
    if (k && ids[k].id == ids[k - 1].id) continue;
    aside[gg_sweep_point_set_aside(all->folder, ids[k].id, all->options.accept_version)]++;
    gg_point_state state = gg_sweep_point_status(all->folder, ids[k].id);
    all->done_before += state != GG_POINT_MISSING;
    all->short_before += state == GG_POINT_SHORT;
    if (state == GG_POINT_MISSING)
      all->item[all->n++] = (item){.i = ids[k].i, .checked = sweep->point[ids[k].i].seconds};
  }
  free(ids);
  report_aside(all, aside[GG_POINT_FILE_OTHER_BUILD], aside[GG_POINT_FILE_DAMAGED]);
  qsort(all->item, all->n, sizeof *all->item, by_length);
  return GG_OK;
}

/* Points in progress at a time: two a thread, of all processes, so that none has to wait for the end of a window, and
 * errors can be compared; but not more than one process can hold. */
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

/* Points from `first` to the one before `end`. */
static gg_status run(gg_sweep *sweep, const char *folder, size_t first, size_t end, const gg_sweep_options *options,
                     gg_error *err)
{
  sweep_run all = {.sweep = sweep, .folder = folder};
  if (options) all.options = *options;
  if (all.options.threads < 1) all.options.threads = 1;
  if (sweep->settings.does == GG_DOES_THEORY) all.options.workers = NULL; /* who share replicas */
  if (!all.options.command) all.options.command = "the graingas library";
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
  GG_NEED(sweep, folder);
  GG_TRY(gg_sweep_check(sweep, err));
  GG_USE_READING(sweep);
  return run(sweep, folder, 0, sweep->n, options, err);
}

gg_status gg_sweep_run_point(gg_sweep *sweep, const char *folder, size_t i, const gg_sweep_options *options,
                             gg_error *err)
{
  GG_NEED(sweep, folder);
  GG_TRY(gg_sweep_check(sweep, err));
  GG_USE_READING(sweep);
  if (i >= sweep->n)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: there is no point %zu; the sweep has %zu", sweep->name, i + 1,
                        sweep->n);
  return run(sweep, folder, i, i + 1, options, err);
}
