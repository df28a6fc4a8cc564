/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The keys that a sweep varies: their values as they are written, and the rows that these make. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/memory.h"
#include "scene/fields.h"
#include "sweep/sweep.h"

/* Limits of the values of one key together, and of all drawn values. */
enum { MOST_VALUE_CHARACTERS = 1 << 22, MOST_DRAWN_CHARACTERS = 1 << 26 };

void gg_sweep_values_clear(gg_values *v)
{
  for (size_t i = 0; i < v->n; i++) free(v->text[i]);
  free(v->text);
  v->text = NULL, v->n = v->room = v->characters = 0;
}

gg_status gg_sweep_values_add(gg_values *v, const char *text, gg_error *err)
{
  if (v->n == GG_MOST_POINTS)
    return GG_REFUSE(err, "a key has more than %d values; a sweep has at most as many points", GG_MOST_POINTS);
  v->characters += strlen(text);
  if (v->characters > MOST_VALUE_CHARACTERS)
    return GG_REFUSE(err, "the values of a key have more than %d characters together", MOST_VALUE_CHARACTERS);
  if (v->n == v->room) {
    size_t room = v->room ? 2 * v->room : 8;
    char **grown = realloc(v->text, room * sizeof *grown);
    if (!grown) return gg_base_out_of_memory(err);
    v->text = grown;
    v->room = room;
  }
  v->text[v->n] = strdup(text);
  return v->text[v->n] ? v->n++, GG_OK : gg_base_out_of_memory(err);
}

static bool is_number(const char *text, size_t length, double *value)
{
  char word[40], *end;
  if (length == 0 || length >= sizeof word) return false;
  memcpy(word, text, length);
  word[length] = '\0';
  if (word[strspn(word, "0123456789+-.eE")]) return false;
  errno = 0; /* a number too large or too small for a double is an error */
  *value = strtod(word, &end);
  return !*end && errno == 0;
}

/* Steps are added up in decimal digits, as people write them: 0.1 + 2*0.1 is 0.3, the number of a list. Whole numbers
 * are exact. */
static gg_status add_steps(gg_values *v, double first, double step, size_t n, gg_error *err)
{
  const bool whole = first == floor(first) && step == floor(step);
  for (size_t i = 0; i < n; i++) {
    char text[40];
    double x = first + (double)i * step;
    if (fabs(x) < 1e-12 * fabs(step)) x = 0;
    snprintf(text, sizeof text, "%.*g", whole ? 17 : 12, x);
    gg_scene_yaml_number(strtod(text, NULL), text);
    GG_TRY(gg_sweep_values_add(v, text, err));
  }
  return GG_OK;
}

static gg_status add_range(gg_values *v, const char *text, bool *is, gg_error *err)
{
  double x[3];
  const char *at = text;
  *is = false;
  if (!strchr(text, ':')) return GG_OK;
  for (int k = 0; k < 3; k++) {
    size_t length = strcspn(at, ":");
    if (!is_number(at, length, &x[k])) return GG_OK;
    at += length;
    if (*at != (k < 2 ? ':' : '\0'))
      return GG_REFUSE(err, "key '%.60s': '%.60s': a range is first:last:step", v->key, text);
    at += k < 2;
  }
  *is = true;
  double steps = x[2] != 0 ? (x[1] - x[0]) / x[2] : -1;
  if (!(steps >= 0))
    return GG_REFUSE(err, "key '%.60s': '%.60s': the step does not lead from the first to the last", v->key, text);
  const bool whole = x[0] == floor(x[0]) && x[2] == floor(x[2]);
  const double largest = fmax(fabs(x[0]), fabs(x[1]));
  if (whole ? largest >= 0x1p53 : fabs(x[2]) < 1e-11 * largest)
    return GG_REFUSE(err, "key '%.60s': '%.60s': the step is lost in the digits of the numbers", v->key, text);
  if (steps >= GG_MOST_POINTS)
    return GG_REFUSE(err, "key '%.60s': '%.60s': these are %.0f values; a sweep has at most %d points", v->key, text,
                     floor(steps) + 1, GG_MOST_POINTS);
  return add_steps(v, x[0], x[2], (size_t)(steps * (1 + 1e-12) + 1e-9) + 1, err);
}

static gg_status take_span(gg_values *v, const char *text, bool *is, gg_error *err)
{
  const char *dots = strstr(text, "..");
  *is = dots && is_number(text, (size_t)(dots - text), &v->low) && is_number(dots + 2, strlen(dots + 2), &v->high);
  if (!*is) return GG_OK;
  if (!(v->low < v->high)) return GG_REFUSE(err, "key '%.60s': '%.60s': the lower end has to come first", v->key, text);
  v->range = true;
  return GG_OK;
}

static gg_status add_word(gg_values *v, const char *text, gg_error *err)
{
  bool is;
  GG_TRY(add_range(v, text, &is, err));
  if (is) return GG_OK;
  if (!*text) return GG_REFUSE(err, "key '%.60s': a value is missing", v->key);
  return gg_sweep_values_add(v, text, err);
}

/* Length up to the next comma outside of brackets and quotes. */
static size_t word_length(const char *text)
{
  int depth = 0;
  char quote = 0;
  size_t n = 0;
  for (; text[n] && (text[n] != ',' || depth > 0 || quote); n++) {
    if (quote)
      quote = text[n] == quote ? 0 : quote;
    else if (text[n] == '"' || text[n] == '\'')
      quote = text[n];
    else
      depth += strchr("[{", text[n]) ? 1 : strchr("]}", text[n]) ? -1 : 0;
  }
  return n;
}

gg_status gg_sweep_values_parse(gg_values *v, const char *text, gg_error *err)
{
  bool is;
  GG_TRY(take_span(v, text, &is, err));
  while (!is) {
    text += strspn(text, " ");
    size_t length = word_length(text), used = length;
    while (used && text[used - 1] == ' ') used--;
    GG_FREED char *word = strndup(text, used);
    GG_TRY(word ? add_word(v, word, err) : gg_base_out_of_memory(err));
    if (!text[length]) return GG_OK;
    text += length + 1;
  }
  return GG_OK;
}

void gg_sweep_varied_clear(gg_varied *v)
{
  for (size_t k = 0; v->key && k < v->n_keys; k++) free(v->key[k]);
  for (size_t i = 0; v->value && i < v->n * v->n_keys; i++) free(v->value[i]);
  free(v->key);
  free(v->value);
  *v = (gg_varied){0};
}

bool gg_sweep_varies(const gg_sweep *sweep, const char *key)
{
  for (size_t f = 0; f < sweep->n_varied; f++)
    for (size_t k = 0; k < sweep->varied[f].n_keys; k++)
      if (strcmp(sweep->varied[f].key[k], key) == 0) return true;
  return false;
}

static bool names_member(const gg_varied *v, size_t k, const char *member)
{
  for (size_t i = 0; i < v->n; i++)
    if (strstr(v->value[i * v->n_keys + k], member)) return true;
  return false;
}

bool gg_sweep_sets(const gg_sweep *sweep, const char *key)
{
  const char *dot = strchr(key, '.');
  if (gg_sweep_varies(sweep, key)) return true;
  if (!dot) return false;
  const size_t length = (size_t)(dot - key);
  for (size_t f = 0; f < sweep->n_varied; f++) {
    const gg_varied *v = &sweep->varied[f];
    for (size_t k = 0; k < v->n_keys; k++)
      if (strncmp(v->key[k], key, length) == 0 && !v->key[k][length] && names_member(v, k, dot + 1)) return true;
  }
  return false;
}

static gg_status check_new(const gg_sweep *sweep, const gg_varied *v, gg_error *err)
{
  if (sweep->n_varied == GG_MOST_VARIED) return GG_REFUSE(err, "more than %d keys are varied", GG_MOST_VARIED);
  for (size_t k = 0; k < v->n_keys; k++) {
    if (gg_sweep_varies(sweep, v->key[k])) return GG_REFUSE(err, "key '%.60s': is varied twice", v->key[k]);
    for (size_t j = 0; j < k; j++)
      if (strcmp(v->key[j], v->key[k]) == 0) return GG_REFUSE(err, "key '%.60s': is varied twice", v->key[k]);
  }
  return GG_OK;
}

/* Add a group to the sweep, which takes it over; on failure the group is cleared. */
static gg_status add(gg_sweep *sweep, gg_varied *v, gg_error *err)
{
  gg_status status = check_new(sweep, v, err);
  if (status == GG_OK)
    sweep->varied[sweep->n_varied++] = *v;
  else
    gg_sweep_varied_clear(v);
  return status;
}

static gg_status new_varied(gg_varied *v, const gg_values *lists, size_t n_keys, size_t n, gg_error *err)
{
  *v = (gg_varied){.n_keys = n_keys, .n = n};
  v->key = gg_base_array_new(n_keys, sizeof *v->key, err);
  v->value = gg_base_array_new(n_keys * n, sizeof *v->value, err);
  bool good = v->key && v->value;
  for (size_t k = 0; good && k < n_keys; k++) good = (v->key[k] = strdup(lists[k].key));
  if (good) return GG_OK;
  gg_sweep_varied_clear(v);
  return gg_base_out_of_memory(err);
}

gg_status gg_sweep_add_rows(gg_sweep *sweep, gg_values *lists, size_t n_keys, gg_error *err)
{
  gg_varied v;
  const size_t n = lists[0].n;
  GG_TRY(new_varied(&v, lists, n_keys, n, err));
  for (size_t k = 0; k < n_keys; k++)
    for (size_t i = 0; i < n; i++) {
      v.value[i * n_keys + k] = lists[k].text[i];
      lists[k].text[i] = NULL;
    }
  return add(sweep, &v, err);
}

static char *draw(const gg_values *v, gg_rng *rng)
{
  char text[40];
  double u = gg_rng_uniform(rng);
  if (!v->range) return strdup(v->text[(size_t)(u * (double)v->n)]);
  const int id = gg_scene_field_find(v->key);
  if (id >= 0 && gg_scene_fields[id].type == GG_FIELD_INTEGER)
    gg_scene_yaml_number(floor(v->low + u * (v->high - v->low + 1)), text);
  else
    snprintf(text, sizeof text, "%.6g", v->low + u * (v->high - v->low)); /* as many digits as people read */
  return strdup(text);
}

static gg_status draw_all(gg_varied *v, const gg_values *lists, uint64_t seed, gg_error *err)
{
  size_t characters = 0;
  for (size_t k = 0; k < v->n_keys; k++) {
    gg_rng rng = gg_common_rng_seed(seed, gg_base_checksum(GG_CHECKSUM_START, lists[k].key, strlen(lists[k].key)));
    for (size_t i = 0; i < v->n; i++) {
      char *text = v->value[i * v->n_keys + k] = draw(&lists[k], &rng);
      if (!text) return gg_base_out_of_memory(err);
      if ((characters += strlen(text)) > MOST_DRAWN_CHARACTERS)
        return GG_REFUSE(err, "key 'vary.random': the values drawn have more than %d characters together",
                         MOST_DRAWN_CHARACTERS);
    }
  }
  return GG_OK;
}

gg_status gg_sweep_add_draws(gg_sweep *sweep, const gg_values *lists, size_t n_keys, size_t n, uint64_t seed,
                             gg_error *err)
{
  gg_varied v;
  GG_TRY(new_varied(&v, lists, n_keys, n, err));
  gg_status status = draw_all(&v, lists, seed, err);
  if (status == GG_OK) return add(sweep, &v, err);
  gg_sweep_varied_clear(&v);
  return status;
}
