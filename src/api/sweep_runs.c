#include "api/sweep_runs.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/clock.h"
#include "base/memory.h"
#include "sweep/folder.h"

/* What others are at is looked at as often, in seconds; less often where that is much, for the sake of file servers
 * that many processes ask. */
static double look_every(size_t elsewhere)
{
  return elsewhere < 8 ? 0.5 : 0.0625 * (double)elsewhere;
}

/* A thread that does one point after another. */
typedef struct course {
  gg_courses *all;
  gg_sweep_item *item;
} course;

static int hear(void *context, const gg_progress *progress)
{
  course *c = context;
  pthread_mutex_lock(&c->all->lock);
  c->item->fraction = progress->fraction;
  c->item->relative_error = progress->relative_error;
  pthread_mutex_unlock(&c->all->lock);
  return 0;
}

static int is_stopped(void *context)
{
  return atomic_load(&((course *)context)->all->stopped);
}

static void warn(void *context, const char *message)
{
  gg_courses *all = ((course *)context)->all;
  bool known = false;
  pthread_mutex_lock(&all->lock);
  for (size_t i = 0; i < all->warnings.n && !known; i++) known = strcmp(all->warnings.text[i], message) == 0;
  if (!known) gg_base_string_list_add(&all->warnings, "%s", message);
  pthread_mutex_unlock(&all->lock);
}

static gg_status do_point(course *c, bool *fell_short, gg_error *err)
{
  gg_courses *all = c->all;
  gg_point_task task = {.sweep = all->sweep, .folder = all->folder, .i = c->item->i, .crew = all->crew};
  task.options = (gg_run_options){.threads = all->threads_each,
                                  .command = all->options.command,
                                  .input = all->options.input,
                                  .workers = all->options.workers,
                                  .context = c,
                                  .progress = hear,
                                  .stop = is_stopped,
                                  .warn = warn};
  if (all->crew) gg_run_crew_enter(all->crew);
  gg_status status = gg_api_point_run(&task, fell_short, err);
  if (all->crew) gg_run_crew_leave(all->crew);
  return status;
}

/* Not held by the lock: the point is this course's for now. */
static void do_item(course *c)
{
  gg_error err = {0};
  gg_file_lock lock;
  bool fell_short = false, claimed;
  gg_courses *all = c->all;
  gg_sweep_item *item = c->item;
  const uint64_t id = all->sweep->point[item->i].id;
  gg_point_state there = GG_POINT_MISSING;
  gg_status status = gg_sweep_point_claim(all->folder, id, &lock, &err);
  claimed = status == GG_OK && lock.fd >= 0;
  if (claimed) status = do_point(c, &fell_short, &err);
  if (status == GG_OK && !claimed) there = gg_sweep_point_status(all->folder, id);
  gg_base_file_lock_release(&lock);
  pthread_mutex_lock(&all->lock);
  bool busy = status == GG_OK && !claimed && there == GG_POINT_MISSING;
  item->status = status;
  item->here = claimed;
  item->fell_short = fell_short || there == GG_POINT_SHORT;
  item->fraction = 1;
  item->looked = gg_base_clock_wall();
  snprintf(item->message, sizeof item->message, "%.500s", err.message);
  item->state = busy ? GG_ITEM_ELSEWHERE : GG_ITEM_ENDED;
  pthread_cond_signal(&all->news);
  pthread_mutex_unlock(&all->lock);
}

/* The next one that waits; of those that others are at, the one that was not looked at for longest, if that is long
 * enough. *any: some are left. */
static gg_sweep_item *next_item(gg_courses *all, bool *any)
{
  gg_sweep_item *old = NULL;
  size_t elsewhere = 0;
  for (size_t k = 0; k < all->n && !atomic_load(&all->stopped); k++) {
    gg_sweep_item *item = &all->item[k];
    if (item->state == GG_ITEM_WAITS) return item;
    if (item->state != GG_ITEM_ELSEWHERE) continue;
    elsewhere++;
    if (!old || item->looked < old->looked) old = item;
  }
  *any = elsewhere > 0;
  return old && gg_base_clock_wall() - old->looked > look_every(elsewhere) ? old : NULL;
}

static void *work(void *argument)
{
  course c = {.all = argument};
  gg_courses *all = c.all;
  bool any = true;
  pthread_mutex_lock(&all->lock);
  for (;;) {
    c.item = next_item(all, &any);
    if (!c.item && !any) break;
    if (c.item) c.item->state = GG_ITEM_RUNS, c.item->relative_error = NAN, c.item->fraction = 0;
    pthread_mutex_unlock(&all->lock);
    if (c.item)
      do_item(&c);
    else
      nanosleep(&(struct timespec){0, 50 * 1000 * 1000}, NULL);
    pthread_mutex_lock(&all->lock);
  }
  all->at_work--;
  pthread_cond_signal(&all->news);
  pthread_mutex_unlock(&all->lock);
  return NULL;
}

gg_status gg_api_sweep_runs_advance(gg_courses *all, size_t at_once, gg_error *err)
{
  const gg_sweep_options *o = &all->options;
  pthread_t *thread = gg_base_array_new(at_once, sizeof *thread, err);
  if (!thread) return GG_FAILED;
  pthread_mutex_lock(&all->lock);
  size_t n = 0;
  while (n < at_once && pthread_create(&thread[n], NULL, work, all) == 0) n++, all->at_work++;
  while (all->at_work) {
    gg_base_condition_wait(&all->news, &all->lock, 0.1);
    gg_api_sweep_report_status(all);
    pthread_mutex_unlock(&all->lock);
    if (o->stop && o->stop(o->context)) atomic_store(&all->stopped, true);
    gg_api_sweep_report_progress(all);
    pthread_mutex_lock(&all->lock);
  }
  gg_api_sweep_report_status(all);
  pthread_mutex_unlock(&all->lock);
  for (size_t k = 0; k < n; k++) pthread_join(thread[k], NULL);
  free(thread);
  return n ? GG_OK : gg_base_fail(err, GG_FAILED, "no thread could be started");
}
