/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "common/quantity.h"
#include "io/checked_json.h"

static json_t *number_json(const gg_field *f, double value)
{
  char text[GG_NUMBER_TEXT];
  if (f->special && value == f->special_value) return json_string(f->special);
  if (!isfinite(value)) return gg_io_number_format(value, text), json_string(text);
  if (value == floor(value) && fabs(value) < 1e15) return json_integer((json_int_t)value);
  return json_real(value);
}

static json_t *integer_json(const gg_field *f, int64_t value)
{
  return f->special && (double)value == f->special_value ? json_string(f->special) : json_integer(value);
}

static json_t *choice_json(const gg_field *f, const void *at)
{
  int value;
  memcpy(&value, at, sizeof value);
  const gg_word word = gg_scene_field_word_for(f, value);
  return word.name ? json_string(word.name) : json_null();
}

static json_t *set_json(const gg_field *f, unsigned set)
{
  json_t *list = json_array();
  gg_word w;
  for (int i = 0; (w = gg_scene_field_word(f, i)).name; i++)
    if (set & (unsigned)w.value) json_array_append_new(list, json_string(w.name));
  return list;
}

/* A formula, or a table as its rows. */
static json_t *law_json(const char *text)
{
  double v, x;
  int used;
  if (sscanf(text, "table %lf %lf;%n", &v, &x, &used) != 2) return json_string(text);
  json_t *rows = json_array();
  for (text += strlen("table "); sscanf(text, "%lf %lf;%n", &v, &x, &used) == 2; text += used)
    json_array_append_new(rows, json_pack("[f, f]", v, x));
  return json_pack("{s:o}", "table", rows);
}

/* One of the numbers of a field, or what stands in its place. */
static json_t *one_json(const gg_field *f, const double *x, const gg_scene *scene, int p)
{
  const char *law = gg_scene_field_law(f, scene, p);
  return law ? law_json(law) : number_json(f, x[p]);
}

static bool are_same(const gg_field *f, const double *x, const gg_scene *scene, int p, int q)
{
  return x[p] == x[q] && gg_scene_field_law(f, scene, p) == gg_scene_field_law(f, scene, q);
}

/* A pair with the commonest value, written as `other`; on a tie the last pair. */
static int commonest(const gg_field *f, const double *x, const gg_scene *scene)
{
  int most = 0, best = GG_PAIRS - 1;
  for (int p = GG_PAIRS - 1; p >= 0 && 2 * most < GG_PAIRS; p--) {
    int n = 0;
    for (int q = 0; q < GG_PAIRS; q++) n += are_same(f, x, scene, p, q);
    if (n > most) most = n, best = p;
  }
  return best;
}

/* Up to two species all three pairs are written; for more species those unlike the rest. */
static json_t *pairs_json(const gg_field *f, const double *x, const gg_scene *scene)
{
  const gg_scene defaults = gg_scene_defaults();
  const double usual = *(const double *)(const void *)((const char *)&defaults + f->offset);
  const int rest = commonest(f, x, scene);
  const int used = gg_pairs_of(scene->n_species > 2 ? scene->n_species : 2), shown = scene->n_species > 2 ? 0 : used;
  bool alike = true;
  json_t *map = json_object();
  for (int p = 0; p < GG_PAIRS; p++) {
    char name[GG_PAIR_NAME];
    alike = alike && (p >= used || are_same(f, x, scene, p, GG_11));
    if (p < shown || !are_same(f, x, scene, p, rest))
      json_object_set_new(map, gg_common_pair_name(p, name), one_json(f, x, scene, p));
  }
  if (x[rest] != usual || gg_scene_field_law(f, scene, rest) || json_object_size(map) < (size_t)used)
    json_object_set_new(map, "other", one_json(f, x, scene, rest));
  if (!alike) return map;
  json_decref(map);
  return one_json(f, x, scene, GG_11);
}

static json_t *errors_json(const gg_field *f, const double *x)
{
  json_t *map = json_object();
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++)
    if (x[q] > 0) json_object_set_new(map, gg_common_quantity_name(q), json_real(x[q]));
  if (json_object_size(map) > 0) return map;
  json_decref(map);
  return json_string(f->special);
}

static json_t *numbers_json(const gg_field *f, const double *x, size_t n)
{
  json_t *list = json_array();
  for (size_t i = 0; i < n; i++) json_array_append_new(list, number_json(f, x[i]));
  return list;
}

static json_t *list_json(const gg_field *f, const double *x)
{
  size_t n = 0;
  while (n < gg_scene_field_count(f) && x[n] > 0) n++;
  return n ? numbers_json(f, x, n) : json_string(f->special);
}

static json_t *species_json(const gg_scene *scene)
{
  json_t *list = json_array();
  for (int i = 0; i < scene->n_species; i++) {
    json_t *one = json_object();
    for (const gg_field *f = gg_scene_species_fields; f->key; f++)
      json_object_set_new(one, f->key, gg_scene_field_json(f, &scene->species[i], scene));
    json_array_append_new(list, one);
  }
  return list;
}

/* The text of a change is a number, a word, or a formula in quotes. */
static json_t *changes_json(const gg_scene *scene)
{
  static const gg_field number = {.type = GG_FIELD_NUMBER};
  json_t *list = json_array();
  for (const gg_change *c = scene->protocol; c < scene->protocol + GG_MAX_CHANGES && *c->key; c++) {
    char *end;
    const double x = strtod(c->value, &end);
    json_t *value = !*end                             ? number_json(&number, x)
                    : strncmp(c->value, "\"", 1) == 0 ? gg_io_json_made(json_loads(c->value, JSON_DECODE_ANY, NULL))
                                                      : json_string(c->value);
    json_array_append_new(list, json_pack("{s:f, s:o}", "at", c->at, c->key, value));
  }
  return list;
}

static json_t *value_json(const gg_field *f, const void *base, const gg_scene *scene)
{
  const void *at = (const char *)base + f->offset;
  switch (f->type) {
  case GG_FIELD_NUMBER: return one_json(f, at, scene, 0);
  case GG_FIELD_INTEGER: return integer_json(f, *(const int64_t *)at);
  case GG_FIELD_CHOICE: return choice_json(f, at);
  case GG_FIELD_SET: return set_json(f, *(const unsigned *)at);
  case GG_FIELD_PAIRS: return pairs_json(f, at, scene);
  case GG_FIELD_ERRORS: return errors_json(f, at);
  case GG_FIELD_VECTOR: return numbers_json(f, at, 3);
  case GG_FIELD_LIST: return list_json(f, at);
  case GG_FIELD_RATE: {
    const char *formula = (const char *)at + sizeof(double);
    return *formula ? json_string(formula) : number_json(f, *(const double *)at);
  }
  case GG_FIELD_FILE: return json_string(*(const char *)at ? at : f->special);
  case GG_FIELD_ENDS:
    return memcmp(at, (const double *)at + 1, sizeof(double)) ? numbers_json(f, at, 2)
                                                              : number_json(f, *(const double *)at);
  case GG_FIELD_CHANGES: return changes_json(scene);
  case GG_FIELD_SPECIES: return species_json(scene);
  }
  return json_null();
}

json_t *gg_scene_field_json(const gg_field *f, const void *base, const gg_scene *scene)
{
  const unsigned before = gg_base_memory_failures();
  return gg_io_json_end(before, value_json(f, base, scene));
}

json_t *gg_scene_key_json(const gg_scene *scene, const char *key)
{
  gg_field member;
  return gg_scene_key_find(key, scene->n_species, &member) >= 0 ? gg_scene_field_json(&member, scene, scene) : NULL;
}

static json_t *section_of(json_t *root, const char *name)
{
  json_t *section = json_object_get(root, name);
  if (section) return section;
  section = json_object();
  return json_object_set_new(root, name, section) == 0 ? section : NULL;
}

json_t *gg_scene_json(const gg_scene *scene)
{
  const unsigned before = gg_base_memory_failures();
  json_t *root = json_object();
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    json_t *into = root;
    const char *dot = strchr(f->key, '.'), *name = dot ? dot + 1 : f->key;
    if (dot) {
      char section[32];
      snprintf(section, sizeof section, "%.*s", (int)(dot - f->key), f->key);
      into = section_of(root, section);
    }
    json_object_set_new(into, name, gg_scene_field_json(f, scene, scene));
  }
  return gg_io_json_end(before, root);
}

static void print_flow_style(FILE *out, const json_t *value)
{
  char text[GG_NUMBER_TEXT];
  const char *key;
  json_t *member;
  size_t i = 0;
  switch (json_typeof(value)) {
  case JSON_REAL: gg_scene_yaml_number(json_real_value(value), text), fputs(text, out); return;
  case JSON_INTEGER: fprintf(out, "%" JSON_INTEGER_FORMAT, json_integer_value(value)); return;
  case JSON_STRING: gg_scene_yaml_text_print(out, json_string_value(value)); return;
  case JSON_ARRAY:
    fputc('[', out);
    json_array_foreach(value, i, member) fputs(i ? ", " : "", out), print_flow_style(out, member);
    fputc(']', out);
    return;
  case JSON_OBJECT:
    fputc('{', out);
    json_object_foreach((json_t *)(uintptr_t)value, key, member)
    {
      fprintf(out, "%s%s: ", i++ ? ", " : "", key);
      print_flow_style(out, member);
    }
    fputc('}', out);
    return;
  default: fputs("null", out);
  }
}

void gg_scene_flow_style_text(const json_t *value, char *text, size_t size)
{
  char *whole = NULL;
  FILE *out = gg_base_memory_stream_open(&whole);
  if (out && value) print_flow_style(out, value);
  if (gg_base_memory_stream_close(out, &whole)) snprintf(text, size, "%s", whole);
  free(whole);
}

static bool is_pairs(const json_t *value)
{
  const char *key = json_object_iter_key(json_object_iter((json_t *)(uintptr_t)value));
  return key && (gg_common_pair_find(key) >= 0 || strcmp(key, "other") == 0 || strcmp(key, "table") == 0);
}

static void print_line(FILE *out, const char *indent, const char *key, const json_t *value)
{
  fprintf(out, "%s%s: ", indent, key);
  print_flow_style(out, value);
  fputc('\n', out);
}

void gg_scene_yaml_print(FILE *out, const json_t *root)
{
  const char *key;
  json_t *value;
  json_object_foreach((json_t *)(uintptr_t)root, key, value)
  {
    const bool section = json_is_object(value) && !is_pairs(value);
    if (section)
      fprintf(out, "%s:\n", key);
    else
      print_line(out, "", key, value);
    for (void *i = section ? json_object_iter(value) : NULL; i; i = json_object_iter_next(value, i))
      print_line(out, "  ", json_object_iter_key(i), json_object_iter_value(i));
  }
}

char *gg_scene_yaml(const gg_scene *scene)
{
  char *text = NULL;
  FILE *out = gg_base_memory_stream_open(&text);
  if (!out) return NULL;
  json_auto_t *root = gg_scene_json(scene);
  if (root) gg_scene_yaml_print(out, root);
  bool whole = root && !ferror(out);
  if (gg_base_memory_stream_close(out, &text) && whole) return text;
  free(text);
  return NULL;
}
