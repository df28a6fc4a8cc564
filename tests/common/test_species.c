/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Species and their pairs: every pair has one number, whatever the number of species, and one name that is read back;
 * grains are dealt by the largest remainders, and no species goes without. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "common/contact_value.h"
#include "common/model.h"
#include "scene/model_of_scene.h"

static void pairs_are_numbered(void **state)
{
  (void)state;
  int seen[GG_PAIRS] = {0};
  assert_true(gg_pair(0, 0) == GG_11 && gg_pair(1, 0) == GG_12 && gg_pair(1, 1) == GG_22);
  for (int n = 1; n <= GG_MAX_SPECIES; n++) {
    for (int i = 0; i < n; i++) {
      int q = gg_pair(i, n - 1);
      gg_species_pair p = gg_common_pair_species(q);
      assert_true(q < gg_pairs_of(n) && q >= gg_pairs_of(n - 1) && q == gg_pair(n - 1, i));
      assert_true(p.i == i && p.j == n - 1);
      seen[q]++;
    }
  }
  for (int q = 0; q < GG_PAIRS; q++) assert_int_equal(seen[q], 1);
}

static void pairs_have_names(void **state)
{
  (void)state;
  char name[GG_PAIR_NAME];
  for (int q = 0; q < GG_PAIRS; q++) assert_int_equal(gg_common_pair_find(gg_common_pair_name(q, name)), q);
  assert_string_equal(gg_common_pair_name(gg_pair(1, 2), name), "23");
  assert_string_equal(gg_common_pair_name(gg_pair(9, 0), name), "1-10");
  assert_int_equal(gg_common_pair_find("2-1"), GG_12);
  static const char *const none[] = {"", "1", "0", "10", "01", "111", "1-", "-1", "1-0", "1-17", "1-01", "1-2-3", "ab"};
  for (size_t k = 0; k < sizeof none / sizeof *none; k++) assert_int_equal(gg_common_pair_find(none[k]), -1);
}

static gg_scene scene_of(int species, int64_t grains)
{
  gg_scene s = gg_scene_defaults();
  s.phi = 0.3, s.n_species = species, s.particles = grains;
  for (int i = 0; i < species; i++) s.species[i].fraction = 1.0 / species;
  return s;
}

static void grains_are_dealt(void **state)
{
  (void)state;
  gg_model m;
  gg_error err;
  gg_scene s = scene_of(10, 1004);
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
  for (int i = 0; i < 10; i++) assert_int_equal(m.n_of[i], i < 4 ? 101 : 100); /* equal remainders: the first */
  s = scene_of(3, 100);
  s.species[0].fraction = 0.506, s.species[1].fraction = 0.247, s.species[2].fraction = 0.247;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
  assert_true(m.n_of[0] == 50 && m.n_of[1] == 25 && m.n_of[2] == 25);
  for (int n = 2; n <= GG_MAX_SPECIES; n++)
    for (int64_t grains = 2 * n; grains < 200; grains++) {
      s = scene_of(n, grains);
      int64_t sum = 0;
      assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
      for (int i = 0; i < n; i++) sum += m.n_of[i];
      assert_int_equal(sum, grains);
    }
  s = scene_of(3, 1000);
  s.species[0].fraction = 0.999, s.species[1].fraction = s.species[2].fraction = 0.0005;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "the fraction 0.0005 of species 2 is 1 of 1000 grains; each species needs two"));
}

/* A species cut into several of the same grains is the same mixture: contact values, rates, volume. */
static void cut_species_are_one(void **state)
{
  (void)state;
  gg_scene two = scene_of(2, 1200), many = scene_of(GG_MAX_SPECIES, 1200);
  two.species[1].diameter = 0.6, two.species[1].mass = 3;
  two.species[0].fraction = 0.25, two.species[1].fraction = 0.75;
  many.species[0].fraction = 0.25;
  for (int i = 1; i < GG_MAX_SPECIES; i++) {
    many.species[i] = two.species[1];
    many.species[i].fraction = 0.05;
  }
  gg_model a, b;
  assert_int_equal(gg_scene_model_make(&two, GG_MD, &a, NULL), GG_OK);
  assert_int_equal(gg_scene_model_make(&many, GG_MD, &b, NULL), GG_OK);
  assert_true(fabs(a.volume - b.volume) < 1e-12 * a.volume);
  for (int i = 0; i < GG_MAX_SPECIES; i++)
    for (int j = 0; j <= i; j++) {
      int q = gg_pair(i > 0, j > 0), o = gg_pair(i, j);
      assert_true(fabs(a.chi[q] - b.chi[o]) < 1e-13 * a.chi[q] && a.sigma[q] == b.sigma[o]);
      assert_true(a.contact[i > 0][j > 0].jn == b.contact[i][j].jn);
    }
  double rate = gg_common_model_collision_rate(&a, 2);
  assert_true(fabs(rate - gg_common_model_collision_rate(&b, 2)) < 1e-12 * rate);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(pairs_are_numbered), cmocka_unit_test(pairs_have_names),
                                     cmocka_unit_test(grains_are_dealt), cmocka_unit_test(cut_species_are_one)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
