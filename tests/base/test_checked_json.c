/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON is whole or not there, whichever allocation fails. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../faults/failing_malloc.h"
#include "io/checked_json.h"

static const char text[] =
    "{\"verdict\": \"too short to tell: averaged over 40 collisions a grain, the slowest mode needs 300\", "
    "\"a key that is longer than the first room of a text\": [1, 2.5, null, true, \"carnahan_starling\"]}";

/* jansson lost letters so ("averaged ovr"), and called the document read. */
static void a_document_is_read_whole_or_refused_without_memory(void **state)
{
  (void)state;
  json_t *whole = gg_io_json_read(text, NULL);
  uint64_t faults = 1;
  size_t lost = 0;
  assert_non_null(whole);
  for (uint64_t at = 1; faults; at++) {
    const char *why = NULL;
    const unsigned before = gg_base_memory_failures();
    failing_malloc_arm(at, 0, NULL);
    json_t *document = gg_io_json_read(text, &why);
    failing_malloc_disarm(&faults);
    assert_int_equal(gg_base_memory_failures() != before, document == NULL);
    assert_true(document ? json_equal(document, whole) : strcmp(why, "out of memory") == 0);
    lost += !document;
    json_decref(document);
  }
  assert_true(lost > 10);
  json_decref(whole);
}

static void a_document_is_written_whole_or_refused_without_memory(void **state)
{
  (void)state;
  json_t *whole = gg_io_json_read(text, NULL);
  uint64_t faults = 1;
  for (uint64_t at = 1; faults; at++) {
    const unsigned before = gg_base_memory_failures();
    failing_malloc_arm(at, 0, NULL);
    char *written = gg_io_json_text(whole, 0);
    failing_malloc_disarm(&faults);
    assert_int_equal(gg_base_memory_failures() != before, written == NULL);
    json_t *again = written ? gg_io_json_read(written, NULL) : NULL;
    assert_true(!written || json_equal(again, whole));
    json_decref(again);
    free(written);
  }
  json_decref(whole);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_document_is_read_whole_or_refused_without_memory),
                                     cmocka_unit_test(a_document_is_written_whole_or_refused_without_memory)};
  cmocka_set_message_output(CM_OUTPUT_TAP);
  return cmocka_run_group_tests(tests, NULL, NULL);
}
