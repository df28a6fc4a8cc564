/* Sweeps done: one point after another. */
#include <math.h>
#include <stdio.h>

#include "door/door.h"
#include "door/sweep.h"
#include "sweep/folder.h"

typedef struct sweeping {
  gg_sweep *sweep;
  const char *folder;
  gg_sweep_options options;
  gg_sweep_progress now;
} sweeping;

static int tell(void *context, const gg_progress *progress)
{
  sweeping *s = context;
  s->now.relative_error = progress->relative_error;
  if (s->options.progress) s->options.progress(s->options.context, &s->now);
  return 0;
}

static int stop(void *context)
{
  sweeping *s = context;
  return s->options.stop ? s->options.stop(s->options.context) : 0;
}

static gg_status do_claimed(sweeping *s, size_t i, gg_error *err)
{
  gg_error why = {0};
  bool fell_short;
  gg_point_task task = {.sweep = s->sweep, .folder = s->folder, .i = i};
  task.options = (gg_run_options){.threads = s->options.threads,
                                  .command = s->options.command,
                                  .input = s->options.input,
                                  .context = s,
                                  .progress = tell,
                                  .stop = stop};
  s->now.running = 1;
  gg_status status = gg_point_do(&task, &fell_short, &why);
  s->now.running = 0;
  s->now.done += status == GG_OK || fell_short;
  s->now.fell_short += fell_short;
  s->now.failed += status != GG_OK && !fell_short;
  if (status == GG_INTERRUPTED) return gg_fail(err, status, "%s", why.message);
  char *file = NULL;
  gg_point_state state;
  gg_sweep_find(s->sweep, s->folder, i, &state, &file, NULL);
  if (s->options.ended) s->options.ended(s->options.context, i, status, file, why.message);
  return GG_OK;
}

static gg_status do_point(sweeping *s, size_t i, gg_error *err)
{
  gg_file_lock lock;
  GG_TRY(gg_point_claim(s->folder, s->sweep->point[i].id, &lock, err));
  if (lock.fd < 0) return GG_OK;
  gg_status status = do_claimed(s, i, err);
  gg_file_lock_release(&lock);
  return status;
}

static gg_status sum_up(const sweeping *s, gg_error *err)
{
  if (!s->now.failed && !s->now.fell_short) return GG_OK;
  return gg_fail(err, GG_FAILED, "%s: %zu of %zu points failed, and %zu ended short of what was asked", s->folder,
                 s->now.failed, s->now.points, s->now.fell_short);
}

static gg_status begin(sweeping *s, gg_sweep *sweep, const char *folder, const gg_sweep_options *options, gg_error *err)
{
  *s = (sweeping){.sweep = sweep, .folder = folder, .now = {.time_left = NAN, .relative_error = NAN}};
  if (options) s->options = *options;
  GG_TRY(gg_sweep_check(sweep, err));
  return gg_sweep_folder_prepare(folder, err);
}

gg_status gg_sweep_run(gg_sweep *sweep, const char *folder, const gg_sweep_options *options, gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(folder);
  sweeping s;
  GG_TRY(begin(&s, sweep, folder, options, err));
  s.now.points = sweep->n;
  for (size_t i = 0; i < sweep->n; i++) {
    gg_point_state state = gg_point_look(folder, sweep->point[i].id);
    s.now.done += state != GG_POINT_MISSING;
    s.now.fell_short += state == GG_POINT_SHORT;
    if (state == GG_POINT_MISSING) GG_TRY(do_point(&s, i, err));
  }
  return sum_up(&s, err);
}

gg_status gg_sweep_run_point(gg_sweep *sweep, const char *folder, size_t i, const gg_sweep_options *options,
                             gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(folder);
  sweeping s;
  GG_TRY(begin(&s, sweep, folder, options, err));
  if (i >= sweep->n)
    return gg_fail(err, GG_BAD_INPUT, "%s: there is no point %zu; the sweep has %zu", sweep->name, i + 1, sweep->n);
  s.now.points = 1;
  if (gg_point_look(folder, sweep->point[i].id) == GG_POINT_MISSING) GG_TRY(do_point(&s, i, err));
  return sum_up(&s, err);
}
