/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/species.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

gg_species_pair gg_common_pair_species(int pair)
{
  gg_species_pair p = {0, 0};
  while (gg_pair(0, p.j + 1) <= pair) p.j++;
  p.i = pair - gg_pair(0, p.j);
  return p;
}

const char *gg_common_pair_name(int pair, char name[GG_PAIR_NAME])
{
  const gg_species_pair p = gg_common_pair_species(pair);
  snprintf(name, GG_PAIR_NAME, p.j < 9 ? "%d%d" : "%d-%d", p.i + 1, p.j + 1);
  return name;
}

/* A number of one or two digits, from 1 on; 0: it is none. */
static int number(const char *text, size_t digits)
{
  int value = 0;
  if (digits < 1 || digits > 2) return 0;
  for (size_t k = 0; k < digits; k++) {
    if (!isdigit((unsigned char)text[k]) || (k == 0 && text[k] == '0')) return 0;
    value = 10 * value + (text[k] - '0');
  }
  return value;
}

int gg_common_pair_find(const char *name)
{
  const char *dash = strchr(name, '-');
  size_t length = strlen(name);
  if (!dash && length != 2) return -1;
  int i = dash ? number(name, (size_t)(dash - name)) : number(name, 1);
  int j = dash ? number(dash + 1, length - (size_t)(dash - name) - 1) : number(name + 1, 1);
  return i < 1 || j < 1 || i > GG_MAX_SPECIES || j > GG_MAX_SPECIES ? -1 : gg_pair(i - 1, j - 1);
}

void gg_common_species_deal(int64_t n, int n_species, const double *weight, int64_t *n_of)
{
  double total = 0, remainder[GG_MAX_SPECIES];
  for (int i = 0; i < n_species; i++) total += weight[i];
  int64_t left = n;
  for (int i = 0; i < n_species; i++) {
    double exact = (double)n * weight[i] / total;
    n_of[i] = (int64_t)floor(exact * (1 + 1e-15));
    remainder[i] = exact - (double)n_of[i];
    left -= n_of[i];
  }
  for (; left > 0; left--) {
    int next = 0;
    for (int i = 1; i < n_species; i++)
      if (remainder[i] > remainder[next]) next = i;
    n_of[next]++;
    remainder[next] = -1;
  }
}
