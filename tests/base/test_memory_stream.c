/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: a text in memory is what was written, of any length; if any allocation on its way fails, it is not there, and
 * closing says so. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "../faults/failing_malloc.h"
#include "base/memory.h"
#include "base/text.h"

enum { PIECES = 3000, LENGTH = 12 }; /* of a piece */

static bool write_all(char **text)
{
  FILE *out = gg_base_memory_stream_open(text);
  for (int i = 0; out && i < PIECES; i++) fprintf(out, "%.4e,\n", 1 + i / 7.0);
  return gg_base_memory_stream_close(out, text);
}

static void a_stream_holds_all_that_was_written(void **state)
{
  (void)state;
  char *text;
  assert_true(write_all(&text));
  assert_int_equal(strlen(text), PIECES * LENGTH);
  assert_string_equal(text + (PIECES - 1) * LENGTH, "4.2943e+02,\n");
  free(text);
  assert_true(gg_base_memory_stream_close(gg_base_memory_stream_open(&text), &text));
  assert_string_equal(text, "");
  free(text);
}

static void length_by_now(void **state)
{
  (void)state;
  char *text;
  FILE *out = gg_base_memory_stream_open(&text);
  for (long i = 0; i < PIECES; i++) {
    assert_int_equal(ftell(out), i * LENGTH);
    fprintf(out, "%.*s", LENGTH, "123456789 123456789");
  }
  assert_true(fseek(out, 3, SEEK_SET) != 0);
  assert_true(gg_base_memory_stream_close(out, &text));
  assert_int_equal(strlen(text), PIECES * LENGTH);
  free(text);
}

static void allocations_that_fail(void **state)
{
  (void)state;
  char *expected, *text;
  uint64_t faults = 1;
  assert_true(write_all(&expected));
  for (uint64_t k = 1; faults; k++) {
    const unsigned before = gg_base_memory_failures();
    failing_malloc_arm(k, 0, NULL);
    const bool done = write_all(&text);
    failing_malloc_disarm(&faults);
    assert_int_equal(gg_base_memory_failures() != before, !done);
    if (!faults) assert_true(done && k > 6); /* the last of them: none failed */
    if (done)
      assert_string_equal(text, expected);
    else
      assert_null(text);
    free(text);
  }
  free(expected);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_stream_holds_all_that_was_written),
      cmocka_unit_test(length_by_now),
      cmocka_unit_test(allocations_that_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
