/* A list of texts, as of warnings; {0} is an empty one. */
#ifndef GG_TEXT_LIST_H
#define GG_TEXT_LIST_H

#include <stddef.h>

#include "base/error.h"

typedef struct gg_text_list {
  char **text;
  size_t n;
} gg_text_list;

/* Out of memory: the list stays as it is. */
void gg_base_string_list_add(gg_text_list *list, const char *format, ...) GG_PRINTF(2, 3);
void gg_base_string_list_take(gg_text_list *list,
                              char *text); /* from malloc, and the list's from now on; NULL: nothing */
void gg_base_string_list_move(gg_text_list *to, gg_text_list *from); /* behind the others; nothing stays there */
void gg_base_string_list_clear(gg_text_list *list);
/* NULL after the last. */
const char *gg_base_string_list_at(const gg_text_list *list, size_t i);

/* Append to a text in a buffer of `size` bytes, cut to it. */
void gg_base_text_append(char *text, size_t size, const char *format, ...) GG_PRINTF(3, 4);

#endif
