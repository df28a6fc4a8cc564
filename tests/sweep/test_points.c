/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of a sweep: grids, keys that change together, random draws, and rejected input. The name of a point depends on
 * the keys that its numbers depend on, and on nothing else. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graingas.h"
#include "sweep/sweep_table.h"

#define SCENE "flow: usf\nphi: 0.1\nparticles: 100\n"

static gg_sweep *sweep_of(const char *yaml)
{
  gg_error err = {0};
  gg_sweep *sweep = NULL;
  if (gg_sweep_parse(yaml, "s.yaml", &sweep, &err) != GG_OK || gg_sweep_check(sweep, &err) != GG_OK)
    fail_msg("%s", err.message);
  return sweep;
}

/* "0.7 0.1|0.7 0.2|...": the values of all points. */
static void check_values(const char *yaml, const char *expected)
{
  char text[1000] = "";
  gg_sweep *sweep = sweep_of(yaml);
  for (size_t i = 0; i < gg_sweep_points(sweep); i++)
    for (size_t k = 0; gg_sweep_key(sweep, k); k++) {
      size_t used = strlen(text);
      snprintf(text + used, sizeof text - used, "%s%s", k ? " " : i ? "|" : "", gg_sweep_value(sweep, i, k));
    }
  assert_string_equal(text, expected);
  gg_sweep_free(sweep);
}

static void lists_and_ranges_make_a_grid(void **state)
{
  (void)state;
  check_values(SCENE "vary: {collision.e: [0.7, 0.9], phi: 0.1:0.3:0.1}",
               "0.7 0.1|0.7 0.2|0.7 0.3|0.9 0.1|0.9 0.2|0.9 0.3");
  check_values(SCENE "vary: {collision: {e: 0.5, beta: [0, 0.25]}}", "0.5 0|0.5 0.25");
  check_values(SCENE "vary: {phi: 0.3:0.1:-0.1}", "0.3|0.2|0.1");
  check_values(SCENE "vary: {phi: [0.05, 0.1:0.2:0.05]}", "0.05|0.1|0.15|0.2");
  check_values(SCENE "vary: {collision.beta: -0.3:0.3:0.1}", "-0.3|-0.2|-0.1|0|0.1|0.2|0.3");
  check_values(SCENE "vary: {engine: [md, dsmc]}", "md|dsmc");
  check_values(SCENE "vary: {measure: [[rheology], [rheology, cells]]}", "[rheology]|[rheology, cells]");
}

static void keys_of_one_item_vary_together(void **state)
{
  (void)state;
  check_values(SCENE "vary: [{collision.e: [0.7, 0.9], phi: [0.1, 0.2]}, {particles: [100, 200]}]",
               "0.7 0.1 100|0.7 0.1 200|0.9 0.2 100|0.9 0.2 200");
}

/* Whole numbers reach both ends of their range, and two keys are drawn independently: at most points they differ by a
 * third of the range. */
static void drawn_apart(void **state)
{
  (void)state;
  gg_sweep *sweep = sweep_of(SCENE "vary: {random: {points: 200, seed: 7}, phi: 0.1..0.2, particles: 50..60}");
  int first = 0, last = 0, apart = 0;
  for (size_t i = 0; i < 200; i++) {
    const double phi = strtod(gg_sweep_value(sweep, i, 0), NULL), n = strtod(gg_sweep_value(sweep, i, 1), NULL);
    first += n == 50, last += n == 60;
    apart += fabs((phi - 0.1) / 0.1 - (n - 50) / 10) > 0.33;
  }
  assert_true(first > 5 && last > 5 && apart > 60);
  gg_sweep_free(sweep);
}

/* More points, or another key, do not change the other draws. */
static void a_draw_does_not_depend_on_other_keys_or_points(void **state)
{
  (void)state;
  gg_sweep *few = sweep_of(SCENE "vary: {random: {points: 20, seed: 7}, phi: 0.1..0.2, particles: 50..60}");
  gg_sweep *many =
      sweep_of(SCENE "vary: {random: {points: 30, seed: 7}, engine: [md, dsmc], particles: 50..60, phi: 0.1..0.2}");
  gg_sweep *other = sweep_of(SCENE "vary: {random: {points: 20, seed: 8}, phi: 0.1..0.2, particles: 50..60}");
  bool differs = false, low = false, high = false, dsmc = false;
  assert_int_equal(gg_sweep_points(few), 20);
  assert_int_equal(gg_sweep_points(many), 30);
  for (size_t i = 0; i < 20; i++) {
    const char *phi = gg_sweep_value(few, i, 0), *particles = gg_sweep_value(few, i, 1);
    assert_string_equal(phi, gg_sweep_value(many, i, 2));
    assert_string_equal(particles, gg_sweep_value(many, i, 1));
    differs |= strcmp(phi, gg_sweep_value(other, i, 0)) != 0;
    assert_true(strtod(phi, NULL) >= 0.1 && strtod(phi, NULL) <= 0.2);
    assert_true(strtol(particles, NULL, 10) >= 50 && strtol(particles, NULL, 10) <= 60 && !strchr(particles, '.'));
    low |= strtod(phi, NULL) < 0.13;
    high |= strtod(phi, NULL) > 0.17;
    dsmc |= strcmp(gg_sweep_value(many, i, 0), "dsmc") == 0;
  }
  assert_true(differs && low && high && dsmc);
  gg_sweep_free(few);
  gg_sweep_free(many);
  gg_sweep_free(other);
}

static void name_of(const char *yaml, gg_sweep_point *point)
{
  gg_sweep *sweep = sweep_of(yaml);
  assert_int_equal(gg_sweep_at(sweep, 0, point, NULL), GG_OK);
  gg_sweep_free(sweep);
}

static void check_name(const char *yaml, bool same)
{
  gg_sweep_point one, two;
  name_of("flow: usf\nphi: 0.1\nparticles: 100\nvary: {collision.e: [0.8]}", &one);
  name_of(yaml, &two);
  if ((strcmp(one.name, two.name) == 0) != same) fail_msg("%s: %s, %s", yaml, one.name, two.name);
}

/* The name does not depend on the order of keys, on defaults that are written out, on where a value is given, or on
 * keys that change no number. */
static void a_name_depends_on_what_changes_numbers_alone(void **state)
{
  (void)state;
  check_name("vary: {collision.e: [0.8, 0.9]}\nparticles: 1.0e2\nphi: 0.10\nflow: usf", true);
  check_name("flow: usf\nphi: 0.1\nparticles: 100\ncollision: {e: 0.8, beta: -1, mu: inf}\nengine: md\n"
             "run: {relative_error: auto, seed: 1}\nvary: {walls.e: [0.9]}",
             true);
  check_name(SCENE "collision: {e: 0.8}\nvary: {phi: 0.1:0.3:0.1}\noutput: {checkpoint_every: 7}", true);
  check_name(SCENE "collision: {e: 0.81}\nvary: {phi: [0.1]}", false);
  check_name(SCENE "collision: {e: 0.8}\nvary: {particles: [101]}", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nrun: {seed: 2}", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nrun: {relative_error: 0.02}", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nrun: {warmup: 10}", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\noutput: {trajectory_every: 7}", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nmeasure: [rheology, cells]", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nengine: dsmc", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nsweep: {does: compare}", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nsweep: {seeds: common}", false);
  check_name(SCENE "vary: {collision.e: [0.8]}\nsweep: {at_once: 5}", true);
}

static void check_seeds(const char *vary, bool same)
{
  char yaml[200];
  gg_sweep_point a, b;
  snprintf(yaml, sizeof yaml, SCENE "vary: {%s}", vary);
  gg_sweep *sweep = sweep_of(yaml);
  gg_sweep_at(sweep, 0, &a, NULL);
  gg_sweep_at(sweep, 1, &b, NULL);
  if ((a.seed == b.seed) != same) fail_msg("%s: %llu, %llu", vary, (unsigned long long)a.seed, (long long)b.seed);
  gg_sweep_free(sweep);
}

/* Points that differ in the length of their runs have different names; other observables do not change a name. */
static void seeds_of_lengths(void **state)
{
  (void)state;
  check_seeds("run.replicas: [1, 2]", false);
  check_seeds("run.collisions: [400, 800]", false);
  check_seeds("run.warmup: [0, 2]", false);
  check_seeds("run.relative_error: [0.01, 0.02]", false);
  check_seeds("run.time_limit: [1, 2]", false);
  check_seeds("species: [[{}, {mass: 2}], [{}, {mass: 3}]]", false);
  check_seeds("run: [{collisions: 10}, {collisions: 20}]", false);
  check_seeds("measure: [[rheology], [cells]]", true);
  check_seeds("engine: [md, dsmc]", true);
  check_seeds("output.trajectory_every: [10, 20]", true);
}

/* Seeds: one for each point, the same if only length or engine differ; or that of the scene for all. */
static void each_point_has_a_seed_of_its_own(void **state)
{
  (void)state;
  gg_sweep_point a, b;
  gg_sweep *sweep = sweep_of(SCENE "vary: {collision.e: [0.7, 0.8]}");
  gg_sweep_at(sweep, 0, &a, NULL);
  gg_sweep_at(sweep, 1, &b, NULL);
  assert_true(a.seed != b.seed && a.seed < UINT64_C(1) << 48);
  gg_sweep_free(sweep);
  name_of(SCENE "run: {relative_error: 0.001}\nengine: dsmc\nvary: {collision.e: [0.7]}", &b);
  assert_true(a.seed == b.seed);
  name_of(SCENE "run: {seed: 5}\nvary: {collision.e: [0.7]}\nsweep: {seeds: common}", &b);
  assert_true(b.seed == 5);
  name_of(SCENE "vary: {run.seed: [6]}", &b);
  assert_true(b.seed == 6);
}

/* Long points are divided among replicas, unless the scene gives their number. */
static void long_points_are_divided_among_replicas(void **state)
{
  (void)state;
  gg_sweep_point a;
  name_of(SCENE "run: {relative_error: 0.0002}\nvary: {collision.e: [0.7]}", &a);
  assert_true(a.replicas > 1 && a.cpu_seconds / (double)a.replicas < 660);
  name_of(SCENE "run: {relative_error: 0.0002, replicas: 1}\nvary: {collision.e: [0.7]}", &a);
  assert_int_equal(a.replicas, 1);
  name_of(SCENE "run: {relative_error: 0.01}\nvary: {collision.e: [0.7]}", &a);
  assert_int_equal(a.replicas, 1);
}

static void check_combination(const char *yaml, size_t i, const char *name)
{
  char text[GG_COMBINATION_NAME];
  gg_sweep *sweep = sweep_of(yaml);
  gg_sweep_line_group_name(sweep, i, 1, text);
  assert_string_equal(text, name);
  gg_sweep_free(sweep);
}

#define LONG "rheology, velocity_distributions, pair_correlation, "

/* Names of the rows of the keys beside the second one. */
static void a_row_is_named_by_the_values_of_its_keys(void **state)
{
  (void)state;
  const char *three = SCENE "vary: {collision.e: [0.7, 0.9], particles: [100, 200], phi: [0.1, 0.2, 0.3]}";
  check_combination(three, 4, "e = 0.7, φ = 0.2");
  check_combination(three, 11, "e = 0.9, φ = 0.3");
  const char *lists = SCENE "vary: {measure: [[" LONG "cells], [" LONG "sonine]], phi: [0.1, 0.2]}";
  check_combination(lists, 1, "measure = …cells…");
  check_combination(lists, 3, "measure = …sonine…");
  const char *cut = SCENE "vary: {measure: [[" LONG "cells], [cells, " LONG "sonine]], phi: [0.1, 0.2]}";
  check_combination(cut, 1, "measure = …rheology, velocity\\_distributions, pair\\_correlation, cells…");
  check_combination(cut, 3, "measure = …cells, rheology, velocity\\_distributions, pair\\_correlation, sonine…");
  check_combination(SCENE "vary: [{collision.e: [0.7], collision.beta: [0]}, {phi: [0.1, 0.2]}, "
                          "{md.contact_time: [0.0001], walls.e: [0.9], run.replicas: [2], run.warmup: [123456789]}]",
                    1,
                    "e = 0.7, β = 0, md.contact\\_time = 0.0001, e_w = 0.9, run.replicas = 2, run.warmup = 123456789");
}

static double seconds_of(const char *yaml)
{
  gg_sweep_point a;
  name_of(yaml, &a);
  return a.cpu_seconds;
}

/* The time of theories, alone and in comparisons, is that of the slowest one, and almost none if that does not apply.
 */
static void theories_take_time(void **state)
{
  (void)state;
  const double rough = seconds_of(SCENE "collision: {beta: 0}\nvary: {collision.e: [0.9]}\nsweep: {does: theory}");
  assert_true(rough > 0.3 && rough < 3);
  const double md = seconds_of(SCENE "run: {collisions: 10}\ncollision: {beta: 0}\nvary: {collision.e: [0.9]}");
  const double all = seconds_of(SCENE "run: {collisions: 10}\ncollision: {beta: 0}\nvary: {collision.e: [0.9]}\n"
                                      "sweep: {does: compare}");
  assert_true(all > md + rough);
  const char *species =
      "flow: hss\nphi: 0.1\nvary: {species: [[{fraction: 0.5}, {fraction: 0.5, mass: 2}]]}\nsweep: {does: theory}";
  assert_true(seconds_of(species) >
              seconds_of("flow: hss\nphi: 0.1\nvary: {collision.e: [0.9]}\nsweep: {does: theory}"));
  assert_true(seconds_of("flow: couette\nphi: 0.1\nvary: {collision.e: [0.9]}\nsweep: {does: theory}") < 0.1);
}

static void check_refused(const char *yaml, const char *key, const char *values, const char *words)
{
  gg_error err = {0};
  gg_sweep *sweep = NULL;
  gg_status status = gg_sweep_parse(yaml, "s.yaml", &sweep, &err);
  if (status == GG_OK && key) status = gg_sweep_vary(sweep, key, values, &err);
  if (status == GG_OK) status = gg_sweep_check(sweep, &err);
  assert_int_equal(status, GG_BAD_INPUT);
  if (!strstr(err.message, words)) fail_msg("%s: %s", yaml, err.message);
  gg_sweep_free(sweep);
}

static void bad_points_are_refused_with_key_and_value(void **state)
{
  (void)state;
  const char *five = SCENE "vary: {phi: [0.1, 0.2, 0.7, 0.3, 0.4]}";
  check_refused(five, NULL, NULL, "s.yaml: point 3 of 5 (phi 0.7): key 'phi': value '0.7'");
  check_refused(SCENE "vary: {phi: [0.1]}", "phi", "0.2", "varied twice");
  check_refused(SCENE "vary: {phi: [0.1], phi: [0.2]}", NULL, NULL, "varied twice");
  check_refused(SCENE "vary:", NULL, NULL, "vary");
  check_refused(SCENE "vary: {phi: []}", NULL, NULL, "has no values");
  check_refused(SCENE "vary: [{phi: [0.1, 0.2], collision.e: [0.5]}]", NULL, NULL, "has 1 values, and phi");
  check_refused(SCENE "vary: {phi: 0.1..0.2}", NULL, NULL, "random draws");
  check_refused(SCENE, "phi", "0.1..0.2", "random draws");
  check_refused(SCENE, "phi", "0.1:0.2:-0.1", "does not lead");
  check_refused(SCENE, "phi", "0.1,,0.2", "a value is missing");
  check_refused(SCENE, "particles", "1:10000000:1", "10000000 values");
  check_refused(SCENE "vary: {collision.e: 0:1:0.001}", "phi", "0:0.5:0.001", "501501 points");
  check_refused(SCENE "vary: {collison.e: [0.5]}", NULL, NULL, "did you mean 'collision.e'");
  check_refused(SCENE "sweep: {does: comparision}", NULL, NULL, "allowed: one of run, compare, theory");
  check_refused(SCENE "vary: {phi: [0.1, 0.2..0.3]}", NULL, NULL, "either drawn from LOW..HIGH or from a list");
  check_refused(SCENE "vary: {[phi]: 0.1}", NULL, NULL, "a key must be a word");
  check_refused(SCENE "vary: {collision: 0.5}", NULL, NULL, "collision");
  check_refused(SCENE "vary: {collision.e: [{of: 'a law'}]}", NULL, NULL, "collision.e");
  check_refused(SCENE "vary: [{phi: 0.1..0.2}]", NULL, NULL, "random draws");
  check_refused(SCENE "vary: [{phi: [0.1], phi: [0.2]}]", NULL, NULL, "varied twice");
  check_refused(SCENE "vary: [{}]", NULL, NULL, "no key is varied");
  check_refused(SCENE "vary: {random: 3, phi: 0.1..0.2}", NULL, NULL, "say how many points");
  check_refused(SCENE "vary: {random: {seed: 3}, phi: 0.1..0.2}", NULL, NULL, "say how many points");
  check_refused(SCENE "vary: {random: {[seed]: 3}, phi: 0.1..0.2}", NULL, NULL, "a key must be a word");
  check_refused(SCENE "vary: {random: {points: 3}}", NULL, NULL, "no key is drawn");
  check_refused(SCENE "sweep: run", NULL, NULL, "is a section");
  check_refused(SCENE "sweep: {[does]: run}", NULL, NULL, "a key must be a word");
  check_refused(SCENE "sweep: {does: run, does: run}", NULL, NULL, "is given twice");
  /* Short inputs that would fill the memory. */
  check_refused(SCENE, "phi", "0:0.5:0.00001,0:0.5:0.00001,0:0.5:0.00001", "more than 100000 values");
  char *longest = calloc(1, 60000);
  strcat(longest, SCENE "vary: {random: {points: 100000}, measure: [[rheology, ");
  for (int i = 0; i < 900; i++) strcat(longest, "cells, ");
  check_refused(strcat(longest, "cells]]}"), NULL, NULL, "characters together");
  free(longest);
  check_refused("flow: usf\nvary: {phi: [0]}", NULL, NULL, "point 1 of 1 (phi 0)"); /* md has no Boltzmann limit */
}

/* A grid of one map, and maps whose keys change together. */
static void too_many_keys(void **state)
{
  (void)state;
  char one[2000] = SCENE "vary: {", several[2000] = SCENE "vary: [";
  for (int i = 0; i < 33; i++) {
    size_t a = strlen(one), b = strlen(several);
    snprintf(one + a, sizeof one - a, "species.%d.mass: [1, 2], ", i + 1);
    snprintf(several + b, sizeof several - b, "{species.%d.mass: [1]}, ", i + 1);
  }
  check_refused(strcat(one, "}"), NULL, NULL, "more than 32 keys are varied");
  check_refused(strcat(several, "]"), NULL, NULL, "more than 32 keys are varied");
}

/* Numbers are numbers in JSON, and whole numbers integers. */
static void values_in_json(void **state)
{
  (void)state;
  char *text = NULL;
  gg_sweep *sweep =
      sweep_of(SCENE "vary: [{run.time_limit: [none, 0.5, 3], collision.law: [constant, constant, constant]}]");
  assert_int_equal(gg_sweep_to_json(sweep, "there_is_none.sweep", &text, NULL), GG_OK);
  const char *said[] = {"\"none\"", "0.5", ": 3", "\"constant\"", "\"missing\""};
  for (int i = 0; i < 5; i++)
    if (!strstr(text, said[i])) fail_msg("no %s in %s", said[i], text);
  free(text);
  gg_sweep_free(sweep);
}

/* A comparison leaves out an engine that cannot run the scene. */
static void an_engine_that_cannot_run_the_scene_is_left_out(void **state)
{
  (void)state;
  gg_sweep *sweep = sweep_of("flow: usf\nvary: {phi: [0, 0.1]}\nsweep: {does: compare}");
  assert_int_equal(gg_sweep_points(sweep), 2);
  assert_int_equal(gg_sweep_set(sweep, "collision.e", "0.5", NULL), GG_BAD_INPUT); /* it was checked */
  gg_sweep_free(sweep);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lists_and_ranges_make_a_grid),
      cmocka_unit_test(keys_of_one_item_vary_together),
      cmocka_unit_test(a_draw_does_not_depend_on_other_keys_or_points),
      cmocka_unit_test(a_name_depends_on_what_changes_numbers_alone),
      cmocka_unit_test(each_point_has_a_seed_of_its_own),
      cmocka_unit_test(drawn_apart),
      cmocka_unit_test(long_points_are_divided_among_replicas),
      cmocka_unit_test(bad_points_are_refused_with_key_and_value),
      cmocka_unit_test(an_engine_that_cannot_run_the_scene_is_left_out),
      cmocka_unit_test(too_many_keys),
      cmocka_unit_test(values_in_json),
      cmocka_unit_test(a_row_is_named_by_the_values_of_its_keys),
      cmocka_unit_test(theories_take_time),
      cmocka_unit_test(seeds_of_lengths),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
