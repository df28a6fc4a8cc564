/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes and tables as the public interface has them. */
#include "api_test.h"

static const char *get(const gg_scene *s, const char *key)
{
  static char text[200];
  gg_error err;
  assert_ok(gg_scene_get(s, key, text, sizeof text, &err));
  return text;
}

/* A key that was set returns its value; values that follow other keys do so until they are given. */
static void set_and_get(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.3, species: [{fraction: 0.25}, {fraction: 0.75, mass: 4}]}"), *copy = NULL;
  assert_string_equal(get(s, "collision.e"), "0.9");
  assert_ok(gg_scene_set(s, "flow", "equilibrium", &err));
  assert_string_equal(get(s, "collision.e"), "1");
  assert_ok(gg_scene_set(s, "flow", "hcs", &err));
  assert_string_equal(get(s, "collision.e"), "0.9");
  assert_ok(gg_scene_set(s, "collision.e.12", "0.7", &err));
  assert_string_equal(get(s, "collision.e"), "{11: 0.9, 12: 0.7, 22: 0.9}");
  assert_string_equal(get(s, "collision.e.12"), "0.7");
  assert_string_equal(get(s, "species.2.mass"), "4");
  assert_ok(gg_scene_copy(s, &copy, &err));
  assert_ok(gg_scene_set(copy, "gravity", "[0.5, 0, -1]", &err));
  assert_string_equal(get(copy, "gravity"), "[0.5, 0, -1]");
  assert_string_equal(get(s, "gravity"), "[0, 0, 0]");
  char few[4];
  assert_ok(gg_scene_get(s, "collision.e", few, sizeof few, &err));
  assert_string_equal(few, "{11");
  assert_refused(gg_scene_get(s, "collision.E", few, sizeof few, &err), "no key 'collision.E'");
  assert_refused(gg_scene_get(s, "species.3.mass", few, sizeof few, &err), "no key");
  assert_refused(gg_scene_set(s, "phi", "2", &err), "allowed: a number from 0 to 0.6");
  gg_scene_free(copy);
  gg_scene_free(s);
}

/* A scene may be incomplete until it is used, and then says what is missing. */
static void used_incomplete(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{phi: 0.1}");
  gg_result *r = NULL;
  gg_simulation *m = NULL;
  gg_comparison *c = NULL;
  assert_refused(gg_scene_check(s, &err), "flow is missing");
  assert_refused(gg_run(s, NULL, &r, &err), "flow is missing");
  assert_refused(gg_simulation_new(s, NULL, &m, &err), "flow is missing");
  assert_refused(gg_compare(s, NULL, &c, &err), "flow is missing");
  assert_refused(gg_theories_evaluate(s, NULL, NULL, NULL, &c, &err), "flow is missing");
  assert_ok(gg_scene_set(s, "flow", "chute", &err));
  assert_ok(gg_scene_check(s, &err));
  assert_ok(gg_scene_set(s, "gravity", "[0, 0, 0]", &err));
  assert_refused(gg_scene_check(s, &err), "needs gravity");
  gg_scene_free(s);
}

/* Written as YAML or as JSON, a scene is read again as the same. */
static void to_text_and_back(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: hss, phi: 0.123456789012345678, collision: {e: {11: 0.3, 12: 0.7, 22: 0.8}}}");
  char *yaml = NULL, *json = NULL, *again = NULL, title[80];
  assert_ok(gg_scene_to_yaml(s, &yaml, &err));
  assert_ok(gg_scene_to_json(s, &json, &err));
  const char *const texts[] = {yaml, json};
  for (int k = 0; k < 2; k++) {
    gg_scene *back = scene_of(texts[k]);
    assert_ok(gg_scene_to_yaml(back, &again, &err));
    assert_string_equal(again, yaml);
    free(again);
    gg_scene_free(back);
  }
  assert_ok(gg_scene_title(s, title, sizeof title, &err));
  assert_non_null(strstr(title, "Homogeneous heating, phi 0.123457"));
  free(yaml);
  free(json);
  gg_scene_free(s);
}

static void count_line(void *context, const char *text)
{
  assert_true(strlen(text) > 0);
  ++*(int *)context;
}

static void a_scene_describes_how_it_will_run(void **state)
{
  (void)state;
  gg_error err;
  int lines = 0;
  gg_scene *s = scene_of("{flow: usf, phi: 0}");
  assert_ok(gg_scene_describe(s, "dsmc", count_line, &lines, &err));
  assert_true(lines > 2);
  gg_scene_needs needs;
  assert_ok(gg_scene_get_needs(s, "dsmc", &needs, &err));
  assert_true(needs.memory > 1e6 && needs.memory_available > needs.memory);
  assert_true(needs.collisions_per_grain > 100 && needs.cpu_seconds > 0 && needs.observables >= 0);
  assert_refused(gg_scene_get_needs(s, "md", &needs, &err), "phi");
  assert_refused(gg_scene_describe(s, "md", count_line, &lines, &err), "phi");
  assert_refused(gg_scene_describe(s, "spectral", count_line, &lines, &err), "there are md and dsmc");
  gg_scene_free(s);
}

/* The entry of that name. */
static gg_entry entry_of(gg_catalogue catalogue, const gg_scene *scene, const char *name)
{
  gg_entry e;
  for (size_t i = 0; gg_catalogue_entry(catalogue, i, scene, &e, NULL) == GG_OK; i++)
    if (strcmp(e.name, name) == 0) return e;
  fail_msg("no %s", name);
  return e;
}

/* Every table has the number of rows that it states, with all fields. */
static void tables_have_all_rows_and_fields(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0, collision: {e: 0.8}}");
  gg_entry e = entry_of(GG_CATALOGUE_KEYS, NULL, "collision.e");
  assert_string_equal(e.value, "0.9");
  assert_string_equal(e.type, "pairs");
  assert_true(!e.given && strstr(e.allowed, "a number from 0 to 1"));
  e = entry_of(GG_CATALOGUE_KEYS, s, "collision.e");
  assert_true(e.given && strcmp(e.value, "0.8") == 0);
  assert_string_equal(entry_of(GG_CATALOGUE_KEYS, NULL, "phi").value, "");
  assert_string_equal(entry_of(GG_CATALOGUE_KEYS, NULL, "run.time_limit").unit, "s");
  assert_string_equal(entry_of(GG_CATALOGUE_SPECIES_KEYS, NULL, "inertia").value, "0.4");
  assert_string_equal(entry_of(GG_CATALOGUE_QUANTITIES, NULL, "temperature").unit, "d^2 gamma^2");
  assert_string_equal(entry_of(GG_CATALOGUE_QUANTITIES, s, "temperature").unit, "(gamma/(n d^2))^2");
  assert_non_null(entry_of(GG_CATALOGUE_FLOWS, NULL, "usf").doc);
  assert_non_null(entry_of(GG_CATALOGUE_ENGINES, NULL, "dsmc").doc);
  assert_non_null(entry_of(GG_CATALOGUE_OBSERVABLES, NULL, "diffusion").doc);
  assert_non_null(strstr(entry_of(GG_CATALOGUE_THEORIES, NULL, "lun1991").citation, "Lun"));
  assert_ok(gg_catalogue_word("thermostat", 0, &e, &err));
  assert_string_equal(e.name, "none");
  assert_refused(gg_catalogue_word("phi", 0, &e, &err), "that takes words");
  assert_refused(gg_catalogue_entry(GG_CATALOGUE_FLOWS, 1000, NULL, &e, &err), "no more");
  assert_refused(gg_catalogue_entry((gg_catalogue)99, 0, NULL, &e, &err), "no such catalogue");
  gg_scene_free(s);
}

static void a_wrong_word_finds_the_nearest(void **state)
{
  (void)state;
  const char *const known[] = {"compare", "run", "theory", NULL};
  char text[40];
  assert_string_equal(gg_nearest_word("comapre", known), "compare");
  assert_null(gg_nearest_word("xyzzyplugh", known));
  gg_format_estimate(1.234, 0.0041, text, sizeof text);
  assert_string_equal(text, "1.2340(41)");
  gg_format_estimate(1.234, NAN, text, sizeof text);
  assert_string_equal(text, "1.23(?)");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(set_and_get),
      cmocka_unit_test(used_incomplete),
      cmocka_unit_test(to_text_and_back),
      cmocka_unit_test(a_scene_describes_how_it_will_run),
      cmocka_unit_test(tables_have_all_rows_and_fields),
      cmocka_unit_test(a_wrong_word_finds_the_nearest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
