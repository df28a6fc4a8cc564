/* Sweeps done: what is still missing of a folder, side by side. */
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "api/sweep_runs.h"
#include "base/clock.h"
#include "base/memory.h"
#include "sweep/folder.h"

static gg_status sum_up(const gg_courses *all, gg_error *err)
{
  size_t failed = 0, fell_short = all->short_before;
  for (size_t k = 0; k < all->n; k++) {
    fell_short += all->item[k].fell_short;
    failed += all->item[k].status != GG_OK && all->item[k].status != GG_INTERRUPTED && !all->item[k].fell_short;
  }
  if (atomic_load(&all->stopped))
    return gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted; go on with the same command", all->folder);
  if (!failed && !fell_short) return GG_OK;
  return gg_base_fail(err, GG_FAILED,
                      "%s: of %zu points %zu failed, and %zu ended short of what was asked (*.short.h5)", all->folder,
                      all->n + all->done_before, failed, fell_short);
}

/* Longest first, so that none is left over at the end; as they are listed where they take as long. */
static int by_length(const void *a, const void *b)
{
  const gg_sweep_item *one = a, *two = b;
  if (one->looked != two->looked) return one->looked > two->looked ? -1 : 1;
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

/* Points that are the same scene are one: the first of them. */
static gg_status list_missing(gg_courses *all, size_t first, size_t end, gg_error *err)
{
  const gg_sweep *sweep = all->sweep;
  known *ids = gg_base_array_new(end - first, sizeof *ids, err);
  all->item = gg_base_array_new(end - first, sizeof *all->item, err);
  if (!ids || !all->item) return free(ids), GG_FAILED;
  for (size_t i = first; i < end; i++) ids[i - first] = (known){sweep->point[i].id, i};
  qsort(ids, end - first, sizeof *ids, by_id);
  for (size_t k = 0; k < end - first; k++) {
    if (k && ids[k].id == ids[k - 1].id) continue;
    gg_point_state state = gg_sweep_point_status(all->folder, ids[k].id);
    all->done_before += state != GG_POINT_MISSING;
    all->short_before += state == GG_POINT_SHORT;
    if (state == GG_POINT_MISSING)
      all->item[all->n++] = (gg_sweep_item){.i = ids[k].i, .looked = sweep->point[ids[k].i].seconds};
  }
  free(ids);
  qsort(all->item, all->n, sizeof *all->item, by_length);
  return GG_OK;
}

/* Points in progress at a time: two a thread, of all processes, so that none has to wait for the end of a window, and
 * errors can be compared; but not more than one process can hold. */
static size_t at_once(const gg_courses *all)
{
  enum { MOST_AT_ONCE = 512 };
  const gg_sweep_settings *s = &all->sweep->settings;
  int threads = all->options.workers ? gg_workers_threads(all->options.workers) : all->options.threads;
  size_t n = s->at_once ? (size_t)s->at_once : threads < MOST_AT_ONCE / 2 ? 2 * (size_t)threads : MOST_AT_ONCE;
  return n < all->n ? n : all->n;
}

static gg_status work(gg_courses *all, gg_error *err)
{
  size_t n = at_once(all);
  all->threads_each = all->options.threads;
  if (n > 1 && !all->options.workers) {
    GG_TRY(gg_run_crew_new(all->options.threads, &all->crew, err));
    all->threads_each = 1;
  }
  all->started = gg_base_clock_wall();
  gg_status status = n ? gg_api_sweep_runs_advance(all, n, err) : GG_OK;
  gg_api_sweep_report_progress(all);
  return status == GG_OK ? sum_up(all, err) : status;
}

/* Points from `first` to the one before `end`. */
static gg_status run(gg_sweep *sweep, const char *folder, size_t first, size_t end, const gg_sweep_options *options,
                     gg_error *err)
{
  gg_courses all = {.sweep = sweep, .folder = folder};
  if (options) all.options = *options;
  if (all.options.threads < 1) all.options.threads = 1;
  if (sweep->settings.does == GG_DOES_THEORY) all.options.workers = NULL; /* who share replicas */
  if (!all.options.command) all.options.command = "the graingas library";
  GG_TRY(gg_sweep_folder_prepare(folder, "results of a sweep are a folder with a file a point", err));
  gg_sweep_folder_tidy(folder);
  pthread_mutex_init(&all.lock, NULL);
  gg_base_condition_init(&all.news);
  atomic_init(&all.stopped, false);
  gg_status status = list_missing(&all, first, end, err);
  if (status == GG_OK) status = work(&all, err);
  gg_run_crew_free(all.crew);
  gg_base_string_list_clear(&all.warnings);
  pthread_mutex_destroy(&all.lock);
  pthread_cond_destroy(&all.news);
  free(all.item);
  return status;
}

gg_status gg_sweep_run(gg_sweep *sweep, const char *folder, const gg_sweep_options *options, gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(folder);
  GG_TRY(gg_sweep_check(sweep, err));
  return run(sweep, folder, 0, sweep->n, options, err);
}

gg_status gg_sweep_run_point(gg_sweep *sweep, const char *folder, size_t i, const gg_sweep_options *options,
                             gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(folder);
  GG_TRY(gg_sweep_check(sweep, err));
  if (i >= sweep->n)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: there is no point %zu; the sweep has %zu", sweep->name, i + 1,
                        sweep->n);
  return run(sweep, folder, i, i + 1, options, err);
}
