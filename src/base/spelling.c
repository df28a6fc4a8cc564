/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/spelling.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

enum { LONGEST = 64 };

static size_t least(size_t a, size_t b)
{
  return a < b ? a : b;
}

static int letter(const char *word, size_t i)
{
  return tolower((unsigned char)word[i]);
}

static void copy_small(const char *word, size_t n, char *small)
{
  for (size_t i = 0; i < n; i++) small[i] = (char)letter(word, i);
}

/* Edit distance of two words. If it is larger than `most`, the result may be smaller than it, but is larger than
 * `most`. */
static size_t distance_up_to(const char *a, size_t n, const char *b, size_t m, size_t most)
{
  size_t rows[3][LONGEST + 1], last = 0;
  size_t *before = rows[0], *above = rows[1], *row = rows[2];
  for (size_t j = 0; j <= m; j++) above[j] = j;
  for (size_t i = 1; i <= n; i++) {
    size_t lowest = row[0] = i;
    for (size_t j = 1; j <= m; j++) {
      row[j] = least(above[j - 1] + (a[i - 1] != b[j - 1]), 1 + least(above[j], row[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = least(row[j], before[j - 2] + 1);
      lowest = least(lowest, row[j]);
    }
    if (lowest > most && last > most) return lowest; /* each row follows from the two before */
    size_t *oldest = before;
    before = above, above = row, row = oldest, last = lowest;
  }
  return above[m];
}

static size_t distance(const char *a, const char *b, size_t most)
{
  char small[2][LONGEST];
  const size_t n = strnlen(a, LONGEST), m = strnlen(b, LONGEST), apart = n < m ? m - n : n - m;
  if (apart > most) return apart;
  copy_small(a, n, small[0]);
  copy_small(b, m, small[1]);
  return distance_up_to(small[0], n, small[1], m, most);
}

size_t gg_base_spelling_distance(const char *a, const char *b)
{
  return distance(a, b, LONGEST);
}

/* One slip in a short word, up to three in a long one: what is further off confuses more than it helps. Two letters may
 * lack a third. */
static size_t limit_of(const char *word, const char *candidate)
{
  size_t length = strlen(word);
  if (length < 3) return length == 2 && strlen(candidate) == 3;
  return length < 6 ? 1 : length < 8 ? 2 : 3;
}

/* "temp" for "temperature", "benchmark" for "bench" */
static bool is_beginning(const char *word, const char *candidate)
{
  size_t length = strlen(word), other = strlen(candidate), both = least(length, other);
  for (size_t i = 0; i < both; i++)
    if (letter(word, i) != letter(candidate, i)) return false;
  return length < other ? length >= 3 : other >= 4;
}

void gg_base_spelling_try(gg_nearest *nearest, const char *candidate)
{
  const size_t limit = limit_of(nearest->word, candidate);
  size_t off = distance(nearest->word, candidate, limit);
  if (off && is_beginning(nearest->word, candidate)) off = 1;
  if (off > limit || off >= strlen(candidate)) return;
  if (nearest->best && off >= nearest->distance) return;
  nearest->best = candidate;
  nearest->distance = off;
}
