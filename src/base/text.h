/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts in memory: streams that are written piece by piece, and lists. */
#ifndef GG_BASE_TEXT_H
#define GG_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/error.h"
#include "base/printable.h"

/* As open_memstream, which leaves out what it finds no room for and does not say so (glibc 2.36). *text is there when
 * it is closed; to be freed. NULL: no memory. ftell says how long it is by now. */
FILE *gg_base_memory_stream_open(char **text);
/* False, and noted (gg_base_memory_lacked): it is not whole, and *text is NULL. `out` may be NULL. */
bool gg_base_memory_stream_close(FILE *out, char *const *text);

/* A list of texts, as of warnings; {0} is an empty one. */
typedef struct gg_string_list {
  char **text;
  size_t n;
} gg_string_list;

/* Out of memory: the list stays as it is. */
void gg_base_string_list_add(gg_string_list *list, const char *format, ...) GG_PRINTF(2, 3);
void gg_base_string_list_move(gg_string_list *to, gg_string_list *from); /* behind the others; nothing stays there */
void gg_base_string_list_clear(gg_string_list *list);
/* NULL after the last. */
const char *gg_base_string_list_at(const gg_string_list *list, size_t i);

/* Append to a text in a buffer of `size` bytes, cut to it. */
void gg_base_text_append(char *text, size_t size, const char *format, ...) GG_PRINTF(3, 4);

#endif
