/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/error.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/printable.h"

enum { LONGEST = 8192, HEAD = 300 }; /* a path may have 4096, a reason a thousand */
static const char between[] = " ... ";

static bool begins_letter(char c)
{
  return ((unsigned char)c & 0xC0) != 0x80; /* UTF-8 */
}

/* Store a message. A long one is cut in the middle, since it begins with a name and ends with the reason. Names of
 * files and keys may hold anything: characters that a terminal would act on are replaced here, for all messages. */
static void put(gg_error *err, char *whole)
{
  gg_base_text_make_printable(whole);
  const size_t room = sizeof err->message - 1, length = strlen(whole);
  if (length <= room) {
    memcpy(err->message, whole, length + 1);
    return;
  }
  size_t head = HEAD, from = length - (room - HEAD - strlen(between));
  while (head > 0 && !begins_letter(whole[head])) head--;
  while (from < length && !begins_letter(whole[from])) from++;
  snprintf(err->message, sizeof err->message, "%.*s%s%s", (int)head, whole, between, whole + from);
}

gg_status gg_base_fail(gg_error *err, gg_status status, const char *format, ...)
{
  if (err) {
    char whole[LONGEST];
    va_list args;
    va_start(args, format);
    vsnprintf(whole, sizeof whole, format, args);
    va_end(args);
    put(err, whole);
    err->status = status, err->cause = GG_CAUSE_OTHER;
  }
  return status;
}

gg_status gg_base_error_prefix(gg_error *err, gg_status status, const char *format, ...)
{
  if (err) {
    char whole[LONGEST];
    const size_t room = sizeof whole - sizeof err->message - 2;
    va_list args;
    va_start(args, format);
    vsnprintf(whole, room, format, args);
    va_end(args);
    const size_t used = strlen(whole);
    snprintf(whole + used, sizeof whole - used, ": %s", err->message);
    put(err, whole);
    err->status = status;
  }
  return status;
}
