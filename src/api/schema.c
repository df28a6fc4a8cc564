/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON Schema of scenes and sweeps; templates of scenes. */
#include "api/api.h"
#include "base/memory.h"
#include "io/checked_json.h"
#include "scene/fields.h"
#include "sweep/sweep.h"

/* The keys of `vary` as patterns: "phi", "collision.e.12", "species.2.mass". */
static json_t *varied_schema(void)
{
  json_t *names = json_array();
  json_array_append_new(names, json_string("random"));
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (f->type != GG_FIELD_SPECIES) json_array_append_new(names, json_string(f->key));
  json_t *map = json_pack("{s:s, s:{s:[{s:o}, {s:s}]}}", "type", "object", "propertyNames", "anyOf", "enum", names,
                          "pattern", "^(collision\\.(e|beta|mu)|run\\.until|species\\.[0-9]+)\\.[A-Za-z0-9_-]+$");
  return json_pack("{s:s, s:[O, {s:s, s:o}]}", "description",
                   "Sweeps only: values of keys, as FIRST:LAST:STEP, a list, or LOW..HIGH beside random: {points: "
                   "100}. Every combination is a point; in a list of maps the keys of one map change together.",
                   "anyOf", map, "type", "array", "items", map);
}

gg_status gg_scene_begin(const char *flow, char **text, gg_error *err)
{
  GG_NEED(flow, text);
  gg_field f;
  gg_scene_key_find("flow", 1, &f);
  const gg_word word = gg_scene_field_find_word(&f, flow);
  if (!word.name) {
    char allowed[400];
    gg_scene_field_allowed(&f, allowed, sizeof allowed);
    return GG_REFUSE(err, "there is no flow '%.60s': %s", flow, allowed);
  }
  *text = gg_scene_template((gg_flow)word.value);
  return *text ? GG_OK : gg_base_out_of_memory(err);
}

gg_status gg_schema_to_json(char **text, gg_error *err)
{
  GG_NEED(text);
  const unsigned before = gg_base_memory_failures();
  json_t *schema = gg_scene_schema_of(gg_scene_fields), *properties = json_object_get(schema, "properties");
  json_object_set_new(properties, "sweep", gg_sweep_settings_schema());
  json_object_set_new(properties, "vary", varied_schema());
  json_object_set_new(properties, "theories",
                      json_pack("{s:s, s:s}", "type", "object", "description",
                                "Theories of your own: name: {quantity: formula}, or name: table.csv"));
  json_object_update_new(schema,
                         json_pack("{s:s, s:s, s:[s], s:[{s:[s]}, {s:[s]}]}", "$schema",
                                   "http://json-schema.org/draft-07/schema#", "title", "A scene or a sweep of graingas",
                                   "required", "flow", "anyOf", "required", "phi", "required", "vary"));
  return gg_api_text_copy(gg_io_json_end(before, schema), text, err);
}
