/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories by name: the named ones are evaluated, and no other, with the numbers that they have among all. */
#include "../api/api_test.h"

#include "theory/theory.h"

/* The linker sends every evaluation through here (meson.build). */
static int evaluations, curve_evaluations;
gg_status __real_gg_theory_evaluate(const gg_theory *, const gg_model *, gg_theory_answer *, gg_error *);
gg_status __wrap_gg_theory_evaluate(const gg_theory *, const gg_model *, gg_theory_answer *, gg_error *);
gg_status __wrap_gg_theory_evaluate(const gg_theory *theory, const gg_model *model, gg_theory_answer *answer,
                                    gg_error *err)
{
  evaluations++;
  return __real_gg_theory_evaluate(theory, model, answer, err);
}
gg_status __real_gg_theory_curves(const gg_theory *, const gg_model *, unsigned, gg_curves *, gg_error *);
gg_status __wrap_gg_theory_curves(const gg_theory *, const gg_model *, unsigned, gg_curves *, gg_error *);
gg_status __wrap_gg_theory_curves(const gg_theory *theory, const gg_model *model, unsigned measure, gg_curves *list,
                                  gg_error *err)
{
  curve_evaluations++;
  return __real_gg_theory_curves(theory, model, measure, list, err);
}

/* Do all values of a theory agree between two comparisons, to the last bit? */
static int same_values(const gg_comparison *one, const gg_comparison *all, const char *theory)
{
  gg_error err;
  gg_comparison_row row;
  int n = 0;
  for (size_t i = 0; gg_comparison_at(all, i, &row, NULL) == GG_OK; i++) {
    double a, b;
    assert_ok(gg_comparison_theory_value(one, theory, row.name, &a, NULL, &err));
    assert_ok(gg_comparison_theory_value(all, theory, row.name, &b, NULL, &err));
    assert_true(a == b || (isnan(a) && isnan(b)));
    n += !isnan(a);
  }
  return n;
}

static const char *answer_42(void *context, const gg_facts *facts, double *values)
{
  ++*(int *)context;
  values[0] = 42 * facts->temperature;
  return NULL;
}

static void by_name(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1, collision: {e: 0.9}, measure: [velocity_distributions]}");
  int calls[2] = {0, 0};
  const char *const answers[] = {"temperature"};
  for (int k = 0; k < 2; k++) {
    const gg_theory_definition user = {.name = k ? "second" : "first",
                                       .n_quantities = 1,
                                       .quantities = answers,
                                       .evaluate = answer_42,
                                       .context = &calls[k]};
    assert_ok(gg_scene_add_theory(s, &user, &err));
  }
  gg_comparison *all = NULL, *c = NULL;
  gg_theory_info info;
  assert_ok(gg_theories_evaluate(s, NULL, NULL, NULL, &all, &err));
  assert_true(evaluations > 10 && calls[0] == 1 && calls[1] == 1);

  const struct {
    const char *names;
    int n, first, second;
    const char *theory[3];
  } tries[] = {{"lun1991", 1, 0, 0, {"lun1991"}}, {"gaussian_closure", 1, 0, 0, {"gaussian_closure"}},
               {"second", 1, 0, 1, {"second"}},   {"second, lun1991,grad", 3, 0, 1, {"lun1991", "grad", "second"}},
               {"grad,grad", 1, 0, 0, {"grad"}},  {"haff1983", 1, 0, 0, {"haff1983"}}}; /* haff1983 does not apply */
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    evaluations = curve_evaluations = calls[0] = calls[1] = 0;
    assert_ok(gg_theories_evaluate(s, tries[k].names, NULL, NULL, &c, &err));
    assert_int_equal(evaluations, tries[k].n + tries[k].second); /* facts of the start need a temperature */
    assert_true(calls[0] == tries[k].first && calls[1] == tries[k].second);
    int apply = 0;
    for (int i = 0; i < tries[k].n; i++) {
      assert_ok(gg_comparison_theory(c, (size_t)i, &info, &err));
      assert_string_equal(info.name, tries[k].theory[i]);
      assert_true((same_values(c, all, info.name) > 0) == (info.reason == NULL));
      apply += info.reason == NULL;
    }
    assert_int_equal(curve_evaluations, apply);
    assert_int_equal(gg_comparison_theory(c, (size_t)tries[k].n, &info, &err), GG_BAD_INPUT);
    gg_comparison_free(c);
  }
  evaluations = 0;
  assert_refused(gg_theories_evaluate(s, "lun1992", NULL, NULL, &c, &err), "'lun1992'; did you mean 'lun1991'?");
  assert_refused(gg_theories_evaluate(s, "lun1991,", NULL, NULL, &c, &err), "there is no theory called ''");
  assert_int_equal(evaluations, 0);
  gg_comparison_free(all);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(by_name)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
