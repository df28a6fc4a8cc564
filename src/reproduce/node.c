#include "reproduce/node.h"
#include "scene/fields.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/spelling.h"

gg_status gg_reproduce_entry_refuse(const gg_entry_reader *r, const yaml_node_t *node, const char *key,
                                    const char *format, ...)
{
  char what[512];
  va_list args;
  va_start(args, format);
  vsnprintf(what, sizeof what, format, args);
  va_end(args);
  size_t line = node ? node->start_mark.line + 1 : 1;
  return gg_base_fail(r->err, GG_BAD_INPUT, "%s:%zu: key '%.60s': %s", r->file, line, key, what);
}

static const char *scalar(const yaml_node_t *node)
{
  return node && node->type == YAML_SCALAR_NODE ? (const char *)node->data.scalar.value : NULL;
}

const yaml_node_t *gg_reproduce_entry_get(const gg_entry_reader *r, const yaml_node_t *map, const char *key)
{
  if (!map || map->type != YAML_MAPPING_NODE) return NULL;
  for (yaml_node_pair_t *i = map->data.mapping.pairs.start; i < map->data.mapping.pairs.top; i++) {
    const char *name = scalar(yaml_document_get_node(r->document, i->key));
    if (name && strcmp(name, key) == 0) return yaml_document_get_node(r->document, i->value);
  }
  return NULL;
}

/* Is the word among those, which blanks part? The nearest of them is kept. */
static bool among(const char *word, const char *words, char *nearest, size_t size)
{
  gg_nearest near = {.word = word};
  char one[64];
  nearest[0] = '\0';
  for (const char *at = words; *at; at += strspn(at, " ")) {
    size_t length = strcspn(at, " ");
    snprintf(one, sizeof one, "%.*s", (int)length, at);
    if (strcmp(one, word) == 0) return true;
    size_t before = near.distance;
    const char *best = near.best;
    gg_base_spelling_try(&near, one);
    if (near.best && (near.best != best || near.distance != before)) snprintf(nearest, size, "%s", one);
    at += length;
  }
  return false;
}

gg_status gg_reproduce_entry_keys(const gg_entry_reader *r, const yaml_node_t *map, const char *what, const char *keys)
{
  char nearest[64];
  if (!map || map->type != YAML_MAPPING_NODE)
    return gg_reproduce_entry_refuse(r, map, what, "is a map with the keys %s", keys);
  for (yaml_node_pair_t *i = map->data.mapping.pairs.start; i < map->data.mapping.pairs.top; i++) {
    const yaml_node_t *node = yaml_document_get_node(r->document, i->key);
    const char *name = scalar(node);
    *nearest = '\0';
    if (name && among(name, keys, nearest, sizeof nearest)) {
      if (gg_reproduce_entry_get(r, map, name) != yaml_document_get_node(r->document, i->value))
        return gg_reproduce_entry_refuse(r, node, name, "is given twice");
      continue;
    }
    if (*nearest)
      return gg_reproduce_entry_refuse(r, node, name ? name : "?", "unknown in %s; did you mean %s?", what, nearest);
    return gg_reproduce_entry_refuse(r, node, name ? name : "?", "unknown in %s; allowed: %s", what, keys);
  }
  return GG_OK;
}

gg_status gg_reproduce_entry_text(const gg_entry_reader *r, const yaml_node_t *map, const char *key, const char **text)
{
  const yaml_node_t *node = gg_reproduce_entry_get(r, map, key);
  if (!node) return GG_OK;
  if (!scalar(node)) return gg_reproduce_entry_refuse(r, node, key, "is a text");
  *text = scalar(node);
  return GG_OK;
}

gg_status gg_reproduce_entry_number(const gg_entry_reader *r, const yaml_node_t *map, const char *key, double *number)
{
  const yaml_node_t *node = gg_reproduce_entry_get(r, map, key);
  const char *text = scalar(node);
  char *end = NULL;
  if (!node) return GG_OK;
  errno = 0;
  double value = text ? strtod(text, &end) : NAN;
  if (!text || !*text || *end || errno != 0 || !isfinite(value))
    return gg_reproduce_entry_refuse(r, node, key, "is a number");
  *number = value;
  return GG_OK;
}

gg_status gg_reproduce_entry_flag(const gg_entry_reader *r, const yaml_node_t *map, const char *key, bool *flag)
{
  const yaml_node_t *node = gg_reproduce_entry_get(r, map, key);
  const char *text = scalar(node);
  if (!node) return GG_OK;
  if (!text || (strcmp(text, "true") != 0 && strcmp(text, "false") != 0))
    return gg_reproduce_entry_refuse(r, node, key, "is true or false");
  *flag = *text == 't';
  return GG_OK;
}

gg_status gg_reproduce_entry_formula(const gg_entry_reader *r, const yaml_node_t *map, const char *key,
                                     gg_expression *e)
{
  const char *text = NULL;
  gg_error err;
  GG_TRY(gg_reproduce_entry_text(r, map, key, &text));
  if (!text || gg_reproduce_expression_parse(e, text, &err) == GG_OK) return GG_OK;
  return gg_reproduce_entry_refuse(r, gg_reproduce_entry_get(r, map, key), key, "%s", err.message);
}

static gg_status take_texts(const gg_entry_reader *r, const yaml_node_t *node, const char *key, gg_texts *texts)
{
  texts->n = 0;
  if (scalar(node)) return texts->text[texts->n++] = scalar(node), GG_OK;
  if (node->type != YAML_SEQUENCE_NODE) return gg_reproduce_entry_refuse(r, node, key, "is a text or a list of them");
  for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++) {
    const char *text = scalar(yaml_document_get_node(r->document, *i));
    if (!text) return gg_reproduce_entry_refuse(r, node, key, "is a list of texts");
    if (texts->n == GG_MOST_ABSCISSAE)
      return gg_reproduce_entry_refuse(r, node, key, "has more than %d", GG_MOST_ABSCISSAE);
    texts->text[texts->n++] = text;
  }
  return GG_OK;
}

gg_status gg_reproduce_entry_texts(const gg_entry_reader *r, const yaml_node_t *map, const char *key, gg_texts *texts)
{
  const yaml_node_t *node = gg_reproduce_entry_get(r, map, key);
  return node ? take_texts(r, node, key, texts) : GG_OK;
}

gg_status gg_reproduce_entry_conditions(const gg_entry_reader *r, const yaml_node_t *map, const char *key,
                                        gg_conditions *all)
{
  const yaml_node_t *node = gg_reproduce_entry_get(r, map, key);
  if (!node) return GG_OK;
  if (node->type != YAML_MAPPING_NODE) return gg_reproduce_entry_refuse(r, node, key, "is a map of scene keys");
  for (yaml_node_pair_t *i = node->data.mapping.pairs.start; i < node->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    if (all->n == GG_MOST_CONDITIONS_OF) return gg_reproduce_entry_refuse(r, node, key, "has too many keys");
    gg_condition_of *one = &all->of[all->n++];
    one->key = scalar(name);
    if (!one->key || !gg_scene_key_exists(one->key))
      return gg_reproduce_entry_refuse(r, name, one->key ? one->key : "?", "is no key of a scene");
    GG_TRY(take_texts(r, yaml_document_get_node(r->document, i->value), one->key, &one->values));
  }
  return GG_OK;
}
