/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: a message that is too long keeps its beginning, which names a file, and its end, which is the reason; letters
 * stay whole. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdbool.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"

static void fill(char *name, size_t length, const char *letter)
{
  *name = '\0';
  while (strlen(name) + strlen(letter) <= length) strcat(name, letter);
}

static bool ends(const char *text, const char *with)
{
  const size_t n = strlen(text), m = strlen(with);
  return n >= m && strcmp(text + n - m, with) == 0;
}

/* No letter of a name made of one letter begins or ends in its middle. */
static bool is_whole(const char *message, const char *letter)
{
  const size_t n = strlen(letter);
  while (strncmp(message, letter, n) == 0) message += n;
  if (strncmp(message, " ... ", 5) != 0) return false;
  message += 5;
  while (strncmp(message, letter, n) == 0) message += n;
  return *message == ':';
}

static void long_names(void **state)
{
  (void)state;
  static const char *const letters[] = {"a", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x98\x80"};
  char name[4097];
  for (size_t k = 0; k < sizeof letters / sizeof *letters; k++)
    for (size_t length = 1010; length < 4096; length += 301) {
      gg_error err;
      fill(name, length, letters[k]);
      assert_int_equal(gg_base_fail(&err, GG_BAD_FILE, "%s: cannot be read: %s", name, "Is a directory"), GG_BAD_FILE);
      assert_true(ends(err.message, ": cannot be read: Is a directory") && is_whole(err.message, letters[k]));
      gg_base_fail(&err, GG_BAD_INPUT, "line 7: key 'phi': %s", "value '2' is not allowed");
      assert_int_equal(gg_base_error_prefix(&err, GG_BAD_INPUT, "%s", name), GG_BAD_INPUT);
      assert_true(ends(err.message, ": line 7: key 'phi': value '2' is not allowed") &&
                  is_whole(err.message, letters[k]));
    }
}

static void a_prefix_precedes_the_message(void **state)
{
  (void)state;
  gg_error err;
  char name[1024];
  gg_base_fail(&err, GG_FAILED, "why");
  gg_base_error_prefix(&err, GG_FAILED, "%s", "a.yaml");
  assert_string_equal(err.message, "a.yaml: why");
  fill(name, sizeof name - 1, "b");
  gg_base_fail(&err, GG_FAILED, "%s", name);
  assert_string_equal(err.message, name);
  assert_int_equal(gg_base_fail(NULL, GG_FAILED, "why"), GG_FAILED);
}

/* Names of files may hold whatever a terminal acts on, and bytes that are no text. */
static void foreign_texts(void **state)
{
  (void)state;
  gg_error err;
  gg_base_fail(&err, GG_FAILED, "%s: \xc3\xbc \xf0\x9f\x98\x80",
               "a\x1b[31m\n\x7f \xc2\x9b \xe2\x80\xae \xe2\x81\xa6 \xd8\x9c \xef\xbb\xbf \xfc \xc3");
  assert_string_equal(err.message, "a?[31m?? ? ? ? ? ? ? ?: \xc3\xbc \xf0\x9f\x98\x80");
  gg_base_error_prefix(&err, GG_FAILED, "%s", "b\rc");
  assert_true(strncmp(err.message, "b?c: a?", 7) == 0);
}

static void names_are_letters_digits_and_underscores(void **state)
{
  (void)state;
  assert_true(gg_base_text_is_name("N1", 40) && gg_base_text_is_name("my_T", 4));
  static const char *const bad[] = {"", "1N", "_x", "a/b", "..", "a.b", "a b", "\xc3\xbc", "my_T5"};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) assert_false(gg_base_text_is_name(bad[k], 4));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(long_names),
      cmocka_unit_test(a_prefix_precedes_the_message),
      cmocka_unit_test(foreign_texts),
      cmocka_unit_test(names_are_letters_digits_and_underscores),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
