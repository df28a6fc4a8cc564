/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the warm-up to the end of a run. The averaging window grows until it is long, steady and exact enough; one that
 * shows a trend is given up, and averaging begins anew. */
#include <math.h>

#include "base/clock.h"
#include "base/memory.h"
#include "run/replicas.h"
#include "run/series_means.h"
#include "run/workers/workers.h"
#include "theory/spin_escape.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

gg_status gg_run_replicas_store(gg_replicas *all, gg_error *err)
{
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {0};
  if (!all->callbacks || !all->callbacks->checkpoint) return GG_OK;
  gg_status status = gg_run_replicas_save(all, &archive, err);
  if (status == GG_OK) status = all->callbacks->checkpoint(all->callbacks->context, &archive, err);
  gg_base_archive_clear(&archive);
#ifdef __GLIBC__
  malloc_trim(0); /* the C library may keep up to twice the size of a checkpoint */
#endif
  all->last_checkpoint = gg_base_clock_wall();
  return status;
}

/* True if the run must end whatever was requested: time limit, grains at rest, or theta/T beyond use. */
static bool is_over(const gg_replicas *all)
{
  return all->stopped == GG_OUT_OF_TIME || all->state.arrest_share > 0 || all->state.runaway > 0;
}

/* Arrest detection. Under gravity a flow may come to rest. Hard spheres have no lasting contacts: grains that lie on
 * each other collide without end, and the time hardly advances. The contact-time rule treats such collisions. */

/* Fraction of treated collisions above which a flow is at rest: below 0.5 in flows, dense chutes too; 0.9 in heaps. */
#define LASTING_SHARE 0.9
/* Collisions per grain between two tests. */
enum { STRETCH = 2000 };

static void check_arrest(gg_replicas *all)
{
  struct gg_replicas_state *s = &all->state;
  uint64_t collisions = 0, treated = 0;
  if (all->model.gravity[1] == 0) return;
  for (int i = 0; i < all->n; i++) {
    const gg_engine_state e = gg_engine_state_of(all->replica[i].engine);
    collisions += e.collisions, treated += e.treated;
  }
  uint64_t stretch = collisions - s->stretch_collisions;
  if ((double)stretch < 0.5 * STRETCH * (double)all->model.n * all->n) return;
  double share = (double)(treated - s->stretch_treated) / (double)stretch;
  s->arrest_share = share > LASTING_SHARE ? share : 0;
  s->stretch_collisions = collisions, s->stretch_treated = treated;
}

/* In free cooling with friction, grains that have escaped friction double theta/T every few collisions, until it
 * overflows. A run with a requested error ends earlier, when theta/T has no meaningful mean; others end before the
 * overflow. */
static void check_runaway(gg_replicas *all)
{
  const double most = all->criteria.relative_error > 0 ? 1e30 : 1e200;
  if (!gg_theory_is_metastable(&all->model)) return;
  for (int i = 0; i < all->n; i++) {
    const gg_replica *r = &all->replica[i];
    gg_function f;
    const int k = gg_measure_sampler_find(&r->sampler, GG_Q_TEMPERATURE_RATIO, &f);
    if (k < 0 || r->series.n == 0) continue;
    const double ratio =
        gg_function_value(f, gg_series_row(&r->series, r->series.n - 1) + r->sampler.offset[k], &r->model);
    if (ratio >= most) all->state.runaway = ratio;
  }
}

/* Samples between two reports or checkpoints: some tens of milliseconds. With several processes each step synchronises
 * them, and they report within a step: then all samples are one step, unless arrest or runaway spins must be tested. */
static uint64_t step(const gg_replicas *all, uint64_t way)
{
  const bool watched = all->model.gravity[1] != 0 || gg_theory_is_metastable(&all->model);
  if (all->tasks.remote && !watched) return way;
  uint64_t some = 1 + (uint64_t)(2e5 / (1000 + (double)all->model.n * all->n));
  return some < way ? some : way;
}

/* Samples at the end of the next step. Several processes may leave replicas at different samples; if one process
 * resumes them, those behind catch up in steps, too. */
static uint64_t next_of(const gg_replicas *all)
{
  uint64_t least = gg_run_replicas_least(all);
  return all->tasks.remote ? all->state.due : least + step(all, all->state.due - least);
}

static bool pauses_for_checkpoint(gg_replicas *all)
{
  if (gg_run_replicas_checkpoint_is_due(all)) return true;
  gg_run_replicas_report_progress(all, false);
  return false;
}

/* Let every replica reach `due` samples, in short steps with progress and a checkpoint between them. */
static gg_status advance_to(gg_replicas *all, uint64_t due, gg_error *err)
{
  while (all->state.due < due || !gg_run_replicas_are_level(all)) {
    if (gg_run_replicas_are_level(all)) all->state.due += step(all, due - all->state.due);
    const bool adapt = !all->state.averaging || !gg_model_keeps_temperature(&all->model);
    gg_status status = gg_run_replicas_advance(all, next_of(all), adapt, pauses_for_checkpoint, err);
    if (status == GG_INTERRUPTED && is_over(all)) return GG_OK;
    if (status == GG_INTERRUPTED) GG_TRY(gg_run_replicas_store(all, err));
    if (status != GG_OK) return status;
    if (gg_run_replicas_are_level(all)) check_arrest(all), check_runaway(all);
    gg_run_replicas_report_progress(all, false);
    if (gg_run_replicas_checkpoint_is_due(all)) GG_TRY(gg_run_replicas_store(all, err));
    if (is_over(all)) return GG_OK;
  }
  return GG_OK;
}

static gg_status open_window(gg_replicas *all, gg_error *err)
{
  for (int i = 0; i < all->n; i++) GG_TRY(gg_run_replica_open_window(&all->replica[i], err));
  gg_run_distribution_changed(&all->tasks);
  if (!all->state.averaging) gg_run_progress_new_phase(&all->progress);
  gg_statistics_forecast_open_window(&all->progress.forecast);
  all->estimated_at = 0;
  all->state.averaging = 1;
  all->state.exact = 0;
  all->state.window_at = all->state.due;
  all->state.goal = all->state.due + gg_statistics_rule_next_test(&all->criteria, all->state.restarts, NULL);
  return GG_OK;
}

static gg_window_test test_of(const gg_replicas *all, const gg_convergence *c, uint64_t window)
{
  double asked = all->criteria.relative_error;
  gg_window_test t = {.window = window, .ratio = asked > 0 ? c->relative_error / asked : NAN};
  t.exact = window >= all->criteria.least && c->trusted && t.ratio <= 1;
  t.sure = c->trusted && (double)window >= c->sure_at;
  return t;
}

/* True if the window is long and exact enough. Records whether it was exact, for the next test. */
static bool finished(gg_replicas *all, const gg_window_test *t)
{
  if (gg_statistics_rule_ends(&all->criteria, all->state.restarts, t->window)) return true;
  bool before = all->state.exact;
  all->state.exact = t->exact;
  return gg_statistics_rule_is_met(&all->criteria, t, before);
}

/* Warm up. Averaging keeps the last sampling interval, so the warm-up is extended until it fits the collision rate,
 * which it does not in a burst. A rate that stays high is no burst. Resumed runs test at the same samples as others. */
static gg_status warm_up(gg_replicas *all, gg_error *err)
{
  enum { TEST_EVERY = 4, MOST_MORE = 300, BURST = 50, COLLAPSE = 1000 };
  uint64_t due = all->criteria.warmup;
  while (due < all->state.due) due += TEST_EVERY;
  for (;; due += TEST_EVERY) {
    GG_TRY(advance_to(all, due, err));
    if (is_over(all)) return GG_OK;
    const bool late = due >= all->criteria.warmup + MOST_MORE;
    int bad = 0;
    while (bad < all->n && gg_run_replica_interval_fits(&all->replica[bad], late ? COLLAPSE : BURST)) bad++;
    if (late || bad == all->n) return bad == all->n ? GG_OK : gg_run_replica_collapsed(&all->replica[bad], err);
  }
}

/* The sample of the next test is part of the saved state, so that a resumed run tests at the same samples. */
gg_status gg_run_replicas_run(gg_replicas *all, gg_error *err)
{
  if (!all->state.averaging) {
    GG_TRY(warm_up(all, err));
    if (!is_over(all)) GG_TRY(open_window(all, err));
  }
  while (!is_over(all)) {
    GG_TRY(advance_to(all, all->state.goal, err));
    if (all->state.due < all->state.goal || !gg_run_replicas_are_level(all)) break; /* the run must end */
    uint64_t window = all->state.due - all->state.window_at;
    gg_convergence c;
    GG_TRY(gg_run_replicas_convergence(all, &c, err));
    gg_run_progress_record_errors(&all->progress, (double)window, &c);
    gg_window_test test = test_of(all, &c, window);
    if (c.trending && gg_statistics_rule_restarts(&all->criteria, all->state.restarts, window)) {
      all->state.restarts++;
      GG_TRY(open_window(all, err));
    } else if (finished(all, &test)) {
      gg_run_replicas_report_progress(all, true); /* with the final errors */
      return all->scene.output.state == GG_STATE_KEPT ? gg_run_replicas_store(all, err) : GG_OK;
    } else {
      all->state.goal = all->state.window_at + gg_statistics_rule_next_test(&all->criteria, all->state.restarts, &test);
    }
  }
  gg_run_replicas_report_progress(all, true);
  return gg_run_replicas_store(all, err); /* the run may be resumed */
}
