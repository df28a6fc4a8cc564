#include "io/nearest.h"

#include <string.h>

enum { LONGEST = 64 };

static size_t least(size_t a, size_t b)
{
  return a < b ? a : b;
}

size_t gg_edit_distance(const char *a, const char *b)
{
  size_t n = strnlen(a, LONGEST), m = strnlen(b, LONGEST), row[LONGEST + 1];
  for (size_t j = 0; j <= m; j++) row[j] = j;
  for (size_t i = 1; i <= n; i++) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= m; j++) {
      size_t above = row[j];
      row[j] = least(diagonal + (a[i - 1] != b[j - 1]), 1 + least(above, row[j - 1]));
      diagonal = above;
    }
  }
  return row[m];
}

void gg_nearest_try(gg_nearest *nearest, const char *candidate)
{
  size_t distance = gg_edit_distance(nearest->word, candidate);
  /* Further than about half the word, a guess confuses more than it helps. */
  size_t limit = 1 + strlen(nearest->word) / 2;
  if (strlen(nearest->word) < 2 || distance > limit || distance >= strlen(candidate)) return;
  if (nearest->best && distance >= nearest->distance) return;
  nearest->best = candidate;
  nearest->distance = distance;
}
