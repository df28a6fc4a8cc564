/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law of restitution of a user's program is obeyed by both engines; one that is none is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "extended.h"
#include "graingas.h"
#include "run/z_scores.h"
#include "scene/model_of_scene.h"

static double above_one(void *context, double speed, int one, int two)
{
  (void)context, (void)one, (void)two;
  return speed > 100 ? 1.5 : 0.9;
}

/* A law that returns a constant is that constant: the same run of md, bit for bit, smooth, rough and of two species;
 * the same means of dsmc, which takes another path. */
static void test_constant_law(void **state)
{
  (void)state;
  double e = 0.9;
  const char *const scenes[] = {
      sheared,
      "{flow: usf, phi: 0.3, particles: 400, collision: {beta: 0.2, mu: 0.3}, run: {collisions: 40, warmup: 10}}",
      "{flow: hcs, phi: 0.1, particles: 400, species: [{fraction: 0.5}, {fraction: 0.5, mass: 4}], run: {collisions: "
      "40, "
      "warmup: 10}}",
      "{flow: hss, phi: 0.1, particles: 400, run: {collisions: 40, warmup: 10}}"};
  for (int k = 0; k < 4; k++) {
    gg_scene *plain = scene_of(scenes[k]), *lawful = scene_of(scenes[k]);
    set_law(lawful, "constant", constant, &e);
    gg_result *one = run(plain, 1), *two = run(lawful, 1);
    assert_true(one->model.temperature0 == two->model.temperature0);
    assert_int_equal(one->final.n, two->final.n);
    assert_memory_equal(one->final.velocity, two->final.velocity, 3 * one->final.n * sizeof(double));
    assert_int_equal(one->total.collisions, two->total.collisions);
    gg_result_free(one), gg_result_free(two);
    gg_scene_free(plain), gg_scene_free(lawful);
  }
}

static void test_constant_law_dsmc(void **state)
{
  (void)state;
  double e = 0.9;
  gg_scene *plain = scene_of(sheared_dsmc), *lawful = scene_of(sheared_dsmc);
  set_law(lawful, "constant", constant, &e);
  gg_result *one = run(plain, 1), *two = run(lawful, 1);
  const gg_quantity all[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_SHEAR_VISCOSITY, GG_Q_DISSIPATION};
  for (int k = 0; k < 4; k++) {
    double z = gg_run_z_score(&one->value[all[k]], &two->value[all[k]]);
    if (!(fabs(z) < 4.5)) fail_msg("%s: z = %.1f", gg_common_quantity_name(all[k]), z);
  }
  gg_result_free(one), gg_result_free(two);
  gg_scene_free(plain), gg_scene_free(lawful);
}

/* Both engines under a law e(g): shear work is what collisions lose; they agree where the gas is dilute. Theories of a
 * constant e do not apply. */
static void test_falling_law(void **state)
{
  (void)state;
  gg_error err;
  gg_comparison c;
  gg_scene *scene = scene_of("{flow: usf, phi: 0.01, particles: 1000, run: {collisions: 400, warmup: 60}}");
  set_law(scene, "falling", falling, NULL);
  if (gg_run_compare_scene(scene, NULL, 2, NULL, &c, &err) != GG_OK) fail_msg("%s", err.message);
  for (int k = 0; k < 2; k++) {
    const gg_estimate *balance = &c.by_engine[k]->value[GG_Q_ENERGY_BALANCE];
    if (!(fabs(balance->mean - 1) < 4.5 * balance->error && balance->error < 0.02))
      fail_msg("energy balance %g +- %g", balance->mean, balance->error);
  }
  double md = c.by_engine[GG_MD]->value[GG_Q_TEMPERATURE].mean,
         dsmc = c.by_engine[GG_DSMC]->value[GG_Q_TEMPERATURE].mean;
  double z =
      gg_run_z_score(&c.by_engine[GG_MD]->value[GG_Q_TEMPERATURE], &c.by_engine[GG_DSMC]->value[GG_Q_TEMPERATURE]);
  print_message("# T: md %g, dsmc %g, z = %.1f\n", md, dsmc, z);
  assert_true(fabs(md / dsmc - 1) < 0.01 || fabs(z) < 3);
  for (int i = 0; i < c.n_theories; i++) assert_false(c.theory[i].applies);
  assert_non_null(strstr(c.theory[0].reason, "'falling'"));
  gg_run_comparison_clear(&c);
  gg_scene_free(scene);
}

/* e = 1 below a speed that nothing reaches is a gas that loses nothing; 0.5 above one that all exceed is e = 0.5. */
static void test_limits_of_a_table(void **state)
{
  (void)state;
  gg_error err;
  const double far[] = {1e6, 1e7}, near[] = {1e-9, 1e-8}, e[] = {1, 0.5};
  gg_scene *scene = scene_of("{flow: hcs, engine: dsmc, phi: 0.1, run: {collisions: 40, warmup: 5}}");
  assert_int_equal(gg_scene_set_restitution_table(scene, "far", 2, far, e, &err), GG_OK);
  gg_result *r = run(scene, 1);
  assert_true(fabs(r->value[GG_Q_COOLING_RATE].mean) < 1e-9);
  gg_result_free(r);
  assert_int_equal(gg_scene_set_restitution_table(scene, "near", 2, near, e, &err), GG_OK);
  r = run(scene, 1);
  gg_scene *half =
      scene_of("{flow: hcs, engine: dsmc, phi: 0.1, collision: {e: 0.5}, run: {collisions: 40, warmup: 5}}");
  gg_result *expected = run(half, 1);
  double z = gg_run_z_score(&r->value[GG_Q_COOLING_RATE], &expected->value[GG_Q_COOLING_RATE]);
  if (!(fabs(z) < 4.5)) fail_msg("cooling rate: z = %.1f", z);
  gg_result_free(r), gg_result_free(expected);
  gg_scene_free(scene), gg_scene_free(half);
}

/* Velocities of a cooling gas are brought back now and then: a law of speed must not notice. With e = 1 below a speed
 * the gas stops cooling there, at the same temperature in both engines. */
static void test_law_of_a_cooling_gas(void **state)
{
  (void)state;
  gg_error err;
  const double speed[] = {0.02, 0.04}, e[] = {1, 0.6};
  double coldest[2];
  for (int k = 0; k < 2; k++) {
    gg_scene *scene = scene_of("{flow: hcs, phi: 0.01, particles: 300, run: {collisions: 600, warmup: 10}}");
    gg_scene_set(scene, "engine", k ? "dsmc" : "md", NULL);
    assert_int_equal(gg_scene_set_restitution_table(scene, "stops", 2, speed, e, &err), GG_OK);
    gg_result *r = NULL;
    gg_run_scene(scene, NULL, 1, NULL, &r, &err);
    assert_non_null(r);
    coldest[k] = r->history.value[0][r->history.n - 1];
    print_message("# %s: T = %g at the end\n", r->engine, coldest[k]);
    assert_true(coldest[k] > 1e-6 && coldest[k] < 1e-3);
    gg_result_free(r);
    gg_scene_free(scene);
  }
  assert_true(fabs(log(coldest[0] / coldest[1])) < 0.3);
}

static void test_bad_laws(void **state)
{
  (void)state;
  gg_error err;
  double e = 0.9, nan = NAN;
  const double speed[] = {1, 2}, back[] = {2, 1}, good[] = {0.9, 0.8}, bad[] = {0.9, 1.1};
  gg_scene *scene = scene_of(sheared);
  refused(gg_scene_set_restitution(NULL, "x", constant, &e, &err), &err, "scene");
  refused(gg_scene_set_restitution(scene, NULL, constant, &e, &err), &err, "missing");
  refused(gg_scene_set_restitution(scene, "x y", constant, &e, &err), &err, "not a valid name");
  refused(gg_scene_set_restitution(scene, "x", constant, &nan, &err), &err, "from 0 to 1");
  refused(gg_scene_set_restitution(scene, "x", above_one, NULL, &err), &err, "1.5");
  refused(gg_scene_set_restitution_table(scene, "x", 0, speed, good, &err), &err, "table");
  refused(gg_scene_set_restitution_table(scene, "x", 2, NULL, good, &err), &err, "table");
  refused(gg_scene_set_restitution_table(scene, "x", 2, back, good, &err), &err, "ascend");
  refused(gg_scene_set_restitution_table(scene, "x", 2, speed, bad, &err), &err, "from 0 to 1");
  assert_null(scene->extension);
  set_law(scene, "x", constant, &e);
  set_law(scene, NULL, NULL, NULL); /* back to a constant */
  gg_model m;
  assert_int_equal(gg_scene_model_make(scene, GG_MD, &m, &err), GG_OK);
  assert_true(m.law.e == NULL);
  gg_scene_free(scene);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_constant_law),         cmocka_unit_test(test_constant_law_dsmc),
      cmocka_unit_test(test_falling_law),          cmocka_unit_test(test_limits_of_a_table),
      cmocka_unit_test(test_law_of_a_cooling_gas), cmocka_unit_test(test_bad_laws),
  };
  return cmocka_run_group_tests_name("own_law", tests, NULL, NULL);
}
