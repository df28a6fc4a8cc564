/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as people read them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include <graingas.h>

static void assert_estimate(double mean, double error, const char *expected)
{
  char text[64];
  gg_format_estimate(mean, error, text, sizeof text);
  assert_string_equal(text, expected);
}

/* The error is two digits, in units of the last digits of the mean. */
static void errors_stand_in_the_last_digits_of_means(void **state)
{
  (void)state;
  assert_estimate(1.23404, 0.0041, "1.2340(41)");
  assert_estimate(-0.15511, 0.00075, "-0.15511(75)");
  assert_estimate(123.44, 1.24, "123.4(1.2)");
  assert_estimate(12345.4, 66.7, "12345(67)");
  assert_estimate(12345.4, 666.7, "12345(667)");
  assert_estimate(0.5, 0.0996, "0.50(10)");
  assert_estimate(0.5, 0.0994, "0.500(99)");
  assert_estimate(5.123e-7, 2.1e-9, "5.123(21)e-07");
  assert_estimate(1.5e9, 2.0e7, "1.500(20)e+09");
  assert_estimate(0, 0.0012, "0.0000(12)");
  assert_estimate(0.1, 0.3, "0.10(30)");
  assert_estimate(2.5, 0, "2.5");
  assert_estimate(2.5, NAN, "2.5(?)");
  assert_estimate(2.5, 0, "2.5");
  assert_estimate(0.50000000000005, 2.3e-13, "0.5");
  assert_estimate(NAN, NAN, "-");
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(errors_stand_in_the_last_digits_of_means)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
