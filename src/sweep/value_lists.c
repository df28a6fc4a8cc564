#include "sweep/value_lists.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"

void gg_sweep_value_lists_clear(gg_columns *c)
{
  for (size_t k = 0; k < c->n; k++) gg_sweep_values_clear(&c->values[k]);
}

/* Characters of a value: an alias may stand in what it stands for, and that has no end. */
enum { LONGEST_VALUE = 10000 };

/* A node as YAML on one line; cut where it is too long. */
static void print_node(gg_scene_reader *r, const yaml_node_t *node, FILE *out)
{
  if (ftell(out) > LONGEST_VALUE) return;
  if (node->type == YAML_SCALAR_NODE) {
    const char *text = (const char *)node->data.scalar.value;
    bool plain = node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    if (plain) fputs(text, out);
    if (!plain) fputc('\'', out);
    for (; !plain && *text; text++) fputs(*text == '\'' ? "''" : (char[]){*text, '\0'}, out);
    if (!plain) fputc('\'', out);
  } else if (node->type == YAML_SEQUENCE_NODE) {
    fputc('[', out);
    for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++) {
      if (i != node->data.sequence.items.start) fputs(", ", out);
      print_node(r, yaml_document_get_node(r->document, *i), out);
    }
    fputc(']', out);
  } else if (node->type == YAML_MAPPING_NODE) {
    fputc('{', out);
    for (yaml_node_pair_t *i = node->data.mapping.pairs.start; i < node->data.mapping.pairs.top; i++) {
      if (i != node->data.mapping.pairs.start) fputs(", ", out);
      print_node(r, yaml_document_get_node(r->document, i->key), out);
      fputs(": ", out);
      print_node(r, yaml_document_get_node(r->document, i->value), out);
    }
    fputc('}', out);
  }
}

static gg_status add_node(gg_scene_reader *r, const char *key, gg_values *values, const yaml_node_t *node)
{
  char *text = NULL;
  FILE *out = gg_base_memory_stream_open(&text);
  if (out) print_node(r, node, out);
  gg_status status = gg_base_memory_stream_close(out, &text)
                         ? GG_OK
                         : gg_base_error_prefix(r->err, gg_base_out_of_memory(r->err), "%s", r->name);
  if (status == GG_OK && strlen(text) > LONGEST_VALUE)
    status = gg_scene_refuse(r, node, key, "a value is longer than %d characters", LONGEST_VALUE);
  if (status == GG_OK) status = gg_sweep_values_add(values, text, r->err);
  free(text);
  return status;
}

static bool is_plain(const yaml_node_t *node)
{
  return node->type == YAML_SCALAR_NODE && node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
}

/* A message of gg_values_..., with the file and the line before it. */
gg_status gg_sweep_place(const gg_scene_reader *r, const yaml_node_t *node, gg_status status)
{
  if (status == GG_OK || status == GG_FAILED) return status;
  return gg_base_error_prefix(r->err, status, "%s:%zu", r->name, node->start_mark.line + 1);
}

static gg_status read_values(gg_scene_reader *r, const char *key, const yaml_node_t *node, gg_values *values)
{
  if (is_plain(node))
    return gg_sweep_place(r, node, gg_sweep_values_parse(values, key, (const char *)node->data.scalar.value, r->err));
  if (node->type != YAML_SEQUENCE_NODE) return add_node(r, key, values, node);
  for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++) {
    const yaml_node_t *item = yaml_document_get_node(r->document, *i);
    if (is_plain(item))
      GG_TRY(
          gg_sweep_place(r, item, gg_sweep_values_parse(values, key, (const char *)item->data.scalar.value, r->err)));
    else
      GG_TRY(add_node(r, key, values, item));
  }
  if (values->range && values->n) return gg_scene_refuse(r, node, key, "is either drawn from LOW..HIGH or from a list");
  if (!values->n && !values->range) return gg_scene_refuse(r, node, key, "has no values");
  return GG_OK;
}

static gg_status read_map(gg_scene_reader *r, const char *section, const yaml_node_t *map, gg_columns *c);

static gg_status read_column(gg_scene_reader *r, const char *key, const yaml_node_t *name, const yaml_node_t *node,
                             gg_columns *c)
{
  if (strcmp(key, "random") == 0) return c->random = node, GG_OK;
  if (gg_scene_is_section(key) && gg_scene_field_find(key) < 0 && node->type == YAML_MAPPING_NODE)
    return read_map(r, key, node, c);
  if (c->n == GG_MOST_VARIED) return gg_scene_refuse(r, name, key, "more than %d keys are varied", GG_MOST_VARIED);
  size_t k = c->n++;
  snprintf(c->key[k], sizeof c->key[k], "%s", key);
  c->node[k] = node;
  return read_values(r, key, node, &c->values[k]);
}

static gg_status read_map(gg_scene_reader *r, const char *section, const yaml_node_t *map, gg_columns *c)
{
  for (yaml_node_pair_t *i = map->data.mapping.pairs.start; i < map->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    char key[96];
    if (name->type != YAML_SCALAR_NODE) return gg_scene_refuse(r, name, "vary", "a key must be a word");
    snprintf(key, sizeof key, "%.30s%s%.60s", section, *section ? "." : "", (const char *)name->data.scalar.value);
    GG_TRY(read_column(r, key, name, yaml_document_get_node(r->document, i->value), c));
  }
  return GG_OK;
}

gg_status gg_sweep_value_lists_read(gg_scene_reader *r, const yaml_node_t *map, gg_columns *c)
{
  if (map->type == YAML_MAPPING_NODE) return read_map(r, "", map, c);
  return gg_scene_refuse(r, map, "vary", "keys with their values are expected: vary: {phi: [0.1, 0.2]}");
}
