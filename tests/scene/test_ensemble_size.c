/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many grains a Monte Carlo ensemble has: what the scene gives is kept; else so many that 1/N stays within a
 * quarter of the asked error (between walls more is needed, and half is allowed), of the scarcest species, never fewer
 * than the least, and as many as at the start of a run that is resumed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "common/finite_size.h"
#include "common/model.h"
#include "dsmc/time_step.h"
#include "scene/ensemble_size.h"
#include "scene/fields.h"
#include "scene/model_of_scene.h"

static gg_scene scene_at(double relative_error)
{
  gg_scene s = gg_scene_defaults();
  s.phi = 0.1, s.run.relative_error = relative_error;
  return s;
}

static void by_the_asked_error(void **state)
{
  (void)state;
  gg_scene s = scene_at(GG_AUTO);
  assert_int_equal(gg_scene_ensemble_size(&s), GG_LEAST_ENSEMBLE); /* 1 % */
  s.run.collisions = 100;
  assert_int_equal(gg_scene_ensemble_size(&s), GG_LEAST_ENSEMBLE);
  for (double error = 1e-5; error < 1e-3; error *= 1.7) {
    s = scene_at(error);
    double bias = 2.0 / (double)gg_scene_ensemble_size(&s);
    assert_true(bias <= 0.25 * error && bias > 0.249 * error);
  }
  s = scene_at(1e-9);
  assert_int_equal(gg_scene_ensemble_size(&s), 1000000);
  s = scene_at(1e-4);
  int64_t one = gg_scene_ensemble_size(&s);
  s.n_species = 2, s.species[0].fraction = 0.9, s.species[1] = s.species[0], s.species[1].fraction = 0.1;
  assert_true(gg_scene_ensemble_size(&s) >= 10 * one - 10 && gg_scene_ensemble_size(&s) <= 10 * one + 10);
}

static void between_walls(void **state)
{
  (void)state;
  gg_model m;
  char text[200];
  gg_scene s = scene_at(1e-3);
  s.flow = GG_COUETTE, s.phi = 0.3;
  assert_int_equal(gg_scene_ensemble_size(&s), 50000);
  gg_scene_ensemble_size_reason(&s, text, sizeof text);
  assert_non_null(strstr(text, "bias below 0.05 %, at most half of the requested error of 0.1 %"));
  s.phi = 0.01;
  assert_in_range(gg_scene_ensemble_size(&s), 8600, 8601);
  s.dsmc.particles = 1000, s.phi = 0.3;
  assert_int_equal(gg_scene_model_make(&s, GG_DSMC, &m, NULL), GG_OK);
  assert_true(fabs(gg_common_finite_size_bias_of(&m) - 0.025) < 1e-12);
}

/* md has `particles` grains, whatever error is requested. */
static void what_is_given(void **state)
{
  (void)state;
  gg_model m;
  char text[200];
  gg_scene s = scene_at(1e-4);
  gg_scene_ensemble_size_reason(&s, text, sizeof text);
  assert_non_null(strstr(text, "bias below 0.0025 %, at most a quarter of the requested error of 0.01 %"));
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_int_equal(m.n, s.particles);
  assert_int_equal(gg_scene_model_make(&s, GG_DSMC, &m, NULL), GG_OK);
  assert_int_equal(m.n, 80000);
  s.particles = 20000;
  assert_int_equal(gg_scene_ensemble_size(&s), 20000);
  s.dsmc.particles = 300;
  assert_int_equal(gg_scene_ensemble_size(&s), 300);
  gg_scene_ensemble_size_reason(&s, text, sizeof text);
  assert_string_equal(text, "");
}

static void of_a_resumed_run(void **state)
{
  (void)state;
  gg_archive a = {0}, b = {0};
  gg_scene first = scene_at(1e-3), then = scene_at(1e-5), last = scene_at(1e-4);
  assert_int_equal(gg_scene_resumption_put(&first, &a, NULL), GG_OK);
  assert_int_equal(gg_scene_resumption_settle(&then, &a, NULL), GG_OK);
  assert_int_equal(gg_scene_ensemble_size(&then), gg_scene_ensemble_size(&first));
  assert_int_equal(gg_scene_resumption_put(&then, &b, NULL), GG_OK);
  assert_int_equal(gg_scene_resumption_settle(&last, &b, NULL), GG_OK);
  assert_int_equal(gg_scene_ensemble_size(&last), gg_scene_ensemble_size(&first));
  gg_base_archive_clear(&a);
  gg_base_archive_clear(&b);
}

/* Steps between which a thermostat acts: a fifth of the asked error is what their bias may be. */
static void the_bias_of_a_thermostat_step_is_a_fifth_of_the_error(void **state)
{
  (void)state;
  gg_model m;
  for (double error = 1e-2; error > 1e-6; error /= 3) {
    gg_scene s = scene_at(error);
    s.flow = GG_HSS, s.thermostat = GG_WHITE_NOISE, s.collision.e[0] = 0.6;
    assert_int_equal(gg_scene_model_make(&s, GG_DSMC, &m, NULL), GG_OK);
    gg_dsmc_time_step step = gg_dsmc_time_step_choose(&m, 0.5);
    double h = step.splitting * gg_common_model_collision_rate(&m, 0.5);
    assert_true(step.bias > 0 && step.bias <= 0.2001 * error && h <= 0.2501);
    assert_true(step.bias > 0.1999 * error || h > 0.2499); /* no shorter than need be */
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(by_the_asked_error),
      cmocka_unit_test(between_walls),
      cmocka_unit_test(what_is_given),
      cmocka_unit_test(of_a_resumed_run),
      cmocka_unit_test(the_bias_of_a_thermostat_step_is_a_fifth_of_the_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
