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
  assert_false(gg_statistics_rule_is_met(&once, false));
  assert_true(gg_statistics_rule_is_met(&once, true) && gg_statistics_rule_is_met(&sure, false));
  assert_int_equal(gg_statistics_rule_next_test(&p, 0, &once), 150); /* confirmed by half as much again */
  assert_true(fabs(gg_statistics_rule_margin(&p, 10, 1000) - 1.06) < 1e-12);
  assert_true(gg_statistics_rule_margin(&(gg_stopping_criteria){0}, 10, 1000) == 1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(wait_for_relaxation),
                                     cmocka_unit_test(windows_double_with_each_restart)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
