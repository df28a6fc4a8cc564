/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The estimated end of a run is right if errors fall as 1/sqrt(window), the half of the window that it may go on for
 * included; a fraction that never falls and is 1 at the end alone, whatever ends the run; no time where none is known.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "fake_engine.h"
#include "graingas.h"
#include "run/replicas.h"

static const gg_stopping_criteria criteria = {
    .warmup = 20, .least = 150, .longest = 75000, .relative_error = 0.01, .find_steady = true};

/* Windows whose errors are known from `sure_at` samples on. */
static gg_convergence errors_of(double scale, double window, double sure_at)
{
  return (gg_convergence){.relative_error = scale / sqrt(window), .trusted = true, .sure_at = sure_at};
}

static gg_window_test test_of(double scale, uint64_t window, double sure_at)
{
  double ratio = scale / sqrt((double)window) / criteria.relative_error;
  return (gg_window_test){window, ratio, ratio <= 1, (double)window >= sure_at};
}

/* End of a run with these errors, by the rules of averaging.c, test after test. */
static double true_end(double scale, double sure_at)
{
  bool exact = false;
  uint64_t window = gg_statistics_rule_next_test(&criteria, 0, NULL);
  for (;;) {
    gg_window_test t = test_of(scale, window, sure_at);
    if (gg_statistics_rule_is_met(&t, exact)) return (double)(criteria.warmup + window);
    exact = t.exact;
    window = gg_statistics_rule_next_test(&criteria, 0, &t);
  }
}

/* Follow such a run. After a quarter of it the estimated end is right within 30 %, and exactly once the errors are as
 * small as requested. */
static void follow(double scale, double sure_at, int *exactly)
{
  gg_progress_estimate o = {0};
  gg_averaging_state s = {.averaging = 1, .due = criteria.warmup, .window_at = criteria.warmup};
  double end = true_end(scale, sure_at), window;
  s.goal = s.window_at + gg_statistics_rule_next_test(&criteria, 0, NULL);
  assert_false(gg_statistics_forecast_end(&o.forecast, &criteria, &s).known);
  for (; (double)s.due < end; s.due++) {
    window = (double)(s.due - s.window_at);
    if (s.due >= s.goal) {
      gg_window_test t = test_of(scale, (uint64_t)window, sure_at);
      s.exact = t.exact;
      s.goal = s.window_at + gg_statistics_rule_next_test(&criteria, 0, &t);
    }
    if (window < 40) continue;
    gg_convergence c = errors_of(scale, window, sure_at);
    gg_run_progress_record_errors(&o, window, &c);
    gg_expected_end estimate = gg_statistics_forecast_end(&o.forecast, &criteria, &s);
    assert_true(estimate.at >= (double)s.due);
    if (window < (end - criteria.warmup) / 4) continue;
    if (fabs(estimate.at / end - 1) > 0.3)
      fail_msg("%g: at %g of %g the estimate was %g", scale, (double)s.due, end, estimate.at);
    if (s.exact) {
      assert_true(estimate.known && fabs(estimate.at - end) < 1e-9 * end);
      ++*exactly;
    }
  }
}

static void half_a_window_more(void **state)
{
  (void)state;
  int exactly = 0;
  for (double scale = 0.02; scale < 1; scale *= 1.07) follow(scale, INFINITY, &exactly);
  assert_true(exactly > 1000);
}

/* A window that is sure is tested where it should end, and ends there; never before it was exact enough. */
static void to_where_it_should_end(void **state)
{
  (void)state;
  int exactly = 0;
  for (double scale = 0.15; scale < 1; scale *= 1.07) {
    follow(scale, 150, &exactly);
    double needed = scale * scale / (criteria.relative_error * criteria.relative_error);
    double window = true_end(scale, 150) - (double)criteria.warmup;
    assert_true(window >= needed && window < 1.35 * needed);
  }
  assert_int_equal(exactly, 0); /* it ends at the first test that it passes */
}

/* Without a requested error the end is known from the start, and nothing else ends such a run. */
static void so_many_collisions(void **state)
{
  (void)state;
  gg_progress_estimate o = {0};
  gg_stopping_criteria p = {.warmup = 20, .least = 150, .longest = 75000, .most = 200000};
  gg_averaging_state s = {.due = 3};
  gg_expected_end end = gg_statistics_forecast_end(&o.forecast, &p, &s);
  assert_true(end.known && end.at == 200020);
  s = (gg_averaging_state){.averaging = 1, .due = 90020, .window_at = 20, .goal = 100020};
  end = gg_statistics_forecast_end(&o.forecast, &p, &s);
  assert_true(end.known && end.at == 200020);
  assert_false(gg_statistics_rule_ends(&p, 0, 199999));
  p.relative_error = 1e-9;
  assert_true(gg_statistics_rule_ends(&p, 0, 75000)); /* out of reach */
}

/* A window with a trend will be given up; one without a trend whose errors are not trusted yet will be extended. */
static void trends_and_trust(void **state)
{
  (void)state;
  gg_progress_estimate o = {0};
  gg_averaging_state s = {.averaging = 1, .due = 120, .window_at = 20, .goal = 170};
  gg_convergence c = errors_of(0.05, 100, INFINITY);
  gg_run_progress_record_errors(&o, 100, &c);
  gg_expected_end end = gg_statistics_forecast_end(&o.forecast, &criteria, &s);
  assert_true(end.known && end.at == 20 + 225); /* the shortest test, and half as long again */
  c.trending = true;
  gg_run_progress_record_errors(&o, 100, &c);
  end = gg_statistics_forecast_end(&o.forecast, &criteria, &s);
  assert_true(!end.known && end.at == 170 + 450); /* twice as long after that */
  s.restarts = 6;
  assert_true(gg_statistics_forecast_end(&o.forecast, &criteria, &s).known);
  c.trending = false, c.trusted = false, c.untrusted = 5;
  s.restarts = 0;
  gg_run_progress_record_errors(&o, 100, &c);
  assert_true(gg_statistics_forecast_end(&o.forecast, &criteria, &s).at >= 20 + 1.5 * 400); /* 16 blocks of 5 times */
  gg_statistics_forecast_open_window(&o.forecast);
  assert_true(isnan(gg_statistics_forecast_end(&o.forecast, &criteria, &s).at));
}

/* The pace is the seconds per sample of late, not of the start; stored marks are thinned. */
static void the_pace_is_that_of_late_samples(void **state)
{
  (void)state;
  gg_progress_estimate o = {0};
  double wall = 5;
  assert_true(isnan(gg_run_progress_pace(&o)));
  for (int i = 0; i < 1000; i++, wall += i < 300 ? 0.1 : 0.4) gg_run_progress_record_time(&o, wall, 10.0 * i);
  assert_true(fabs(gg_run_progress_pace(&o) / 0.04 - 1) < 1e-9);
  assert_true(o.n_marks <= GG_PROGRESS_MARKS);
}

typedef struct watcher {
  double fraction, left, limit_in;
  int calls, known, falls, early, cut; /* cut: number of reports by which the time limit ends the run first */
} watcher;

static void watch(void *context, const gg_progress *p)
{
  watcher *w = context;
  if (w->fraction == 1) w->early++; /* a report after the one that the run is over */
  if (p->fraction < w->fraction) w->falls++;
  assert_true(p->fraction >= 0 && p->fraction <= 1 && !(p->time_left < 0));
  if (isfinite(p->limit_in) && isfinite(p->time_left) && p->fraction < 1) w->cut += p->time_left > p->limit_in;
  w->fraction = p->fraction, w->left = p->time_left, w->limit_in = p->limit_in;
  w->known += isfinite(p->time_left);
  w->calls++;
}

/* Runs of every end: errors, collisions, both, time, an error out of reach, windows given up, replicas, resumed. */
static void every_run(void **state)
{
  (void)state;
  enum { ERROR, COLLISIONS, BOTH, TIME, GIVEN_UP, REPLICAS, CASES };
  for (int k = 0; k < CASES; k++) {
    fake = (fake_plan){.T = 2, .theta = 0.5, .relaxation = 10, .noise = 0.02};
    gg_scene s = gg_scene_defaults();
    s.phi = 0.2, s.particles = 512, s.collision.beta[0] = 0;
    if (k == ERROR || k == REPLICAS || k == BOTH) s.run.relative_error = 0.0005;
    if (k == COLLISIONS || k == BOTH) s.run.collisions = 20000;
    if (k == TIME) s.run.relative_error = 1e-9, s.run.time_limit = 0.3;
    if (k == GIVEN_UP) s.run.relative_error = 0.004, fake.start = -0.9, fake.relaxation = 400;
    if (k == REPLICAS) s.run.replicas = 3;
    watcher w = {0};
    gg_run_callbacks callbacks = {.context = &w, .progress = watch};
    gg_result *r = NULL;
    gg_status status = gg_run_scene(&s, NULL, 2, &callbacks, &r, NULL);
    assert_int_equal(status, k == TIME || k == BOTH ? GG_FAILED : GG_OK); /* GG_FAILED: error not reached */
    /* The number of reports of a run that the time limit ends depends on the machine. */
    if (w.falls || w.early || w.fraction != 1 || w.left != 0 || w.calls < 5 || w.known < (k == TIME ? 1 : 3))
      fail_msg("%d: fell %d, early %d, ended %g %g, known %d of %d", k, w.falls, w.early, w.fraction, w.left, w.known,
               w.calls);
    assert_int_equal(w.cut > 0, k == TIME);
    assert_true(k == TIME ? w.limit_in < 0.1 : isinf(w.limit_in)); /* time left until the limit */
    gg_result_free(r);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(half_a_window_more),
      cmocka_unit_test(to_where_it_should_end),
      cmocka_unit_test(so_many_collisions),
      cmocka_unit_test(trends_and_trust),
      cmocka_unit_test(the_pace_is_that_of_late_samples),
      cmocka_unit_test(every_run),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
