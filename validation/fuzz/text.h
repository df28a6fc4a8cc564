/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bytes as the texts that they stand for. */
#ifndef GG_FUZZ_TEXT_H
#define GG_FUZZ_TEXT_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Ended by a zero, in memory of exactly its size; to be freed. */
static inline char *fuzz_text(const uint8_t *data, size_t size)
{
  char *text = malloc(size + 1);
  if (!text) return NULL;
  if (size) memcpy(text, data, size);
  text[size] = '\0';
  return text;
}

/* The next line of it, ended; NULL: none is left. */
static inline char *fuzz_line(char **rest)
{
  char *line = *rest;
  if (!line) return NULL;
  char *end = strchr(line, '\n');
  if (end) *end = '\0';
  *rest = end ? end + 1 : NULL;
  return line;
}

#endif
