/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, with the real engines: a gas that starts near its steady state needs no warm-up for its sampling interval. In
 * a gas that cools or heats for ever the interval follows the temperature in the engine's units: samples are
 * GG_SAMPLING_INTERVAL collisions per grain apart. Messages state the true number of collisions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graingas.h"
#include "run/replica.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

static void create(gg_replica *r, const char *yaml, gg_engine_kind engine)
{
  gg_scene s = gg_scene_defaults();
  gg_model m;
  gg_error err = {0};
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK || gg_scene_finish(&s, &err) != GG_OK)
    fail_msg("%s", err.message);
  s.engine = engine;
  if (gg_scene_model_make(&s, engine, &m, &err) != GG_OK || gg_run_replica_create(r, &s, &m, 0, &err) != GG_OK)
    fail_msg("%s: %s", yaml, err.message);
}

/* The warm-up continues until the sampling interval fits the speed of the grains; it fits at the start here. */
static void interval_fits_at_the_start(void **state)
{
  (void)state;
  static const char *const scenes[] = {
      "{flow: usf, phi: 0.1, particles: 300}",
      "{flow: hcs, phi: 0.1, particles: 300, collision: {beta: 0}}",
      "{flow: equilibrium, phi: 0.1, particles: 300}",
  };
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++)
    for (gg_engine_kind engine = 0; engine <= GG_DSMC; engine++) {
      gg_replica r;
      create(&r, scenes[k], engine);
      if (!gg_run_replica_interval_fits(&r, 50)) fail_msg("%s: has to warm up", scenes[k]);
      gg_run_replica_clear(&r);
    }
}

/* Each sweep of the reduced shear rate heats by 16 or cools by 256, and the next begins where the last did: in units of
 * the start the temperature of the heated gas is infinite after 256. */
static void sweeps_without_end(void **state)
{
  (void)state;
  static const char *const scenes[] = {
      "{flow: small_shear, thermostat: gaussian, phi: 0.1, particles: 100, collision: {e: 0.8}}",
      "{flow: small_shear, phi: 0.1, particles: 100, collision: {e: 0.8}}",
  };
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
    gg_replica r;
    gg_error err = {0};
    create(&r, scenes[k], GG_DSMC);
    assert_int_equal(gg_run_replica_advance(&r, 1, true, NULL, &err), GG_OK);
    const double first = r.clock.temperature;
    assert_int_equal(gg_run_replica_advance(&r, 4000, true, NULL, &err), GG_OK);
    const double risen = r.clock.temperature / first;
    if (!(risen > 1e-3 && risen < 1e3)) fail_msg("%s: %g times that of the start", scenes[k], risen);
    gg_run_replica_clear(&r);
  }
}

static void expect_two(const char *scene, int begin, int end)
{
  gg_replica r;
  gg_error err = {0};
  create(&r, scene, GG_DSMC);
  assert_int_equal(gg_run_replica_advance(&r, (uint64_t)begin, true, NULL, &err), GG_OK);
  const double before = gg_run_replica_collisions_per_grain(&r);
  assert_int_equal(gg_run_replica_advance(&r, (uint64_t)end, true, NULL, &err), GG_OK);
  const double apart = (gg_run_replica_collisions_per_grain(&r) - before) / (end - begin);
  if (fabs(apart / GG_SAMPLING_INTERVAL - 1) > 0.03) fail_msg("%s: %g collisions a grain apart", scene, apart);
  gg_run_replica_clear(&r);
}

/* If the temperature changes for ever, intervals are two collisions per grain long up to the change of the collision
 * rate within one interval. */
static void two_collisions_apart(void **state)
{
  (void)state;
  static const char *const scenes[] = {
      "{flow: hcs, phi: 0.1, particles: 2000, collision: {e: 0}}",
      "{flow: hcs, phi: 0.1, particles: 2000, collision: {e: 0.8, beta: 0}}",
      "{flow: hcs, phi: 0, particles: 2000, collision: {e: 0.5, law: viscoelastic}}",
      "{flow: hcs, phi: 0.1, collision: {e: 0.5}, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 2, mass: 8}]}",
      "{flow: usf, phi: 0.1, particles: 2000, collision: {e: 1}}",
      "{flow: small_shear, phi: 0.1, particles: 2000, collision: {e: 0.5}}",
  };
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) expect_two(scenes[k], 20, 120);
}

/* The same after the temperature has underflowed in units of the start. */
static void far_below(void **state)
{
  (void)state;
  expect_two("{flow: hcs, phi: 0.1, particles: 500, collision: {e: 0}, dsmc: {particles: 500}}", 1300, 1700);
  expect_two("{flow: hcs, phi: 0.1, particles: 500, collision: {e: 0}, dsmc: {particles: 500}}", 3000, 3400);
}

/* The interval of a steady state is as uncertain as one count of few grains. The message must state the number of
 * collisions that happened, not intended ones. */
static void true_number_is_reported(void **state)
{
  (void)state;
  static const char yaml[] =
      "{flow: equilibrium, engine: dsmc, phi: 0.2, dsmc: {particles: 50}, run: {collisions: 1200}}";
  gg_scene s = gg_scene_defaults();
  gg_error err = {0};
  gg_result *result = NULL;
  double stated = 0;
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK || gg_scene_finish(&s, &err) != GG_OK ||
      gg_run_scene(&s, NULL, 1, NULL, &result, &err) != GG_OK)
    fail_msg("%s", err.message);
  assert_int_equal(sscanf(result->steadiness_text, "no trend over %lf collisions", &stated), 1);
  const double happened = 2 * (double)result->averaging.collisions / 50;
  if (fabs(stated - happened) > 0.51) fail_msg("%s, and there were %g", result->steadiness_text, happened);
  gg_result_free(result);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(interval_fits_at_the_start), cmocka_unit_test(sweeps_without_end),
      cmocka_unit_test(two_collisions_apart),       cmocka_unit_test(far_below),
      cmocka_unit_test(true_number_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
