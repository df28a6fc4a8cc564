#include "io/nearest.h"

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

size_t gg_edit_distance(const char *a, const char *b)
{
  size_t n = strnlen(a, LONGEST), m = strnlen(b, LONGEST), rows[3][LONGEST + 1];
  size_t *before = rows[0], *above = rows[1], *row = rows[2];
  for (size_t j = 0; j <= m; j++) above[j] = j;
  for (size_t i = 1; i <= n; i++) {
    row[0] = i;
    for (size_t j = 1; j <= m; j++) {
      row[j] = least(above[j - 1] + (letter(a, i - 1) != letter(b, j - 1)), 1 + least(above[j], row[j - 1]));
      if (i > 1 && j > 1 && letter(a, i - 1) == letter(b, j - 2) && letter(a, i - 2) == letter(b, j - 1))
        row[j] = least(row[j], before[j - 2] + 1);
    }
    size_t *oldest = before;
    before = above, above = row, row = oldest;
  }
  return above[m];
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

void gg_nearest_try(gg_nearest *nearest, const char *candidate)
{
  size_t distance = gg_edit_distance(nearest->word, candidate);
  if (distance && is_beginning(nearest->word, candidate)) distance = 1;
  if (distance > limit_of(nearest->word, candidate) || distance >= strlen(candidate)) return;
  if (nearest->best && distance >= nearest->distance) return;
  nearest->best = candidate;
  nearest->distance = distance;
}
