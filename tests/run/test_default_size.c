/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The default number of grains, over a grid of cooling and heated gases: the usual one where its box is below the
 * length of Goldhirsch and Zanetti; else one whose box is below, and not far; 500 where their box is above. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/model.h"
#include "run/default_size.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"
#include "theory/goldhirsch_zanetti1993.h"

enum { USUAL = 1000, LEAST = 500 };

static gg_scene scene_of(const char *yaml)
{
  gg_scene s = gg_scene_defaults();
  gg_error err;
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK || gg_run_scene_finish(&s, &err) != GG_OK)
    fail_msg("%s: %s", yaml, err.message);
  return s;
}

/* Longest edge of a box of n grains over the length above which it is unstable. */
static double of_unstable(gg_scene s, int64_t n)
{
  gg_model m;
  s.particles = n;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  return fmax(m.box[0], fmax(m.box[1], m.box[2])) / gg_theory_clustering_length(&m);
}

/* 0: the usual box is stable; 1: a smaller one was chosen; 2: none is large enough. */
static int check_default(const char *yaml)
{
  const gg_scene s = scene_of(yaml);
  char why[200];
  gg_run_default_size_reason(&s, why, sizeof why);
  const bool stable = of_unstable(s, USUAL) <= 1, none = of_unstable(s, LEAST) > 1;
  if (stable) {
    assert_int_equal(s.particles, USUAL);
    assert_string_equal(why, "");
    return 0;
  }
  if (none) {
    assert_int_equal(s.particles, LEAST);
    assert_int_equal(strncmp(why, "automatic, the smallest: ", 25), 0);
    return 2;
  }
  assert_in_range(s.particles, LEAST, USUAL - 1);
  assert_true(of_unstable(s, s.particles) < 1);
  assert_true(s.particles == LEAST || of_unstable(s, s.particles) > 0.94);
  assert_true(s.particles == LEAST || of_unstable(s, s.particles) < 0.96);
  assert_int_equal(strncmp(why, "automatic: ", 11), 0);
  return 1;
}

static void test_grid(void **state)
{
  (void)state;
  static const char *const kinds[] = {"flow: hcs, ", "flow: hss, ", "flow: hcs, aspect: [2, 1, 1], ",
                                      "flow: hcs, species: [{fraction: 0.5}, {fraction: 0.5, mass: 4}], "};
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    int found[3] = {0};
    for (double phi = 0.05; phi < 0.5; phi += 0.05)
      for (double e = 0.6; e < 0.985; e += 0.02) {
        char yaml[200];
        snprintf(yaml, sizeof yaml, "{%sphi: %g, collision: {e: %g}}", kinds[k], phi, e);
        found[check_default(yaml)]++;
      }
    for (int i = 0; i < 3; i++) assert_true(found[i] > 3);
  }
  int rough = 0;
  for (double e = 0.6; e < 0.985; e += 0.02) {
    char yaml[200];
    snprintf(yaml, sizeof yaml, "{flow: hss, phi: 0.1, collision: {e: %g, beta: 0.9}}", e);
    rough += check_default(yaml) != 0;
  }
  assert_true(rough > 0);
}

/* The linear response to shear takes 0.4 of the stable number, cooling or with the Gaussian thermostat. */
static void test_linear_response(void **state)
{
  (void)state;
  static const char *const thermostats[] = {"none", "gaussian"};
  for (int k = 0; k < 2; k++) {
    char yaml[200];
    snprintf(yaml, sizeof yaml, "{flow: small_shear, thermostat: %s, phi: 0.1, collision: {e: 0.7}}", thermostats[k]);
    const gg_scene s = scene_of(yaml);
    const double length = of_unstable(s, s.particles);
    assert_true(s.particles < USUAL && length * length * length < 0.4 && length * length * length > 0.38);
  }
}

static void test_others_keep_it(void **state)
{
  (void)state;
  static const char *const scenes[] = {
      "{flow: usf, phi: 0.3, collision: {e: 0.8}}",
      "{flow: hss, thermostat: white_noise, phi: 0.2, collision: {e: 0.85}}",
      "{flow: hcs, phi: 0.2, collision: {e: 1}}",
      "{flow: hcs, phi: 0, engine: dsmc, collision: {e: 0.85}}",
      "{flow: hcs, phi: 0.2, collision: {e: 0.85, beta: 0, mu: 0.3}}",
      "{flow: hcs, phi: 0.2, collision: {e: 0.85, law: viscoelastic}}",
  };
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
    const gg_scene s = scene_of(scenes[i]);
    char why[200];
    gg_run_default_size_reason(&s, why, sizeof why);
    assert_int_equal(s.particles, USUAL);
    assert_string_equal(why, "");
  }
}

static void test_given_and_twice(void **state)
{
  (void)state;
  gg_scene given = scene_of("{flow: hcs, phi: 0.2, particles: 1000, collision: {e: 0.85}}");
  gg_scene twice = scene_of("{flow: hcs, phi: 0.2, collision: {e: 0.85}}");
  const int64_t n = twice.particles;
  char why[200];
  assert_int_equal(given.particles, 1000);
  gg_run_default_size_reason(&given, why, sizeof why);
  assert_string_equal(why, "");
  assert_int_equal(gg_run_scene_finish(&twice, NULL), GG_OK);
  assert_true(n < 1000 && twice.particles == n && gg_run_default_size(&given) == n);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_grid),
      cmocka_unit_test(test_linear_response),
      cmocka_unit_test(test_others_keep_it),
      cmocka_unit_test(test_given_and_twice),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
