/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The known word nearest to one that was mistyped, for "did you mean". */
#ifndef GG_NEAREST_H
#define GG_NEAREST_H

#include <stddef.h>

/* Insertions, deletions, substitutions and swaps of neighbours between two words; capitals are no others. */
size_t gg_base_spelling_distance(const char *a, const char *b);

/* Keeps the best of the candidates shown to it; start with {.word = ...}. */
typedef struct gg_nearest {
  const char *word;
  const char *best; /* NULL: nothing near enough to be worth naming */
  size_t distance;
} gg_nearest;
void gg_base_spelling_try(gg_nearest *nearest, const char *candidate);

#endif
