/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "io/checked_json.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

#include "base/text.h"

json_t *gg_io_json_end(unsigned before, json_t *document)
{
  if (document && gg_base_memory_failures() == before) return document;
  gg_base_memory_lacked();
  json_decref(document);
  return NULL;
}

json_t *gg_io_json_made(json_t *value)
{
  if (!value) gg_base_memory_lacked();
  return value;
}

int gg_io_json_put(int failed)
{
  if (failed) gg_base_memory_lacked();
  return failed;
}

const char *gg_io_json_string(const json_t *object, const char *key)
{
  const char *text = json_string_value(json_object_get(object, key));
  return text ? text : "";
}

double gg_io_json_number(const json_t *object, const char *key)
{
  const json_t *value = json_object_get(object, key);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

json_t *gg_io_json_finite(double x)
{
  return isfinite(x) ? json_real(x) : json_null();
}

typedef struct source {
  const char *text;
  bool lacked;
} source;

/* One letter at a time: where jansson has no room for one it leaves it out, and each number clears errno. */
static size_t next_letter(void *buffer, size_t size, void *context)
{
  source *s = context;
  (void)size;
  s->lacked |= errno == ENOMEM;
  if (!*s->text) return 0;
  *(char *)buffer = *s->text++;
  return 1;
}

json_t *gg_io_json_read(const char *text, const char **why)
{
  source s = {.text = text};
  errno = 0;
  GG_C_LOCALE; /* jansson knows decimal points of one byte only */
  json_t *document = json_load_callback(next_letter, &s, 0, NULL);
  s.lacked |= errno == ENOMEM;
  if (s.lacked) {
    gg_base_memory_lacked();
    json_decref(document);
    document = NULL;
  }
  if (!document && why) *why = s.lacked ? "out of memory" : "its document is damaged";
  return document;
}

json_t *gg_io_json_format(const char *format, ...)
{
  va_list args;
  va_start(args, format);
  GG_C_LOCALE;
  json_t *text = json_vsprintf(format, args);
  va_end(args);
  return text;
}

/* Into a stream that reports what was lost: json_dumps leaves out keys that it has no room for. */
char *gg_io_json_text(const json_t *value, size_t flags)
{
  char *text = NULL;
  GG_C_LOCALE;
  FILE *out = gg_base_memory_stream_open(&text);
  const bool whole = out && value && json_dumpf(value, out, flags) == 0;
  if (!gg_base_memory_stream_close(out, &text) || whole) return text;
  gg_base_memory_lacked();
  free(text);
  return NULL;
}
