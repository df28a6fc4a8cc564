/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Named arrays of a checkpoint: what is taken out must be what was put in, and whatever is not is refused by name. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "base/archive.h"

#define assert_bad(call, words)                                                                                        \
  do {                                                                                                                 \
    assert_int_not_equal(call, GG_OK);                                                                                 \
    if (!strstr(err.message, words)) fail_msg("'%s' lacks '%s'", err.message, words);                                  \
  } while (0)

static const double numbers[3] = {1, -2.5, 1e300};

static gg_archive archive_of_numbers(void)
{
  gg_archive a = {0};
  assert_int_equal(gg_base_archive_put(&a, "md/x", GG_ITEM_F64, numbers, 3, NULL), GG_OK);
  return a;
}

static void every_type_comes_back(void **state)
{
  (void)state;
  unsigned char bytes[8 * 3];
  for (size_t i = 0; i < sizeof bytes; i++) bytes[i] = (unsigned char)(200 + i);
  for (int type = 0; type < GG_ITEM_TYPES; type++) {
    unsigned char back[sizeof bytes] = {0};
    gg_archive a = {0};
    assert_int_equal(gg_base_archive_put(&a, "x", (gg_item_type)type, bytes, 3, NULL), GG_OK);
    assert_int_equal(gg_base_archive_put(&a, "empty", (gg_item_type)type, NULL, 0, NULL), GG_OK);
    assert_int_equal(gg_base_archive_get(&a, "x", (gg_item_type)type, back, 3, NULL), GG_OK);
    assert_int_equal(gg_base_archive_get(&a, "empty", (gg_item_type)type, NULL, 0, NULL), GG_OK);
    assert_memory_equal(back, bytes, 3 * gg_base_archive_item_size((gg_item_type)type));
    gg_base_archive_clear(&a);
  }
}

static void others_are_refused(void **state)
{
  (void)state;
  gg_error err;
  gg_archive a = archive_of_numbers();
  double back[4] = {7, 7, 7, 7};
  assert_bad(gg_base_archive_get(&a, "md/y", GG_ITEM_F64, back, 3, &err), "lacks 'md/y'");
  assert_bad(gg_base_archive_get(&a, "md/x", GG_ITEM_I64, back, 3, &err), "another type");
  assert_bad(gg_base_archive_get(&a, "md/x", GG_ITEM_F64, back, 4, &err), "holds 3 items where 4");
  for (int k = 0; k < 4; k++) assert_true(back[k] == 7);
  gg_base_archive_clear(&a);
}

static void nested_and_back(void **state)
{
  (void)state;
  gg_error err;
  gg_archive a = archive_of_numbers(), outer = {0}, inner = {0};
  double back[3];
  assert_int_equal(gg_base_archive_nest(&outer, "replica0", &a, NULL), GG_OK);
  assert_non_null(gg_base_archive_find(&outer, "replica0/md/x"));
  assert_int_equal(gg_base_archive_unnest(&inner, "replica1", &outer, NULL), GG_OK);
  assert_int_equal(inner.n_items, 0);
  assert_int_equal(gg_base_archive_unnest(&inner, "replica0", &outer, NULL), GG_OK);
  assert_int_equal(gg_base_archive_get(&inner, "md/x", GG_ITEM_F64, back, 3, NULL), GG_OK);
  assert_memory_equal(back, numbers, sizeof back);
  char prefix[sizeof a.items->name];
  memset(prefix, 'p', sizeof prefix - 1), prefix[sizeof prefix - 1] = 0;
  assert_bad(gg_base_archive_nest(&outer, prefix, &a, &err), "is too long");
  gg_base_archive_clear(&a), gg_base_archive_clear(&outer), gg_base_archive_clear(&inner);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_type_comes_back),
      cmocka_unit_test(others_are_refused),
      cmocka_unit_test(nested_and_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
