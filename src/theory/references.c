/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/references.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char separators[] = " ,\t\n";

/* Length of the word at the start of a text. */
static size_t length_of(const char *text)
{
  return strcspn(text, separators);
}

/* Whether a list of `length` characters has the word. */
static bool has_word(const char *list, size_t length, const char *word, size_t letters)
{
  for (const char *at = list; at < list + length;) {
    const size_t n = strcspn(at, " }");
    if (n == letters && strncmp(at, word, letters) == 0) return true;
    at += n + 1;
  }
  return false;
}

/* Names of the methods of an entry: the field `graingas`. */
static const char *methods_of(const char *entry, size_t *length)
{
  static const char field[] = "\n  graingas = {";
  const char *list = strstr(entry, field) + strlen(field);
  *length = strcspn(list, "}");
  return list;
}

static bool is_wanted(const char *entry, const char *words)
{
  size_t length;
  const char *list = methods_of(entry, &length);
  if (has_word(list, length, "graingas", strlen("graingas"))) return true;
  for (const char *w = words; *(w += strspn(w, separators)); w += length_of(w))
    if (has_word(list, length, w, length_of(w))) return true;
  return false;
}

static bool has_entry(const char *word, size_t letters)
{
  for (const char *const *e = gg_theory_references_text + 1; *e; e++) {
    size_t length;
    const char *list = methods_of(*e, &length);
    if (has_word(list, length, word, letters)) return true;
  }
  return false;
}

/* Write an entry without the field `graingas` and without comments. */
static void write_entry(FILE *out, const char *entry)
{
  for (const char *line = entry; *line && *line != '}'; line += strcspn(line, "\n") + 1) {
    size_t n = strcspn(line, "\n");
    const char *comment = memmem(line, n, " % ", 3);
    if (comment) n = (size_t)(comment - line);
    if (strncmp(line, "  graingas =", 12) != 0) fprintf(out, "%.*s\n", (int)n, line);
  }
  fprintf(out, "}\n");
}

char *gg_theory_references(const char *words, size_t *n)
{
  char *text = NULL;
  size_t size = 0, known = 0, written = 0;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  for (const char *w = words; *(w += strspn(w, separators)); w += length_of(w)) known += has_entry(w, length_of(w));
  for (const char *const *e = gg_theory_references_text + 1; *e; e++) {
    if (!is_wanted(*e, words)) continue;
    if (written++) fputc('\n', out);
    write_entry(out, *e);
  }
  if (n) *n = known;
  return fclose(out) == 0 ? text : (free(text), NULL);
}
