#include "sweep/values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene/fields.h"
#include "sweep/sweep.h"

void gg_sweep_values_clear(gg_values *v)
{
  for (size_t i = 0; i < v->n; i++) free(v->text[i]);
  free(v->text);
  *v = (gg_values){0};
}

static gg_status out_of_memory(gg_error *err)
{
  return gg_base_out_of_memory(err);
}

gg_status gg_sweep_values_add(gg_values *v, const char *text, gg_error *err)
{
  if (v->n == GG_MOST_POINTS)
    return gg_base_fail(err, GG_BAD_INPUT, "a key has more than %d values; a sweep has at most as many points",
                        GG_MOST_POINTS);
  v->characters += strlen(text);
  if (v->characters > GG_MOST_VALUE_CHARACTERS)
    return gg_base_fail(err, GG_BAD_INPUT, "the values of a key have more than %d characters together",
                        GG_MOST_VALUE_CHARACTERS);
  if (v->n == v->room) {
    size_t room = v->room ? 2 * v->room : 8;
    char **grown = realloc(v->text, room * sizeof *grown);
    if (!grown) return out_of_memory(err);
    v->text = grown;
    v->room = room;
  }
  v->text[v->n] = strdup(text);
  return v->text[v->n] ? v->n++, GG_OK : out_of_memory(err);
}

/* All of the text is one number. */
static bool is_number(const char *text, size_t length, double *value)
{
  char word[40], *end;
  if (length == 0 || length >= sizeof word) return false;
  memcpy(word, text, length);
  word[length] = '\0';
  if (word[strspn(word, "0123456789+-.eE")]) return false;
  *value = strtod(word, &end);
  return !*end && isfinite(*value);
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
    gg_scene_number_format(strtod(text, NULL), text, sizeof text);
    GG_TRY(gg_sweep_values_add(v, text, err));
  }
  return GG_OK;
}

static gg_status add_range(gg_values *v, const char *key, const char *text, bool *is, gg_error *err)
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
      return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': '%.60s': a range is first:last:step", key, text);
    at += k < 2;
  }
  *is = true;
  double steps = x[2] != 0 ? (x[1] - x[0]) / x[2] : -1;
  if (!(steps >= 0))
    return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': '%.60s': the step does not lead from the first to the last",
                        key, text);
  const bool whole = x[0] == floor(x[0]) && x[2] == floor(x[2]);
  const double largest = fmax(fabs(x[0]), fabs(x[1]));
  if (whole ? largest >= 0x1p53 : fabs(x[2]) < 1e-11 * largest)
    return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': '%.60s': the step is lost in the digits of the numbers", key,
                        text);
  if (steps >= GG_MOST_POINTS)
    return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': '%.60s': these are %.0f values; a sweep has at most %d points",
                        key, text, floor(steps) + 1, GG_MOST_POINTS);
  return add_steps(v, x[0], x[2], (size_t)(steps * (1 + 1e-12) + 1e-9) + 1, err);
}

static gg_status take_span(gg_values *v, const char *key, const char *text, bool *is, gg_error *err)
{
  const char *dots = strstr(text, "..");
  *is = dots && is_number(text, (size_t)(dots - text), &v->low) && is_number(dots + 2, strlen(dots + 2), &v->high);
  if (!*is) return GG_OK;
  if (!(v->low < v->high))
    return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': '%.60s': the lower end has to come first", key, text);
  v->range = true;
  return GG_OK;
}

static gg_status add_word(gg_values *v, const char *key, const char *text, gg_error *err)
{
  bool is;
  GG_TRY(add_range(v, key, text, &is, err));
  if (is) return GG_OK;
  if (!*text) return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': a value is missing", key);
  return gg_sweep_values_add(v, text, err);
}

/* Up to the next comma that does not stand in brackets or quotes. */
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

gg_status gg_sweep_values_parse(gg_values *v, const char *key, const char *text, gg_error *err)
{
  bool is;
  GG_TRY(take_span(v, key, text, &is, err));
  while (!is) {
    text += strspn(text, " ");
    size_t length = word_length(text), used = length;
    while (used && text[used - 1] == ' ') used--;
    char *word = strndup(text, used);
    gg_status status = word ? add_word(v, key, word, err) : out_of_memory(err);
    free(word);
    if (status != GG_OK || !text[length]) return status;
    text += length + 1;
  }
  return GG_OK;
}

static bool is_whole(const char *key)
{
  int id = gg_scene_field_find(key);
  return id >= 0 && gg_scene_fields[id].type == GG_FIELD_INTEGER;
}

char *gg_sweep_values_draw(const gg_values *v, const char *key, gg_rng *rng)
{
  char text[40];
  double u = gg_rng_uniform(rng);
  if (!v->range) return strdup(v->text[(size_t)(u * (double)v->n)]);
  if (is_whole(key))
    gg_scene_number_format(floor(v->low + u * (v->high - v->low + 1)), text, sizeof text);
  else
    snprintf(text, sizeof text, "%.6g", v->low + u * (v->high - v->low)); /* as many digits as people read */
  return strdup(text);
}
