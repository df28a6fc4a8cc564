/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When a run ends: what warm-up and window wait for, how they grow, and that one estimate is not enough. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "common/relaxation_times.h"
#include "run/replicas.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

static gg_stopping_criteria criteria_of(const char *yaml, gg_model *m)
{
  gg_error err = {0};
  gg_scene s = gg_scene_defaults();
  if (gg_scene_read(&s, yaml, strlen(yaml), "a scene", &err) != GG_OK ||
      gg_scene_model_make(&s, GG_MD, m, &err) != GG_OK)
    fail_msg("%s", err.message);
  return gg_run_criteria_of(&s, m);
}

/* In samples, of two collisions a grain each: six and fifty relaxation times, three and ten of the gap. */
static void wait_for_relaxation(void **state)
{
  (void)state;
  gg_model m;
  gg_stopping_criteria p = criteria_of("{flow: usf, phi: 0.1, particles: 500, collision: {e: 0.99}}", &m);
  const double slowest = gg_common_model_relaxation(&m);
  assert_true(50 * slowest > 600);
  assert_true(2 * (double)p.warmup >= 6 * slowest && 2 * (double)p.least >= 50 * slowest);
  assert_true(2 * (double)p.least_steady >= 50 * slowest);
  p = criteria_of("{flow: couette, phi: 0.1, particles: 2000}", &m);
  const double gap = gg_common_model_gap_relaxation(&m);
  assert_true(3 * gap > 80 && 3 * gap > 12 * gg_common_model_relaxation(&m));
  assert_true(2 * (double)p.warmup >= 3 * gap && 2 * (double)p.least >= 10 * gap);
}

static void windows_double_with_each_restart(void **state)
{
  (void)state;
  const gg_stopping_criteria p = {.least = 100, .longest = 5000, .relative_error = 0.01, .find_steady = true};
  for (uint64_t restarts = 0; restarts < 4; restarts++) {
    assert_int_equal(gg_statistics_rule_next_test(&p, restarts, NULL), 100 << restarts);
    assert_false(gg_statistics_rule_ends(&p, restarts, (5000 << restarts) - 1));
    assert_true(gg_statistics_rule_ends(&p, restarts, 5000 << restarts));
  }
  const gg_window_test once = {.window = 100, .ratio = 0.9, .exact = true},
                       sure = {.window = 100, .ratio = 0.9, .exact = true, .sure = true};
  assert_false(gg_statistics_rule_is_met(&p, &once, false));
  assert_true(gg_statistics_rule_is_met(&p, &once, true) && gg_statistics_rule_is_met(&p, &sure, false));
  assert_int_equal(gg_statistics_rule_next_test(&p, 0, &once), 150); /* confirmed by half as much again */
  assert_true(fabs(gg_statistics_rule_margin(&p, 10, 1000) - 1.06) < 1e-12);
  assert_true(gg_statistics_rule_margin(&(gg_stopping_criteria){0}, 10, 1000) == 1);
}

static void runs_that_may_be_extended_pass_the_same_tests(void **state)
{
  (void)state;
  const gg_stopping_criteria p = {
      .least = 100, .longest = 50000, .relative_error = 0.01, .find_steady = true, .extends = true};
  gg_stopping_criteria ends = p;
  ends.most = 210;
  uint64_t window = gg_statistics_rule_next_test(&p, 1, NULL);
  for (int k = 0; k < 20; k++) {
    const gg_window_test far = {.window = window, .ratio = 9}, near = {window, 0.9, true, true};
    const uint64_t next = gg_statistics_rule_next_test(&p, 1, &far);
    assert_int_equal(gg_statistics_rule_next_test(&p, 1, &near), next);
    assert_int_equal(next, window + window / 4);
    assert_true(gg_statistics_rule_restarts(&p, 1, window) && !gg_statistics_rule_restarts(&p, 1, window + 1));
    window = next;
  }
  const gg_window_test last = {.window = 200, .ratio = 9}, end = {.window = 210, .ratio = 9};
  assert_int_equal(gg_statistics_rule_next_test(&ends, 1, &last), 210);
  assert_true(gg_statistics_rule_ends(&ends, 1, 210) && !gg_statistics_rule_restarts(&ends, 1, 210));
  assert_int_equal(gg_statistics_rule_next_test(&p, 1, &end), 250); /* as a run without the end at 210 */
  gg_window_test t = {.window = 200, .ratio = 0.83, .exact = true};
  assert_false(gg_statistics_rule_is_met(&p, &t, true) || gg_statistics_rule_is_met(&p, &t, false));
  t.ratio = 0.81;
  assert_true(gg_statistics_rule_is_met(&p, &t, true) && gg_statistics_rule_is_met(&p, &t, false));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(wait_for_relaxation),
                                     cmocka_unit_test(windows_double_with_each_restart),
                                     cmocka_unit_test(runs_that_may_be_extended_pass_the_same_tests)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
