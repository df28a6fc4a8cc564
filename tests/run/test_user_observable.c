/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observables of a user's program are measured as ours are; whatever is wrong with a definition is refused. */
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
#include "scene/scene.h"

static void same_estimate(const gg_result *r, const char *name, gg_quantity q, double tolerance)
{
  const gg_estimate *mine = &r->value[gg_common_quantity_find_in(&r->model, name)], *ours = &r->value[q];
  if (!(fabs(mine->mean / ours->mean - 1) < tolerance && fabs(mine->error / ours->error - 1) < 1e-2))
    fail_msg("%s = %.12g +- %g, ours %.12g +- %g", name, mine->mean, mine->error, ours->mean, ours->error);
  assert_int_equal(mine->samples, ours->samples);
}

/* A user-defined quantity with the definition of a built-in one has the same mean and error, in both engines, smooth
 * and rough. */
static void test_observable(void **state)
{
  (void)state;
  const char *const scenes[] = {sheared, sheared_dsmc,
                                "{flow: usf, phi: 0.1, particles: 400, collision: {beta: 0}, run: {collisions: 100, "
                                "warmup: 20, replicas: 2}}"};
  for (int k = 0; k < 3; k++) {
    gg_scene *scene = scene_of(scenes[k]);
    add(scene, &thermometer);
    add(scene, &counter);
    gg_result *r = run(scene, 2);
    gg_scene_free(scene); /* a result keeps the names */
    same_estimate(r, "my_temperature", GG_Q_TEMPERATURE, 1e-9);
    same_estimate(r, "my_rate", GG_Q_COLLISION_RATE, 1e-9);
    const gg_estimate *stress = &r->value[gg_common_quantity_find_in(&r->model, "my_stress")];
    assert_true(fabs(stress->mean / -r->value[GG_Q_P_XY_COLLISIONAL].mean - 1) < 1e-9);
    assert_true(r->value[gg_common_quantity_find_in(&r->model, "my_samples")].mean > 20);
    json_t *document = gg_files_run_document(r),
           *mine = json_object_get(json_object_get(document, "results"), "my_temperature");
    assert_string_equal(json_string_value(json_object_get(mine, "unit")), "d^2 gamma^2");
    assert_true(json_is_real(json_object_get(mine, "stderr")));
    json_decref(document);
    double mean;
    assert_int_equal(gg_result_get(r, "my_rate", &mean, NULL, NULL), GG_OK);
    assert_string_equal(gg_result_unit(r, "my_samples"), "1");
    gg_result_free(r);
  }
}

/* An observable changes nothing of the run in md, even one that is shown every collision. */
static void test_observer_leaves_no_trace(void **state)
{
  (void)state;
  gg_scene *scene = scene_of(sheared), *counted = scene_of(sheared);
  add(counted, &counter);
  gg_result *r = run(scene, 1), *w = run(counted, 1);
  assert_true(r->value[GG_Q_PRESSURE].mean == w->value[GG_Q_PRESSURE].mean);
  gg_result_free(r), gg_result_free(w);
  gg_scene_free(scene), gg_scene_free(counted);
}

static void sample_nan(void *context, void *state, const gg_sample *s, double *values)
{
  (void)context, (void)state, (void)s, (void)values; /* as it is preset */
}

static void test_no_number(void **state)
{
  (void)state;
  const gg_quantity_definition q = {"nothing", NULL, NULL};
  const gg_observable_definition o = {"silent", NULL, 1, &q, 0, sample_nan, NULL, NULL};
  gg_scene *scene = scene_of(sheared);
  add(scene, &o);
  gg_result *r = run(scene, 1);
  gg_error err;
  assert_int_equal(gg_result_get(r, "nothing", NULL, NULL, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "NaN or infinite"));
  gg_result_free(r);
  gg_scene_free(scene);
}

static void test_bad_observables(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *scene = scene_of(sheared);
  const struct {
    const char *name, *quantity, *word;
    int n;
  } cases[] = {{NULL, "x", "missing", 1},          {"two words", "x", "not a valid name", 1},
               {"o", "1x", "not a valid name", 1}, {"o", NULL, "missing", 1},
               {"o", "temperature", "taken", 1},   {"o", "x", "at least one", 0},
               {"thermometer", "x", "taken", 1},   {"o", "my_temperature", "taken", 1}};
  add(scene, &thermometer);
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    const gg_quantity_definition q = {cases[k].quantity, NULL, NULL};
    const gg_observable_definition o = {cases[k].name, NULL, cases[k].n, &q, 0, sample_nan, NULL, NULL};
    refused(gg_scene_add_observable(scene, &o, &err), &err, cases[k].word);
  }
  gg_observable_definition o = thermometer;
  o.name = "o", o.quantities = counter.quantities, o.n_quantities = 1, o.sample = NULL;
  refused(gg_scene_add_observable(scene, &o, &err), &err, "sample");
  refused(gg_scene_add_observable(scene, NULL, &err), &err, "definition");
  refused(gg_scene_add_observable(NULL, &counter, &err), &err, "scene");
  gg_quantity_definition many[40] = {{0}};
  o.sample = sample_nan, o.quantities = many, o.n_quantities = 40;
  refused(gg_scene_add_observable(scene, &o, &err), &err, "at most");
  gg_quantity_definition lines = {"x", "two\nlines", NULL};
  o.quantities = &lines, o.n_quantities = 1;
  refused(gg_scene_add_observable(scene, &o, &err), &err, "one line");
  assert_int_equal(gg_common_extension_quantities(scene->extension), 3); /* as it was */
  gg_scene_free(scene);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_observable),
      cmocka_unit_test(test_observer_leaves_no_trace),
      cmocka_unit_test(test_no_number),
      cmocka_unit_test(test_bad_observables),
  };
  return cmocka_run_group_tests_name("own_observable", tests, NULL, NULL);
}
