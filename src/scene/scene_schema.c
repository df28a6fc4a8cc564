/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of keys as JSON Schema (draft 7), for editors. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/quantity.h"
#include "io/checked_json.h"
#include "scene/fields.h"

/* JSON has no infinity: a limit that is none is left out. */
static void put_limit(json_t *schema, const char *name, const gg_field *f, double limit)
{
  if (!isfinite(limit)) return;
  const bool whole = f->type == GG_FIELD_INTEGER || limit == floor(limit);
  json_object_set_new(schema, name,
                      whole && fabs(limit) < 0x1p63          ? json_integer((json_int_t)limit)
                      : whole && f->type == GG_FIELD_INTEGER ? json_integer(INT64_MAX)
                                                             : json_real(limit));
}

static json_t *number_schema(const gg_field *f)
{
  json_t *schema = json_pack("{s:s}", "type", f->type == GG_FIELD_INTEGER ? "integer" : "number");
  put_limit(schema, f->above_min ? "exclusiveMinimum" : "minimum", f, f->min);
  put_limit(schema, "maximum", f, f->max);
  return schema;
}

static json_t *word_schema(const gg_field *f)
{
  json_t *list = json_array();
  gg_word w;
  for (int i = 0; (w = gg_scene_field_word(f, i)).name; i++)
    json_array_append_new(list, json_pack("{s:s, s:s}", "const", w.name, "description", w.doc ? w.doc : ""));
  return json_pack("{s:o}", "oneOf", list);
}

/* A number, or where the row says so a formula or a table. */
static json_t *one_schema(const gg_field *f)
{
  if (!f->by_speed) return number_schema(f);
  return json_pack("{s:[o, {s:s}, {s:s, s:[s]}]}", "anyOf", number_schema(f), "type", "string", "type", "object",
                   "required", "table");
}

/* Names in a map, as a pattern or as a list of properties, each with a number. */
static json_t *pairs_schema(const gg_field *f)
{
  json_t *map = json_pack("{s:s, s:{s:o}, s:b}", "type", "object", "patternProperties",
                          "^([1-9][0-9]|[0-9]+-[0-9]+|other)$", one_schema(f), "additionalProperties", 0);
  return json_pack("{s:[o, o]}", "anyOf", one_schema(f), map);
}

static json_t *errors_schema(const gg_field *f)
{
  json_t *names = json_object();
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++)
    json_object_set_new(names, gg_common_quantity_name(q), number_schema(f));
  return json_pack("{s:s, s:o, s:b}", "type", "object", "properties", names, "additionalProperties", 0);
}

static json_t *list_schema(const gg_field *f, int least, int most)
{
  return json_pack("{s:s, s:o, s:i, s:i}", "type", "array", "items", number_schema(f), "minItems", least, "maxItems",
                   most);
}

/* Keys of changes are checked by the reader. */
static json_t *changes_schema(void)
{
  return json_pack("{s:s, s:{s:s, s:{s:{s:s, s:i}}, s:[s]}, s:i}", "type", "array", "items", "type", "object",
                   "properties", "at", "type", "number", "exclusiveMinimum", 0, "required", "at", "maxItems",
                   GG_MAX_CHANGES);
}

static json_t *value_schema(const gg_field *f)
{
  switch (f->type) {
  case GG_FIELD_NUMBER:
  case GG_FIELD_INTEGER: return number_schema(f);
  case GG_FIELD_CHOICE: return word_schema(f);
  case GG_FIELD_SET: return json_pack("{s:s, s:o, s:b}", "type", "array", "items", word_schema(f), "uniqueItems", 1);
  case GG_FIELD_PAIRS: return pairs_schema(f);
  case GG_FIELD_ERRORS: return errors_schema(f);
  case GG_FIELD_VECTOR: return list_schema(f, 3, 3);
  case GG_FIELD_ENDS: return json_pack("{s:[o, o]}", "anyOf", number_schema(f), list_schema(f, 2, 2));
  case GG_FIELD_LIST: return list_schema(f, 1, GG_LOCAL_DENSITIES);
  case GG_FIELD_RATE: return json_pack("{s:[o, {s:s}]}", "anyOf", number_schema(f), "type", "string");
  case GG_FIELD_FILE: return json_pack("{s:s}", "type", "string");
  case GG_FIELD_CHANGES: return changes_schema();
  case GG_FIELD_SPECIES:
    return json_pack("{s:s, s:o, s:i, s:i}", "type", "array", "items", gg_scene_schema_of(gg_scene_species_fields),
                     "minItems", 1, "maxItems", (int)f->max);
  }
  return json_object();
}

static json_t *field_schema(const gg_field *f)
{
  char when[256];
  json_t *schema = value_schema(f);
  if (f->special) schema = json_pack("{s:[o, {s:s}]}", "anyOf", schema, "const", f->special);
  gg_scene_field_when(f, when, sizeof when);
  json_object_set_new(schema, "description",
                      json_sprintf("%s%s%s%s%s%s", f->doc, f->unit ? " (" : "", f->unit ? f->unit : "",
                                   f->unit ? ")" : "", *when ? ". Has an effect if: " : "", when));
  return schema;
}

static json_t *map_schema(void)
{
  return json_pack("{s:s, s:{}, s:b}", "type", "object", "properties", "additionalProperties", 0);
}

json_t *gg_scene_schema_of(const gg_field *fields)
{
  json_t *whole = map_schema();
  for (const gg_field *f = fields; f->key; f++) {
    json_t *properties = json_object_get(whole, "properties");
    const char *dot = strchr(f->key, '.');
    if (dot) {
      char section[32];
      snprintf(section, sizeof section, "%.*s", (int)(dot - f->key), f->key);
      if (!json_object_get(properties, section)) json_object_set_new(properties, section, map_schema());
      properties = json_object_get(json_object_get(properties, section), "properties");
    }
    json_object_set_new(properties, dot ? dot + 1 : f->key, field_schema(f));
    if (f->older) {
      json_t *older = field_schema(f);
      json_object_set_new(older, "deprecated", json_true());
      json_object_set_new(json_object_get(whole, "properties"), f->older, older);
    }
  }
  return whole;
}
