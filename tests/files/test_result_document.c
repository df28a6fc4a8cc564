/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON documents: the keys that scripts rely on, numbers to the last bit, null with a reason where there is none.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "files/result_document.h"
#include "graingas.h"
#include "planted.h"

static const char *warning_with(const json_t *document, const char *words)
{
  size_t i;
  json_t *warning;
  json_array_foreach(json_object_get(document, "warnings"), i,
                     warning) if (strstr(json_string_value(warning), words)) return json_string_value(warning);
  return NULL;
}

/* Through the text and back. */
static json_t *reread(json_t *document)
{
  char *text = gg_files_document_text(document);
  assert_null(strstr(text, "NaN"));
  json_t *again = json_loads(text, 0, NULL);
  assert_non_null(again);
  assert_true(json_equal(document, again));
  free(text);
  json_decref(document);
  return again;
}

static void a_document_of_a_run_has_its_numbers(void **state)
{
  (void)state;
  gg_result *r = planted_result(GG_MD);
  json_t *d = reread(gg_files_run_document(r));
  assert_string_equal(json_string_value(json_object_get(d, "graingas")), gg_version());
  assert_string_equal(json_string_value(json_object_get(d, "engine")), "md");
  assert_true(json_is_true(json_object_get(d, "steady")));
  assert_int_equal(json_integer_value(json_object_get(d, "collisions")), 12000000);
  assert_true(json_number_value(json_object_get(d, "cpu_seconds")) == 7.9);
  json_t *total = json_object_get(d, "total");
  assert_int_equal(json_integer_value(json_object_get(total, "collisions")), 13000000);
  assert_true(json_number_value(json_object_get(total, "wall_seconds")) == 9.1);
  json_t *T = json_object_get(json_object_get(d, "results"), "temperature");
  assert_true(json_number_value(json_object_get(T, "mean")) == 1.0 / 3);
  assert_true(json_number_value(json_object_get(T, "stderr")) == 0.001);
  assert_true(json_number_value(json_object_get(T, "correlation_time")) == 1.7);
  assert_int_equal(json_integer_value(json_object_get(T, "samples")), 400);
  assert_string_equal(json_string_value(json_object_get(T, "unit")), "d^2 gamma^2");
  assert_true(json_number_value(json_object_get(json_object_get(d, "scene"), "phi")) == 0.3);
  json_t *e = json_object_get(json_object_get(json_object_get(d, "scene"), "collision"), "e");
  assert_true(json_number_value(e) == 0.9);
  assert_null(json_object_get(json_object_get(d, "results"), "spin_z")); /* not measured: not there */
  json_decref(d);
  gg_result_free(r);
}

static void nulls_have_reasons(void **state)
{
  (void)state;
  gg_result *r = planted_result(GG_MD);
  json_t *d = reread(gg_files_run_document(r));
  json_t *a2 = json_object_get(json_object_get(d, "results"), "a2");
  assert_true(json_is_null(json_object_get(a2, "mean")));
  assert_non_null(warning_with(d, "planted warning"));
  assert_non_null(warning_with(d, "knudsen, a2 are null: there is no box"));
  assert_int_equal(json_array_size(json_object_get(d, "warnings")), 2);
  json_decref(d);
  gg_result_free(r);
}

static void a_document_of_a_comparison_has_both_engines(void **state)
{
  (void)state;
  gg_comparison *c = planted_comparison();
  json_t *d = reread(gg_files_comparison_document(c)), *row, *T = NULL, *N2 = NULL;
  assert_string_equal(json_string_value(json_object_get(json_object_get(d, "dsmc"), "engine")), "dsmc");
  json_t *lun = json_object_get(json_object_get(d, "theory"), "lun1991");
  double theory = json_number_value(json_object_get(json_object_get(lun, "temperature"), "mean"));
  assert_true(theory > 0);
  size_t i;
  json_array_foreach(json_object_get(d, "comparison"), i, row)
  {
    const char *name = json_string_value(json_object_get(row, "quantity"));
    if (strcmp(name, "temperature") == 0) T = row;
    if (strcmp(name, "N2") == 0) N2 = row;
  }
  double z = json_number_value(json_object_get(T, "md_dsmc_z"));
  assert_true(fabs(z - 0.01 / (0.001 * sqrt(2))) < 1e-9);
  double off = json_number_value(json_object_get(json_object_get(T, "md_theory_deviation"), "lun1991"));
  assert_true(fabs(off - (theory * 3 - 1)) < 1e-12);
  /* A mean that is not distinguishable from zero has no relative deviation. */
  assert_true(json_is_null(json_object_get(json_object_get(N2, "md_theory_deviation"), "lun1991")));
  assert_non_null(warning_with(d, "N2 is null: the relative deviation"));
  assert_non_null(warning_with(d, "does not apply"));
  json_decref(d);
  planted_comparison_free(c);
}

static void missing_engine(void **state)
{
  (void)state;
  gg_comparison *c = planted_comparison();
  gg_result_free(c->by_engine[GG_MD]);
  c->by_engine[GG_MD] = NULL;
  strcpy(c->refusal[GG_MD], "phi = 0 is not for md");
  json_t *d = reread(gg_files_comparison_document(c));
  assert_true(json_is_null(json_object_get(d, "md")));
  assert_non_null(warning_with(d, "md is null: phi = 0 is not for md"));
  json_decref(d);
  planted_comparison_free(c);
}

static void a_document_of_theories_has_their_answers(void **state)
{
  (void)state;
  gg_comparison *c = planted_comparison();
  json_t *d = reread(gg_files_theory_document(c->scene, c));
  json_t *lun = json_object_get(json_object_get(d, "theory"), "lun1991");
  assert_string_equal(json_string_value(json_object_get(json_object_get(lun, "pressure"), "unit")),
                      "rho_p d^2 gamma^2");
  assert_non_null(json_object_get(d, "scene"));
  json_decref(d);
  planted_comparison_free(c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_document_of_a_run_has_its_numbers),         cmocka_unit_test(nulls_have_reasons),
      cmocka_unit_test(a_document_of_a_comparison_has_both_engines), cmocka_unit_test(missing_engine),
      cmocka_unit_test(a_document_of_theories_has_their_answers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
