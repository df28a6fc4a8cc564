/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress reports of a run. */
#include <math.h>

#include "base/clock.h"
#include "graingas.h"
#include "run/progress_estimate.h"
#include "run/replicas.h"

void gg_run_progress_record_errors(gg_progress_estimate *o, double window, const gg_convergence *c)
{
  const gg_window_errors e = {c->relative_error, c->untrusted, c->sure_at, c->trusted, c->trending};
  gg_statistics_forecast_record(&o->forecast, window, &e);
}

void gg_run_progress_new_phase(gg_progress_estimate *o)
{
  o->n_marks = 0;
}

/* The last mark is the latest. The others are spaced over the phase; if there are too many, every second one goes. */
void gg_run_progress_record_time(gg_progress_estimate *o, double wall, double due)
{
  int n = o->n_marks;
  if (n && due <= o->marks[n - 1].due) return;
  if (n >= 2 && o->marks[n - 1].due - o->marks[n - 2].due < (due - o->marks[0].due) / (GG_PROGRESS_MARKS / 2)) n--;
  if (n == GG_PROGRESS_MARKS) {
    n /= 2;
    for (int i = 1; i < n; i++) o->marks[i] = o->marks[2 * i];
  }
  o->marks[n].wall = wall;
  o->marks[n++].due = due;
  o->n_marks = n;
}

/* Seconds per sample, averaged over the second half of the phase. */
double gg_run_progress_pace(const gg_progress_estimate *o)
{
  int last = o->n_marks - 1, from = 0;
  if (last < 2) return NAN;
  double middle = (o->marks[0].wall + o->marks[last].wall) / 2;
  while (from < last - 1 && o->marks[from + 1].wall <= middle) from++;
  return (o->marks[last].wall - o->marks[from].wall) / (o->marks[last].due - o->marks[from].due);
}

bool gg_run_replicas_checkpoint_is_due(const gg_replicas *all)
{
  double every = all->scene.output.checkpoint_every;
  bool asked = all->callbacks && all->callbacks->checkpoint && every > 0;
  return asked && gg_base_clock_wall() - all->last_checkpoint > every;
}

/* Estimate errors between two tests, for the progress estimate alone. The first window is a quarter of the shortest
 * that is tested; each next one is 5 % longer. Estimates take at most 1 % of the time. */
static void estimate_errors(gg_replicas *all, double window)
{
  gg_convergence c;
  double before = gg_base_clock_wall(), first = (double)(all->criteria.least << all->state.restarts) / 4;
  if (!all->state.averaging || window < fmax(first, 1.05 * all->estimated_at) || before < all->next_estimate) return;
  if (gg_run_replicas_convergence(all, &c, NULL) == GG_OK) gg_run_progress_record_errors(&all->progress, window, &c);
  all->estimated_at = window;
  double now = gg_base_clock_wall();
  all->next_estimate = now + 100 * (now - before);
}

/* Samples that all replicas have, also while tasks are under way. */
static double samples_so_far(const gg_replicas *all)
{
  uint64_t least = all->state.due;
  for (int i = 0; i < all->n; i++) {
    uint64_t has = gg_run_task_get_status(&all->tasks.task[i]).samples;
    least = has < least ? has : least;
  }
  return (double)least;
}

/* Replicas that tasks work on are not to be read. */
static bool is_busy(const gg_replicas *all)
{
  for (int i = 0; i < all->n; i++)
    if (!atomic_load(&all->tasks.task[i].over)) return true;
  return false;
}

/* When a run of usual noise, 3/sqrt(grains samples), ends: where nothing is known of the errors of this one. */
static double usual_end(const gg_replicas *all)
{
  double noise = 3 / all->criteria.relative_error, grains = (double)all->model.n * all->n;
  double window = fmax(1.5 * (double)(all->criteria.least << all->state.restarts), 1.15 * noise * noise / grains);
  if (all->criteria.most) window = fmin(window, (double)all->criteria.most);
  double begins = (double)(all->state.averaging ? all->state.window_at : all->criteria.warmup);
  return fmax(begins + window, 1.25 * (double)all->state.goal);
}

/* Seconds until the requested errors are reached, regardless of the time limit; NaN: not known. The cost of a
 * sample with curves is known only after some of the averaging. */
static double time_left(const gg_replicas *all, double due, gg_expected_end end)
{
  double left = (end.at - due) * gg_run_progress_pace(&all->progress);
  bool alike = all->state.averaging || all->replica[0].sampler.n_observables <= 1;
  return isfinite(left) && end.known && alike ? left : NAN;
}

void gg_run_replicas_report_progress(gg_replicas *all, bool over)
{
  if (!all->callbacks || !all->callbacks->progress) return;
  double due = samples_so_far(all);
  double window = all->state.averaging ? due - (double)all->state.window_at : 0;
  if (!over && !is_busy(all) && gg_run_replicas_are_level(all)) estimate_errors(all, window);
  double collisions = 0, cpu = 0, now = gg_base_clock_wall();
  for (int i = 0; i < all->n; i++) {
    gg_run_task_status reached = gg_run_task_get_status(&all->tasks.task[i]);
    collisions += reached.collisions_per_grain * (double)all->model.n / 2;
    cpu += reached.cpu;
  }
  gg_run_progress_record_time(&all->progress, now, due);
  const gg_averaging_state at = {all->state.averaging, all->state.exact, all->state.due,
                                 all->state.window_at, all->state.goal,  all->state.restarts};
  const gg_expected_end end = gg_statistics_forecast_end(&all->progress.forecast, &all->criteria, &at);
  double limit = all->criteria.time_limit;
  double used = all->state.wall + now - all->started;
  /* The larger share of samples and of the time limit; it never falls, and it is 1 only when the run is over. */
  const double last = isfinite(end.at) ? end.at : usual_end(all);
  double done = fmax(last > 0 ? due / last : 0, limit > 0 ? used / limit : 0);
  done = all->progress.fraction = fmax(all->progress.fraction, fmin(done, 0.99));
  gg_progress p = {
      .engine = all->replica[0].engine->ops->name,
      .phase = all->state.averaging ? "averaging" : "warm-up",
      .fraction = over ? 1 : done,
      .overall = over ? 1 : done,
      .collisions = (uint64_t)collisions,
      .rate = cpu > 0 ? collisions / cpu : 0,
      .relative_error = window >= (double)all->criteria.least ? all->last.relative_error : NAN,
      .time_left = over ? 0 : time_left(all, due, end),
      .limit_in = limit > 0 ? fmax(limit - used, 0) : INFINITY,
      .replicas = all->n,
  };
  GG_LOCKED(&all->lock); /* tasks may just now call the callback that stops the run */
  all->callbacks->progress(all->callbacks->context, &p);
}
