/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress reports of a run. */
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "graingas.h"
#include "run/progress_estimate.h"
#include "run/replicas.h"
#include "statistics/estimator.h"

/* Relative uncertainty (`doubt`) of an error estimated from the shortest window that is tested; it falls as
 * 1/sqrt(window). The expected end is a weighted mean over estimates that are `off` of these uncertainties too small or
 * too large. If the ends scatter by more than the fraction `vague`, the end counts as unknown. */
static const double doubt = 0.2, off[] = {-1.4, -0.7, 0, 0.7, 1.4}, weight[] = {0.12, 0.22, 0.32, 0.22, 0.12};
static const double vague = 0.5;

void gg_run_progress_open_window(gg_progress_estimate *o)
{
  o->n_errors = 0;
  o->trending = false;
  o->trusted_at = o->sure_at = 0;
}

void gg_run_progress_new_phase(gg_progress_estimate *o)
{
  o->n_marks = 0;
}

void gg_run_progress_record_errors(gg_progress_estimate *o, double window, const gg_convergence *c)
{
  o->trending = c->trending;
  o->trusted_at = c->trusted ? 0 : fmax(5 * GG_MIN_BLOCKS * c->untrusted, 1.25 * window);
  o->sure_at = c->sure_at;
  if (!(c->relative_error > 0 && isfinite(c->relative_error))) return;
  if (o->n_errors == GG_PROGRESS_ERRORS) memmove(o->errors, o->errors + 1, --o->n_errors * sizeof *o->errors);
  o->errors[o->n_errors].window = window;
  o->errors[o->n_errors++].log_scale = log(c->relative_error * sqrt(window));
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

/* ln(error sqrt(window)), averaged over the latest estimates, since errors jump when the limits of blocks move. */
static double log_scale(const gg_progress_estimate *o)
{
  double sum = 0, weights = 0, now = o->errors[o->n_errors - 1].window;
  for (int i = o->n_errors - 1; i >= 0 && o->errors[i].window >= 0.8 * now; i--)
    sum += o->errors[i].window * o->errors[i].log_scale, weights += o->errors[i].window;
  return sum / weights;
}

/* Predict the outcome of a test: the error falls as 1/sqrt(window), with a margin. */
static gg_window_test test_at(const gg_progress_estimate *o, const gg_stopping_criteria *criteria, uint64_t window,
                              double doubts)
{
  const double length = (double)window;
  gg_window_test t = {.window = window, .ratio = NAN};
  if (!o->n_errors || !(criteria->relative_error > 0)) return t;
  double ahead = fmax(1 / o->errors[o->n_errors - 1].window - 1 / length, 0);
  double change = doubts * doubt * sqrt((double)criteria->least * ahead);
  t.ratio = exp(log_scale(o) + change) / (criteria->relative_error * sqrt(length));
  bool trusted = length >= o->trusted_at;
  t.exact = trusted && length >= (double)criteria->least && t.ratio <= 1;
  t.sure = trusted && length >= o->sure_at;
  return t;
}

/* Length at which a window ends whose next test is at `window`. */
static double last_test(const gg_progress_estimate *o, const gg_stopping_criteria *criteria, uint64_t restarts,
                        bool exact, uint64_t window, double doubts)
{
  while (!gg_statistics_rule_ends(criteria, restarts, window)) {
    gg_window_test t = test_at(o, criteria, window, doubts);
    if (gg_statistics_rule_is_met(&t, exact)) break;
    exact = t.exact;
    window = gg_statistics_rule_next_test(criteria, restarts, &t);
  }
  return (double)window;
}

/* Expected number of samples until the window ends; it has `had`. */
static gg_expected_end mean_last_test(const gg_progress_estimate *o, const gg_stopping_criteria *criteria,
                                      uint64_t restarts, bool exact, uint64_t window, double had)
{
  double mean = 0, square = 0;
  if (!(criteria->relative_error > 0))
    return (gg_expected_end){last_test(o, criteria, restarts, exact, window, 0) - had, true};
  if (!o->n_errors) return (gg_expected_end){NAN, false};
  for (int i = 0; i < 5; i++) {
    double left = last_test(o, criteria, restarts, exact, window, off[i]) - had;
    mean += weight[i] * left, square += weight[i] * left * left;
  }
  return (gg_expected_end){mean, square <= (1 + vague * vague) * mean * mean};
}

gg_expected_end gg_run_progress_end(const gg_progress_estimate *o, const gg_stopping_criteria *criteria,
                                    const struct gg_replicas_state *s)
{
  uint64_t restarts = s->restarts, window = s->goal - s->window_at;
  bool anew = s->averaging && o->trending && gg_statistics_rule_restarts(criteria, restarts);
  double begins = (double)(anew ? s->goal : criteria->warmup);
  if (s->averaging && !anew) {
    gg_expected_end end = mean_last_test(o, criteria, restarts, s->exact, window, (double)(s->due - s->window_at));
    return (gg_expected_end){(double)s->due + end.at, end.known};
  }
  window = gg_statistics_rule_next_test(criteria, restarts + anew, NULL);
  gg_expected_end end = mean_last_test(o, criteria, restarts + anew, false, window, 0);
  return (gg_expected_end){begins + end.at, end.known && !anew};
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
  gg_expected_end end = gg_run_progress_end(&all->progress, &all->criteria, &all->state);
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
  pthread_mutex_lock(&all->lock); /* tasks may just now call the callback that stops the run */
  all->callbacks->progress(all->callbacks->context, &p);
  pthread_mutex_unlock(&all->lock);
}
