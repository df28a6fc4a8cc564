/* From the warm-up to the end of a run. The averaging window grows until it is long, steady and exact enough; one that
 * shows a trend is given up, and averaging begins anew. */
#include <math.h>

#include "run/clock.h"
#include "run/replicas.h"

/* Share of the phase that is done: by samples, or by the square of the error still missing. */
static double fraction_done(const gg_replicas *all)
{
  if (!all->state.averaging) return (double)all->state.due / (double)(all->plan.warmup ? all->plan.warmup : 1);
  double window = (double)(all->state.due - all->state.window_at);
  if (all->plan.most && !(all->plan.relative_error > 0)) return window / (double)all->plan.most;
  double by_length = window / (double)all->plan.least;
  double by_error = all->last.relative_error > 0 ? pow(all->plan.relative_error / all->last.relative_error, 2) : 0;
  double done = fmin(by_length, by_error);
  return all->plan.most ? fmax(done, window / (double)all->plan.most) : done;
}

static void report_progress(gg_replicas *all)
{
  if (!all->hooks || !all->hooks->progress) return;
  double collisions = 0, cpu = 0;
  for (int i = 0; i < all->n; i++) {
    collisions += gg_replica_collisions_per_grain(&all->replica[i]) * (double)all->model.n / 2;
    cpu += all->replica[i].clock.cpu;
  }
  double elapsed = gg_wall_now() - all->started, done = fmin(fraction_done(all), 1);
  gg_progress p = {
      .engine = all->replica[0].engine->ops->name,
      .phase = all->state.averaging ? "averaging" : "warm-up",
      .fraction = done,
      .collisions = (uint64_t)collisions,
      .rate = cpu > 0 ? collisions / cpu : 0,
      .relative_error = all->state.averaging ? all->last.relative_error : NAN,
      .time_left = all->state.averaging && done > 0.02 ? elapsed * (1 - done) / done : NAN,
      .replicas = all->n,
  };
  all->hooks->progress(all->hooks->context, &p);
}

static gg_status store_checkpoint(gg_replicas *all, gg_error *err)
{
  gg_archive archive = {0};
  gg_status status = gg_replicas_save(all, &archive, err);
  if (status == GG_OK) status = all->hooks->checkpoint(all->hooks->context, &archive, err);
  gg_archive_clear(&archive);
  all->last_checkpoint = gg_wall_now();
  return status;
}

static bool checkpoints(const gg_replicas *all)
{
  return all->hooks && all->hooks->checkpoint;
}

static bool checkpoint_is_due(const gg_replicas *all)
{
  double every = all->scene.output.checkpoint_every;
  return checkpoints(all) && every > 0 && gg_wall_now() - all->last_checkpoint > every;
}

/* Sampling intervals follow the collision rate before averaging, and where the temperature never stands still. */
static bool adapts(const gg_replicas *all)
{
  return !all->state.averaging || all->model.flow == GG_HCS || !all->model.steady;
}

/* Is there no point in going on, whatever was asked? */
static bool is_over(const gg_replicas *all)
{
  return all->stopped == GG_OUT_OF_TIME || all->state.standstill > 0;
}

/* Let every replica reach `due` samples, in short steps with progress and a checkpoint between them. */
static gg_status advance_to(gg_replicas *all, uint64_t due, gg_error *err)
{
  while (all->state.due < due || !gg_replicas_are_level(all)) {
    if (gg_replicas_are_level(all)) {
      uint64_t step = 1 + (uint64_t)(2e5 / (double)all->model.n); /* some tens of milliseconds */
      all->state.due = all->state.due + step < due ? all->state.due + step : due;
    }
    gg_status status = gg_replicas_advance(all, adapts(all), err);
    if (status == GG_INTERRUPTED && is_over(all)) return GG_OK;
    if (status == GG_INTERRUPTED && checkpoints(all)) GG_TRY(store_checkpoint(all, err));
    if (status != GG_OK) return status;
    gg_replicas_check_standstill(all);
    report_progress(all);
    if (checkpoint_is_due(all)) GG_TRY(store_checkpoint(all, err));
    if (is_over(all)) return GG_OK;
  }
  return GG_OK;
}

/* Windows that may be given up: averaging does not begin anew for ever. */
enum { MOST_RESTARTS = 6 };

/* Length at which the window is tested next. It grows by a quarter a time, and by half once errors are as small as
 * asked (see `finished`). */
static uint64_t next_length(const gg_replicas *all, uint64_t window)
{
  uint64_t least = all->plan.least << all->state.restarts;
  uint64_t next = window < least ? least : window + window / (all->state.exact ? 2 : 4);
  return all->plan.most && next > all->plan.most ? all->plan.most : next;
}

static gg_status open_window(gg_replicas *all, gg_error *err)
{
  for (int i = 0; i < all->n; i++) GG_TRY(gg_replica_open_window(&all->replica[i], err));
  all->state.averaging = 1;
  all->state.exact = 0;
  all->state.window_at = all->state.due;
  all->state.goal = all->state.due + next_length(all, 0);
  return GG_OK;
}

static bool exact_enough(const gg_replicas *all, const gg_convergence *c, uint64_t window)
{
  return all->plan.relative_error > 0 && window >= all->plan.least && c->trusted &&
         c->relative_error <= all->plan.relative_error;
}

/* Is the window long and exact enough? A run that tests again and again, and stops as soon as its estimate of the error
 * is small, stops where the estimate is too small. So the window goes on for half its length after that, and the
 * estimate there is the one that counts. */
static bool finished(gg_replicas *all, const gg_convergence *c, uint64_t window)
{
  if (all->plan.most && window >= all->plan.most) return true;
  if (window >= all->plan.longest << all->state.restarts) return true;
  bool before = all->state.exact;
  all->state.exact = exact_enough(all, c, window);
  return before && all->state.exact;
}

/* The next test belongs to the state, so that a resumed run tests where the uninterrupted one does. */
gg_status gg_replicas_run(gg_replicas *all, gg_error *err)
{
  if (!all->state.averaging) {
    GG_TRY(advance_to(all, all->plan.warmup, err));
    if (!is_over(all)) GG_TRY(open_window(all, err));
  }
  while (!is_over(all)) {
    GG_TRY(advance_to(all, all->state.goal, err));
    if (all->state.due < all->state.goal || !gg_replicas_are_level(all)) break; /* over on the way */
    uint64_t window = all->state.due - all->state.window_at;
    gg_convergence c;
    GG_TRY(gg_replicas_convergence(all, &c, err));
    if (c.trending && all->plan.find_steady && all->state.restarts < MOST_RESTARTS && window >= all->plan.least) {
      all->state.restarts++;
      GG_TRY(open_window(all, err));
    } else if (finished(all, &c, window)) {
      report_progress(all); /* the last word, with the errors of the end */
      return GG_OK;
    } else {
      all->state.goal = all->state.window_at + next_length(all, window);
    }
  }
  return checkpoints(all) ? store_checkpoint(all, err) : GG_OK; /* over before its time */
}
