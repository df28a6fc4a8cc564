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

/* Told only: `out` writes at the end. */
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

/* Lists hold what people and documents are told. */
void gg_base_string_list_take(gg_string_list *list, char *text)
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
  gg_base_string_list_take(list, text);
}

void gg_base_string_list_move(gg_string_list *to, gg_string_list *from)
{
  for (size_t i = 0; i < from->n; i++) gg_base_string_list_take(to, from->text[i]);
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

/* Bytes of the UTF-8 character that begins here, 0 if none does. */
static size_t character(const unsigned char *c)
{
  size_t n = *c < 0x80                 ? 1
             : *c >= 0xc2 && *c < 0xe0 ? 2
             : *c >= 0xe0 && *c < 0xf0 ? 3
             : *c >= 0xf0 && *c < 0xf5 ? 4
                                       : 0;
  for (size_t k = 1; k < n; k++)
    if ((c[k] & 0xc0) != 0x80) return 0;
  bool overlong = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90);
  bool beyond = (c[0] == 0xed && c[1] > 0x9f) || (c[0] == 0xf4 && c[1] > 0x8f);
  return overlong || beyond ? 0 : n;
}

/* Control characters, line and paragraph separators, and what changes the direction of writing or is not seen. */
static bool is_control(const unsigned char *c, size_t bytes)
{
  if (bytes == 1) return *c < ' ' || *c == 0x7f;
  if (bytes == 2) return (c[0] == 0xc2 && c[1] < 0xa0) || (c[0] == 0xd8 && c[1] == 0x9c);
  if (bytes == 4) return c[0] == 0xf3 && c[1] == 0xa0; /* invisible tags */
  const unsigned code = (c[0] & 15u) << 12 | (c[1] & 63u) << 6 | (c[2] & 63u);
  return (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2060 && code <= 0x206f) || code == 0xfeff;
}

bool gg_base_text_is_printable(const char *text)
{
  for (const unsigned char *c = (const unsigned char *)text; *c; c += character(c))
    if (!character(c) || is_control(c, character(c))) return false;
  return true;
}

void gg_base_text_make_printable(char *text)
{
  char *to = text;
  for (const unsigned char *c = (const unsigned char *)text; *c;) {
    const size_t bytes = character(c);
    if (bytes && !is_control(c, bytes))
      memmove(to, c, bytes), to += bytes;
    else
      *to++ = '?';
    c += bytes ? bytes : 1;
  }
  *to = '\0';
}

/* In any locale. */
static bool is_letter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool gg_base_text_is_name(const char *text, size_t longest)
{
  bool good = is_letter(*text) && strlen(text) <= longest;
  for (const char *c = text; *c; c++) good &= is_letter(*c) || (*c >= '0' && *c <= '9') || *c == '_';
  return good;
}

locale_t gg_base_c_locale_enter(void)
{
  locale_t copy = duplocale(uselocale((locale_t)0));
  locale_t c = copy ? newlocale(LC_NUMERIC_MASK, "C", copy) : (locale_t)0; /* which becomes the copy */
  if (!c && copy) freelocale(copy);
  if (!c) c = newlocale(LC_ALL_MASK, "C", (locale_t)0); /* takes no memory */
  return c ? uselocale(c) : (locale_t)0;
}

void gg_base_c_locale_leave(locale_t before)
{
  if (!before) return;
  locale_t c = uselocale(before);
  if (c != LC_GLOBAL_LOCALE) freelocale(c);
}
