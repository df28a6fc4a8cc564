/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts and durations as people read them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "cli/print.h"

static void large_counts_have_prefixes(void **state)
{
  (void)state;
  char text[32];
  gg_cli_format_count(0, text, sizeof text);
  assert_string_equal(text, "0");
  gg_cli_format_count(1234567, text, sizeof text);
  assert_string_equal(text, "1.23 M");
  gg_cli_format_count(999600, text, sizeof text);
  assert_string_equal(text, "1 M");
  gg_cli_format_duration(3.14, text, sizeof text);
  assert_string_equal(text, "3.1 s");
  gg_cli_format_duration(0.0449, text, sizeof text);
  assert_string_equal(text, "45 ms");
  gg_cli_format_duration(59.7, text, sizeof text);
  assert_string_equal(text, "1:00 min");
  gg_cli_format_duration(3725, text, sizeof text);
  assert_string_equal(text, "1:02:05 h");
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(large_counts_have_prefixes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
