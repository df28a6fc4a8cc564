/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of the lines of a sweep's picture: what the other keys are. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "plot/chart.h"
#include "sweep/sweep_table.h"

enum { LONG_VALUE = 20 }; /* a longer value is cut to what it differs in */

/* Bytes that all values of a key begin with, up to the beginning of a member of a list or a map. */
static size_t shared_head(const gg_varied *v, size_t k)
{
  const char *one = v->value[k];
  size_t n = strlen(one);
  for (size_t i = 1; i < v->n; i++) {
    const char *other = v->value[i * v->n_keys + k];
    for (size_t j = 0; j < n; j++)
      if (one[j] != other[j]) n = j;
  }
  while (n && !strchr("{[ ", one[n - 1])) n--;
  if (n >= 2 && one[n - 1] == ' ' && one[n - 2] == ':') /* "mass: 0.5", with the name of the member */
    for (n -= 2; n && !strchr("{[ ", one[n - 1]);) n--;
  return n;
}

/* Bytes that all values end with, beyond the first `head`, from the end of a member. */
static size_t shared_tail(const gg_varied *v, size_t k, size_t head)
{
  const char *one = v->value[k];
  const size_t length = strlen(one);
  size_t n = length - head;
  for (size_t i = 1; i < v->n; i++) {
    const char *other = v->value[i * v->n_keys + k];
    const size_t its = strlen(other);
    if (n > its - head) n = its - head;
    for (size_t j = 0; j < n; j++)
      if (one[length - 1 - j] != other[its - 1 - j]) n = j;
  }
  while (n && !strchr("}],", one[length - n])) n--;
  return n;
}

static void add_value(char *text, const gg_varied *v, size_t row, size_t k)
{
  char part[GG_COMBINATION_NAME], plain[GG_COMBINATION_NAME];
  const char *value = v->value[row * v->n_keys + k];
  const bool cut = strlen(value) > LONG_VALUE && v->n > 1;
  const size_t head = cut ? shared_head(v, k) : 0, tail = cut ? shared_tail(v, k, head) : 0;
  snprintf(part, sizeof part, "%.*s", (int)(strlen(value) - head - tail), value + head);
  gg_plot_text_escape(part, plain, sizeof plain);
  gg_base_text_append(text, GG_COMBINATION_NAME, "%s%s%s", head ? "…" : "", plain, tail ? "…" : "");
}

void gg_sweep_line_group_name(const gg_sweep *sweep, size_t point, size_t varied, char text[GG_COMBINATION_NAME])
{
  char symbol[64];
  *text = '\0';
  for (size_t f = 0; f < sweep->n_varied; f++) {
    const gg_varied *v = &sweep->varied[f];
    for (size_t k = 0; f != varied && k < v->n_keys; k++) {
      gg_plot_chart_key(v->key[k], symbol, sizeof symbol, NULL);
      gg_base_text_append(text, GG_COMBINATION_NAME, "%s%s = ", *text ? ", " : "", symbol);
      add_value(text, v, gg_sweep_row(sweep, point, f), k);
    }
  }
}
