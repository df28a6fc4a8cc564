/* The map `sweep` of a sweep's file: rows as those of scenes, read and refused likewise. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "scene/yaml_node.h"
#include "sweep/settings.h"

static const gg_word does[] = {{"run", GG_DOES_RUN, "one engine, the scene's"},
                               {"compare", GG_DOES_COMPARE, "both engines and the theories"},
                               {"theory", GG_DOES_THEORY, "the theories alone"},
                               {0}};
static const gg_word seeds[] = {
    {"independent", GG_SEEDS_INDEPENDENT, "each point its own, made of run.seed and of what is simulated there"},
    {"common", GG_SEEDS_COMMON, "run.seed for all"},
    {0}};

#define AT(member) offsetof(gg_sweep_settings, member)

const gg_field gg_sweep_fields[] = {
    {"sweep.does", GG_FIELD_CHOICE, AT(does), .words = does, .doc = "what is done at each point"},
    {"sweep.seeds", GG_FIELD_CHOICE, AT(seeds), .words = seeds, .doc = "seeds of the points' random streams"},
    {"sweep.at_once", GG_FIELD_INTEGER, AT(at_once), 1, 1000, .special = "auto", .special_value = 0,
     .doc = "points in progress at a time, among which work goes to the one with the largest error; auto: twice as "
            "many as threads"},
    {"sweep.longest", GG_FIELD_NUMBER, AT(longest), 0, 1e9, true, .special = "none", .special_value = INFINITY,
     .unit = "s",
     .doc = "processor time that a replica should take at most: where run.replicas is not given, points that are "
            "expected to take longer get more of them"},
    {0}};

gg_sweep_settings gg_sweep_settings_defaults(void)
{
  return (gg_sweep_settings){.longest = 600};
}

static const gg_field *find(const char *key)
{
  for (const gg_field *f = gg_sweep_fields; f->key; f++)
    if (strcmp(f->key, key) == 0) return f;
  return NULL;
}

static gg_status refuse(const gg_scene_reader *r, const yaml_node_t *node, const char *key)
{
  char known[200] = "";
  for (const gg_field *f = gg_sweep_fields; f->key; f++) {
    size_t used = strlen(known);
    snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", strchr(f->key, '.') + 1);
  }
  return gg_scene_refuse(r, node, key, "no such key; under sweep there are %s", known);
}

static gg_status apply(gg_scene_reader *r, gg_sweep_settings *settings, const char *key, const yaml_node_t *name,
                       const yaml_node_t *value)
{
  const gg_field *f = find(key);
  if (!f) return refuse(r, name, key);
  return gg_scene_read_value(r, f, key, value, settings);
}

gg_status gg_sweep_settings_read(gg_scene_reader *r, const yaml_node_t *map, gg_sweep_settings *settings)
{
  unsigned seen = 0;
  if (map->type != YAML_MAPPING_NODE)
    return gg_scene_refuse(r, map, "sweep", "is a section: its keys go below it, indented");
  for (yaml_node_pair_t *i = map->data.mapping.pairs.start; i < map->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const yaml_node_t *value = yaml_document_get_node(r->document, i->value);
    char key[80];
    if (name->type != YAML_SCALAR_NODE) return gg_scene_refuse(r, name, "sweep", "a key must be a word");
    snprintf(key, sizeof key, "sweep.%.60s", (const char *)name->data.scalar.value);
    const gg_field *f = find(key);
    if (f && seen & 1u << (f - gg_sweep_fields)) return gg_scene_refuse(r, name, key, "is given twice");
    if (f) seen |= 1u << (f - gg_sweep_fields);
    GG_TRY(apply(r, settings, key, name, value));
  }
  return GG_OK;
}

/* A reader with what its use needs besides. */
typedef struct setting {
  gg_scene_reader reader;
  gg_sweep_settings *settings;
} setting;

static gg_status use_value(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  if (!root) return gg_scene_refuse(r, root, key, "no value is given");
  return apply(r, ((setting *)(void *)r)->settings, key, root, root);
}

gg_status gg_sweep_settings_set(gg_sweep_settings *settings, const char *key, const char *value, gg_error *err)
{
  char word[61], name[80];
  gg_sweep_settings changed = *settings;
  gg_scene_quote(key, word, sizeof word);
  snprintf(name, sizeof name, "key '%s'", word);
  setting s = {{.name = name, .err = err}, &changed};
  GG_TRY(gg_scene_with_document(&s.reader, value, strlen(value), key, use_value));
  *settings = changed;
  return GG_OK;
}
