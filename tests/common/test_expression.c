/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formulas: values beside those of C, precedence, conditions and their steps, and errors with the character. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "common/expression.h"

static const char *const names[] = {"v", "e", NULL};

static double value(const char *text, double v, double e)
{
  gg_expression x;
  gg_error err = {0};
  if (gg_common_expression_parse(&x, text, names, &err) != GG_OK) fail_msg("%s", err.message);
  return gg_common_expression_value(&x, (const double[]){v, e});
}

static void formulas_have_the_values_of_c(void **state)
{
  (void)state;
  const double v = 1.7, e = 0.8;
  const struct {
    const char *text;
    double is;
  } cases[] = {
      {"1 - 0.2*v^0.2", 1 - 0.2 * pow(v, 0.2)},
      {"-v^2 + 2^3^2/(e - 1)", -v * v + 512 / (e - 1)},
      {"atan(v)*tanh(e) - erf(v/2)", atan(v) * tanh(e) - erf(v / 2)},
      {"min(v, e) + 10*max(v, e)", e + 10 * v},
      {"max(min(v, 1), exp(-e))", 1},
      {"v < 2", 1},
      {"v >= 2", 0},
      {"(e <= 0.8) + (e == 0.8)*2 + (v > v)*4", 3},
      {"1 + 1 < 3*1", 1},
      {"0.9 if v < 2 else 0.6", 0.9},
      {"0.9 if v<1 else 0.7 if v<1.5 else 0.6", 0.6},
      {"0.9 if v<1 else 0.7 if v<1.8 else 0.6", 0.7},
      {"1 + (2 if e > 1 else 3)*v", 1 + 3 * v},
      {"sqrt(2 if v else 8)", sqrt(2)},
      {"0.5 if v > 0 else ln(-1)", 0.5},
      {"2 if inf > v else 3", 2},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const double x = value(cases[i].text, v, e);
    if (!(fabs(x - cases[i].is) <= 1e-15 * fmax(1, fabs(cases[i].is))))
      fail_msg("%s is %.17g, not %.17g", cases[i].text, x, cases[i].is);
  }
  assert_true(isnan(value("1 if ln(-v) else 2", v, e)));
}

static void words_of_formulas_are_known(void **state)
{
  (void)state;
  const char *const known[] = {"pi", "inf", "if", "else", "ln", "atan", "min", "erf"};
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) assert_true(gg_common_expression_knows(known[k]));
  const char *const unknown[] = {"", "p", "pie", "v", "log", "Ln"};
  for (size_t k = 0; k < sizeof unknown / sizeof *unknown; k++) assert_false(gg_common_expression_knows(unknown[k]));
}

/* The step of a comparison is between two neighbouring numbers, on the side that the sign says. */
static void a_step_is_between_two_neighbouring_numbers(void **state)
{
  (void)state;
  assert_true(value("1 if v < 2 else 0", nextafter(2, 0), 0) == 1 && value("1 if v < 2 else 0", 2, 0) == 0);
  assert_true(value("1 if v <= 2 else 0", 2, 0) == 1 && value("1 if v <= 2 else 0", nextafter(2, 3), 0) == 0);
}

static void errors_name_the_character(void **state)
{
  (void)state;
  static const char *const cases[][2] = {
      {"1 if v < 2", "character 11: else is missing"},
      {"1 if", "character 5: a number, a name or ("},
      {"min(v)", "character 6: a comma and a second argument"},
      {"max(v, e", "character 9: ) is missing"},
      {"1 else 2", "character 3: not expected"},
      {"v < e < 2", "character 7: not expected"},
      {"v = 2", "character 3: not expected"},
      {"2 iff v else 3", "character 3: not expected"},
      {"tan(v)", "character 1: not known; there are v, e, pi, inf, ln"},
      {"tanh v", "character 6: ( is missing"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    gg_expression x;
    gg_error err = {0};
    assert_int_equal(gg_common_expression_parse(&x, cases[i][0], names, &err), GG_BAD_INPUT);
    if (!strstr(err.message, cases[i][1])) fail_msg("%s: %s", cases[i][0], err.message);
  }
}

/* Conditions inside conditions without end are refused, not run into the ground. */
static void depth_is_bounded(void **state)
{
  (void)state;
  char text[2000] = "";
  gg_expression x;
  gg_error err = {0};
  for (int i = 0; i < 100; i++) strcat(text, "1 if v else ");
  strcat(text, "0");
  assert_int_equal(gg_common_expression_parse(&x, text, names, &err), GG_BAD_INPUT);
  memset(text, '(', 1000), text[1000] = 0;
  assert_int_equal(gg_common_expression_parse(&x, text, names, &err), GG_BAD_INPUT);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(formulas_have_the_values_of_c),
      cmocka_unit_test(words_of_formulas_are_known),
      cmocka_unit_test(a_step_is_between_two_neighbouring_numbers),
      cmocka_unit_test(errors_name_the_character),
      cmocka_unit_test(depth_is_bounded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
