#include "base/string_list.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void gg_base_string_list_take(gg_text_list *list, char *text)
{
  char **more = text ? realloc(list->text, (list->n + 1) * sizeof *more) : NULL;
  if (!more) {
    gg_base_memory_lacked();
    free(text);
    return;
  }
  list->text = more;
  list->text[list->n++] = text;
}

void gg_base_string_list_add(gg_text_list *list, const char *format, ...)
{
  char *text = NULL;
  va_list args;
  va_start(args, format);
  if (vasprintf(&text, format, args) < 0) text = NULL;
  va_end(args);
  gg_base_string_list_take(list, text);
}

void gg_base_string_list_move(gg_text_list *to, gg_text_list *from)
{
  for (size_t i = 0; i < from->n; i++) gg_base_string_list_take(to, from->text[i]);
  free(from->text);
  *from = (gg_text_list){0};
}

void gg_base_string_list_clear(gg_text_list *list)
{
  for (size_t i = 0; i < list->n; i++) free(list->text[i]);
  free(list->text);
  *list = (gg_text_list){0};
}

const char *gg_base_string_list_at(const gg_text_list *list, size_t i)
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
