/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A theory of a user's program answers beside ours. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "extended.h"
#include "files/result_document.h"
#include "graingas.h"

static const char *pressure_of_enskog(void *context, const gg_facts *f, double *values)
{
  int *asked = context;
  ++*asked;
  if (strcmp(f->flow, "equilibrium") != 0) return "describes equilibrium";
  values[0] = f->stress_unit * f->density * f->temperature * (1 + 4 * f->phi * f->pairs[0].contact_value);
  values[2] = 7;
  return NULL;
}

static void test_theory(void **state)
{
  (void)state;
  int asked = 0;
  gg_error err;
  const char *const quantities[] = {"pressure", "cooling_rate", "my_temperature"};
  const gg_theory_definition mine = {"mine", NULL, "a note of 2026", NULL, 3, quantities, pressure_of_enskog, &asked};
  const char yaml[] = "{flow: equilibrium, phi: 0.1, particles: 400, run: {collisions: 60, warmup: 20}}";
  gg_scene *scene = scene_of(yaml);
  refused(gg_scene_add_theory(scene, &mine, &err), &err, "my_temperature"); /* not yet */
  add(scene, &thermometer);
  assert_int_equal(gg_scene_add_theory(scene, &mine, &err), GG_OK);
  refused(gg_scene_add_theory(scene, &mine, &err), &err, "taken");
  gg_theory_definition bad = mine;
  bad.name = "enskog";
  refused(gg_scene_add_theory(scene, &bad, &err), &err, "taken");
  bad.name = "other", bad.evaluate = NULL;
  refused(gg_scene_add_theory(scene, &bad, &err), &err, "evaluate");
  refused(gg_scene_add_theory(scene, NULL, &err), &err, "definition");

  gg_comparison c;
  if (gg_run_compare_scene(scene, NULL, 2, NULL, &c, &err) != GG_OK) fail_msg("%s", err.message);
  gg_scene_free(scene);
  assert_int_equal(asked, 1);
  json_t *document = gg_files_comparison_document(&c), *theory = json_object_get(document, "theory");
  double own = json_number_value(json_object_get(json_object_get(json_object_get(theory, "mine"), "pressure"), "mean"));
  double ours =
      json_number_value(json_object_get(json_object_get(json_object_get(theory, "enskog"), "pressure"), "mean"));
  assert_true(fabs(own / ours - 1) < 1e-12);
  assert_null(json_object_get(json_object_get(theory, "mine"), "cooling_rate"));
  json_t *row, *found = NULL;
  size_t i;
  json_array_foreach(json_object_get(document, "comparison"), i, row)
  {
    const char *quantity = json_string_value(json_object_get(row, "quantity"));
    if (strcmp(quantity, "my_temperature") == 0) found = row;
    if (strcmp(quantity, "pressure") == 0)
      assert_true(json_is_real(json_object_get(json_object_get(row, "md_theory_deviation"), "mine")));
  }
  assert_non_null(found);
  assert_true(json_is_real(json_object_get(json_object_get(found, "md_theory_deviation"), "mine")));
  json_decref(document);
  gg_run_comparison_clear(&c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_theory),
  };
  return cmocka_run_group_tests_name("own_theory", tests, NULL, NULL);
}
