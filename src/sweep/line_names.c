/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of the lines of a sweep's picture: what the other keys are. */
#include <stdio.h>
#include <string.h>

#include "plot/chart.h"
#include "sweep/sweep_table.h"

/* Letters, of which a picture has room for some 70; a longer value is cut to what it differs in. */
enum { LONG_VALUE = 20, LONGEST_PART = 32, LONGEST_NAME = 56 };

size_t gg_sweep_line_group_of(const gg_sweep *sweep, size_t i, size_t varied)
{
  size_t stride = 1;
  for (size_t f = sweep->n_varied - 1; f > varied; f--) stride *= sweep->varied[f].n;
  return i - gg_sweep_row(sweep, i, varied) * stride;
}

/* A name as it grows, counted in letters: neither bytes of UTF-8 nor marks of enhanced text take room. */
typedef struct line {
  char *text;
  size_t used;
  int letters;
  bool cut;
} line;

static bool begins_letter(char c)
{
  return (c & 0xc0) != 0x80;
}

static bool has_room(const line *l, size_t bytes, int letters)
{
  enum { END = 40 }; /* bytes kept for the number of one that is cut */
  return !l->cut && l->used + bytes + END <= GG_COMBINATION_NAME && l->letters + letters <= LONGEST_NAME;
}

/* Enhanced text, the whole of it or nothing. */
static void add(line *l, const char *text)
{
  int letters = 0;
  for (const char *c = text; *c; c++) letters += begins_letter(*c) && !strchr("{}^_\\", *c);
  l->cut = !has_room(l, strlen(text), letters);
  if (l->cut) return;
  memcpy(l->text + l->used, text, strlen(text));
  l->used += strlen(text), l->letters += letters;
}

/* Text without marks, as much of it as there is room for. */
static void add_plain(line *l, const char *text, size_t length)
{
  const int end = l->letters + LONGEST_PART;
  for (size_t i = 0; i < length && !l->cut; i++) {
    const bool letter = begins_letter(text[i]);
    l->cut = !has_room(l, 2, letter) || (letter && l->letters == end);
    if (l->cut) return;
    if (strchr("_^{}@&~\\", text[i])) l->text[l->used++] = '\\';
    l->text[l->used++] = text[i];
    l->letters += letter;
  }
}

/* Bytes that all values of a key begin with (end with, beyond the first `head`), up to where a member of a list or a
 * map begins (ends). */
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

static void add_value(line *l, const gg_varied *v, size_t row, size_t k)
{
  const char *value = v->value[row * v->n_keys + k];
  const size_t length = strlen(value);
  if (length <= LONG_VALUE || v->n == 1) {
    add_plain(l, value, length);
    return;
  }
  const size_t head = shared_head(v, k), tail = shared_tail(v, k, head);
  if (head) add(l, "…");
  add_plain(l, value + head, length - head - tail);
  if (tail) add(l, "…");
}

void gg_sweep_line_group_name(const gg_sweep *sweep, size_t combination, size_t varied, char text[GG_COMBINATION_NAME])
{
  char symbol[64], name[72];
  line l = {.text = text};
  for (size_t f = 0; f < sweep->n_varied; f++) {
    const gg_varied *v = &sweep->varied[f];
    for (size_t k = 0; f != varied && k < v->n_keys && !l.cut; k++) {
      gg_plot_chart_key(v->key[k], symbol, sizeof symbol, NULL);
      snprintf(name, sizeof name, "%s%s = ", l.used ? ", " : "", symbol);
      add(&l, name);
      add_value(&l, v, gg_sweep_row(sweep, combination, f), k);
    }
  }
  if (l.cut)
    snprintf(text + l.used, GG_COMBINATION_NAME - l.used, "… (point %zu)", combination + 1);
  else
    text[l.used] = '\0';
}
