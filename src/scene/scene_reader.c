#include "scene/scene_reader.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "scene/yaml_node.h"

static void mark_given(gg_scene *scene, int id)
{
  scene->given |= (uint64_t)1 << id;
}

static gg_status apply(gg_scene_reader *r, const char *key, const yaml_node_t *name, const yaml_node_t *value);

static bool is_for_others(const gg_scene_reader *r, const char *key)
{
  for (const char *const *other = r->others; other && *other; other++)
    if (strcmp(*other, key) == 0) return true;
  return false;
}

static gg_status apply_members(gg_scene_reader *r, const char *section, const yaml_node_t *map)
{
  for (yaml_node_pair_t *i = map->data.mapping.pairs.start; i < map->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const yaml_node_t *value = yaml_document_get_node(r->document, i->value);
    if (name->type != YAML_SCALAR_NODE) return gg_scene_refuse(r, name, section, "a key must be a word");
    char key[96];
    if (!*section && is_for_others(r, (const char *)name->data.scalar.value)) continue;
    snprintf(key, sizeof key, "%.30s%s%.60s", section, *section ? "." : "", (const char *)name->data.scalar.value);
    GG_TRY(apply(r, key, name, value));
  }
  return GG_OK;
}

static gg_status apply(gg_scene_reader *r, const char *key, const yaml_node_t *name, const yaml_node_t *value)
{
  int id = gg_scene_field_find(key);
  if (id >= 0) {
    if (r->seen[id]) return gg_scene_refuse(r, name, key, "is given twice, first on line %d", r->seen[id]);
    r->seen[id] = (int)name->start_mark.line + 1;
    mark_given(r->scene, id);
    return gg_scene_read_value(r, &gg_scene_fields[id], key, value, r->scene);
  }
  if (!gg_scene_is_section(key)) return gg_scene_refuse_key(r, name, key);
  if (value->type != YAML_MAPPING_NODE)
    return gg_scene_refuse(r, value, key, "is a section: its keys go below it, indented");
  return apply_members(r, key, value);
}

/* libyaml's word for what is wrong, with the line. */
static gg_status refuse_syntax(const gg_scene_reader *r, const yaml_parser_t *parser)
{
  if (parser->error == YAML_MEMORY_ERROR || !parser->problem)
    return gg_base_error_prefix(r->err, gg_base_out_of_memory(r->err), "%s", r->name);
  const char *problem = parser->problem;
  size_t line = parser->problem_mark.line + 1;
  if (parser->error == YAML_READER_ERROR)
    return gg_scene_refuse_text(r, 0, "is not a scene: no YAML text (%s at byte %zu)", problem, parser->problem_offset);
  if (parser->unread && *parser->buffer.pointer == '\t')
    return gg_scene_refuse_text(r, line, "is not YAML: a tab cannot indent; use blanks");
  return gg_scene_refuse_text(r, line, "is not YAML: %s%s%s", problem, parser->context ? " " : "",
                              parser->context ? parser->context : "");
}

gg_status gg_scene_with_document(gg_scene_reader *r, const char *yaml, size_t length, const char *key,
                                 gg_scene_use *use)
{
  yaml_parser_t parser;
  yaml_document_t document, next;
  GG_TRY(gg_scene_check_limits(r, yaml, length));
  if (!yaml_parser_initialize(&parser))
    return gg_base_error_prefix(r->err, gg_base_out_of_memory(r->err), "%s", r->name);
  yaml_parser_set_input_string(&parser, (const unsigned char *)yaml, length);
  gg_status status;
  if (!yaml_parser_load(&parser, &document)) {
    status = refuse_syntax(r, &parser);
  } else {
    r->document = &document;
    status = use(r, key, yaml_document_get_root_node(&document));
    if (status == GG_OK && yaml_document_get_root_node(&document)) {
      if (!yaml_parser_load(&parser, &next)) {
        status = refuse_syntax(r, &parser);
      } else {
        if (yaml_document_get_root_node(&next))
          status = gg_scene_refuse_text(r, 0, "holds more than one document; a scene is one");
        yaml_document_delete(&next);
      }
    }
    yaml_document_delete(&document);
  }
  yaml_parser_delete(&parser);
  return status;
}

gg_status gg_scene_read_root(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  if (!root || (root->type == YAML_SCALAR_NODE && root->data.scalar.length == 0))
    return gg_scene_refuse_text(r, 0, "is empty; a scene needs at least flow and phi");
  if (root->type != YAML_MAPPING_NODE)
    return gg_scene_refuse_text(r, root->start_mark.line + 1, "is not a scene: lines of 'key: value' are expected");
  return apply_members(r, key, root);
}

gg_status gg_scene_read(gg_scene *scene, const char *yaml, size_t length, const char *name, gg_error *err)
{
  gg_scene_reader r = {.name = name, .lines = true, .scene = scene, .err = err};
  return gg_scene_with_document(&r, yaml, length, "", gg_scene_read_root);
}

/* "collision.e.12": one pair of a pair-wise coefficient. */
static gg_status set_pair(gg_scene_reader *r, const char *key, const yaml_node_t *root, bool *done)
{
  int pair, id = gg_scene_field_of_pair(key, &pair);
  if (id < 0) return GG_OK;
  *done = true;
  mark_given(r->scene, id);
  char *values = (char *)r->scene + gg_scene_fields[id].offset;
  return gg_scene_read_number(r, &gg_scene_fields[id], key, root, (double *)(void *)values + pair);
}

/* "species.2.mass": one member of one species. */
static gg_status set_species(gg_scene_reader *r, const char *key, const yaml_node_t *root, bool *done)
{
  int number, used = 0;
  if (sscanf(key, "species.%d.%n", &number, &used) != 1 || !used) return GG_OK;
  gg_scene *scene = r->scene;
  *done = true;
  if (number < 1 || number > scene->n_species)
    return gg_scene_refuse(r, root, key, "this scene has %d species", scene->n_species);
  for (const gg_field *f = gg_scene_species_fields; f->key; f++)
    if (strcmp(f->key, key + used) == 0) {
      mark_given(scene, gg_scene_field_find("species"));
      return gg_scene_read_value(r, f, key, root, &scene->species[number - 1]);
    }
  return gg_scene_refuse_key(r, root, key);
}

static gg_status use_override(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  if (!root) return gg_scene_refuse(r, root, key, "no value is given");
  bool done = false;
  GG_TRY(set_pair(r, key, root, &done));
  if (!done) GG_TRY(set_species(r, key, root, &done));
  return done ? GG_OK : apply(r, key, root, root);
}

gg_status gg_scene_override(gg_scene *scene, const char *key, const char *value, gg_error *err)
{
  char word[61], name[80];
  gg_scene changed = *scene;
  gg_scene_quote(key, word, sizeof word);
  snprintf(name, sizeof name, "key '%s'", word);
  gg_scene_reader r = {.name = name, .scene = &changed, .err = err};
  GG_TRY(gg_scene_with_document(&r, value, strlen(value), key, use_override));
  *scene = changed;
  return GG_OK;
}
