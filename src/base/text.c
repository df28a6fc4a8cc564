/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

#include "base/memory.h"

#ifdef __GLIBC__
enum { FIRST_ROOM = 1024 };

typedef struct stream {
  char **place, *text;
  size_t length, room; /* an end beside them */
  bool lacked;
} stream;

static bool make_room(stream *s, size_t more)
{
  size_t room = s->room;
  if (s->length + more < room) return true;
  while (room <= s->length + more) room *= 2;
  char *larger = realloc(s->text, room);
  if (!larger) return false;
  s->text = larger, s->room = room;
  return true;
}

/* Less than all is an error; the C library does not tell each of them when it closes. */
static ssize_t add(void *cookie, const char *piece, size_t n)
{
  stream *s = cookie;
  s->lacked |= !make_room(s, n);
  if (s->lacked) return 0;
  memcpy(s->text + s->length, piece, n);
  s->length += n;
  return (ssize_t)n;
}

/* Position only: `out` writes at the end. */
static int tell(void *cookie, off64_t *offset, int from)
{
  const stream *s = cookie;
  if (*offset != 0 || from != SEEK_CUR) return -1;
  *offset = (off64_t)s->length;
  return 0;
}

static int end(void *cookie)
{
  stream *s = cookie;
  const int failed = s->lacked ? EOF : 0;
  if (s->lacked)
    free(s->text);
  else
    s->text[s->length] = '\0', *s->place = s->text;
  free(s);
  return failed;
}

FILE *gg_base_memory_stream_open(char **text)
{
  stream *s = calloc(1, sizeof *s);
  FILE *out = NULL;
  *text = NULL;
  if (s) *s = (stream){.place = text, .text = malloc(FIRST_ROOM), .room = FIRST_ROOM};
  if (s && s->text) out = fopencookie(s, "w", (cookie_io_functions_t){.write = add, .seek = tell, .close = end});
  if (out) return out;
  if (s) free(s->text);
  free(s);
  return NULL;
}
#else
FILE *gg_base_memory_stream_open(char **text)
{
  static _Thread_local size_t length; /* nobody asks for it */
  *text = NULL;
  return open_memstream(text, &length);
}
#endif

bool gg_base_memory_stream_close(FILE *out, char *const *text)
{
  const bool whole = out && fclose(out) == 0 && *text;
  if (!whole) gg_base_memory_lacked();
  return whole;
}

/* Append a text from malloc (NULL: it could not be had). Lists hold texts for people and documents. */
static void take(gg_string_list *list, char *text)
{
  char **more = text ? realloc(list->text, (list->n + 1) * sizeof *more) : NULL;
  if (text) gg_base_text_make_printable(text);
  if (!more) {
    gg_base_memory_lacked();
    free(text);
    return;
  }
  list->text = more;
  list->text[list->n++] = text;
}

void gg_base_string_list_add(gg_string_list *list, const char *format, ...)
{
  char *text = NULL;
  va_list args;
  va_start(args, format);
  if (vasprintf(&text, format, args) < 0) text = NULL;
  va_end(args);
  take(list, text);
}

void gg_base_string_list_move(gg_string_list *to, gg_string_list *from)
{
  for (size_t i = 0; i < from->n; i++) take(to, from->text[i]);
  free(from->text);
  *from = (gg_string_list){0};
}

void gg_base_string_list_clear(gg_string_list *list)
{
  for (size_t i = 0; i < list->n; i++) free(list->text[i]);
  free(list->text);
  *list = (gg_string_list){0};
}

const char *gg_base_string_list_at(const gg_string_list *list, size_t i)
{
  return i < list->n ? list->text[i] : NULL;
}

void gg_base_text_append(char *text, size_t size, const char *format, ...)
{
  const size_t used = strlen(text);
  va_list args;
  va_start(args, format);
  vsnprintf(text + used, size - used, format, args);
  va_end(args);
}
