/* A sweep from YAML: the scene's keys, and beside them `vary` and `sweep`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/checksum.h"
#include "io/scene/reader.h"
#include "sweep/settings.h"
#include "sweep/values.h"

void gg_varied_clear(gg_varied *v)
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

static gg_status check_new(const gg_sweep *sweep, const gg_varied *v, gg_error *err)
{
  if (sweep->n_varied == GG_MOST_VARIED)
    return gg_fail(err, GG_BAD_INPUT, "more than %d keys are varied", GG_MOST_VARIED);
  for (size_t k = 0; k < v->n_keys; k++) {
    if (gg_sweep_varies(sweep, v->key[k])) return gg_fail(err, GG_BAD_INPUT, "key '%.60s': is varied twice", v->key[k]);
    for (size_t j = 0; j < k; j++)
      if (strcmp(v->key[j], v->key[k]) == 0)
        return gg_fail(err, GG_BAD_INPUT, "key '%.60s': is varied twice", v->key[k]);
  }
  return GG_OK;
}

gg_status gg_sweep_add(gg_sweep *sweep, gg_varied *v, gg_error *err)
{
  gg_status status = check_new(sweep, v, err);
  if (status == GG_OK) {
    sweep->varied[sweep->n_varied++] = *v;
    *v = (gg_varied){0};
  }
  gg_varied_clear(v);
  return status;
}

/* One map of varied keys, as it is read. */
typedef struct columns {
  size_t n;
  char key[GG_MOST_VARIED][96];
  gg_values values[GG_MOST_VARIED];
  const yaml_node_t *node[GG_MOST_VARIED];
  const yaml_node_t *random; /* the map that asks for random draws; NULL: none */
} columns;

static void clear_columns(columns *c)
{
  for (size_t k = 0; k < c->n; k++) gg_values_clear(&c->values[k]);
}

/* A node as YAML on one line. */
static void print_node(gg_scene_reader *r, const yaml_node_t *node, FILE *out)
{
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

static gg_status add_node(gg_scene_reader *r, gg_values *values, const yaml_node_t *node)
{
  char *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (out) print_node(r, node, out);
  gg_status status = out && fclose(out) == 0 ? gg_values_add(values, text, r->err)
                                             : gg_fail(r->err, GG_FAILED, "%s: out of memory", r->name);
  free(text);
  return status;
}

static bool is_plain(const yaml_node_t *node)
{
  return node->type == YAML_SCALAR_NODE && node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
}

/* A message of gg_values_..., with the file and the line before it. */
static gg_status place(const gg_scene_reader *r, const yaml_node_t *node, gg_status status)
{
  if (status == GG_OK || status == GG_FAILED) return status;
  return gg_error_prefix(r->err, status, "%s:%zu", r->name, node->start_mark.line + 1);
}

static gg_status read_values(gg_scene_reader *r, const char *key, const yaml_node_t *node, gg_values *values)
{
  if (is_plain(node))
    return place(r, node, gg_values_parse(values, key, (const char *)node->data.scalar.value, r->err));
  if (node->type != YAML_SEQUENCE_NODE) return add_node(r, values, node);
  for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++) {
    const yaml_node_t *item = yaml_document_get_node(r->document, *i);
    if (is_plain(item))
      GG_TRY(place(r, item, gg_values_parse(values, key, (const char *)item->data.scalar.value, r->err)));
    else
      GG_TRY(add_node(r, values, item));
  }
  if (values->range && values->n) return gg_scene_refuse(r, node, key, "is either drawn from LOW..HIGH or from a list");
  if (!values->n && !values->range) return gg_scene_refuse(r, node, key, "has no values");
  return GG_OK;
}

static gg_status read_map(gg_scene_reader *r, const char *section, const yaml_node_t *map, columns *c);

static gg_status read_column(gg_scene_reader *r, const char *key, const yaml_node_t *name, const yaml_node_t *node,
                             columns *c)
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

static gg_status read_map(gg_scene_reader *r, const char *section, const yaml_node_t *map, columns *c)
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

static gg_status new_varied(gg_varied *v, const columns *c, size_t first, size_t n_keys, size_t n, gg_error *err)
{
  *v = (gg_varied){.n_keys = n_keys, .n = n};
  v->key = gg_new_array(n_keys, sizeof *v->key, err);
  v->value = gg_new_array(n_keys * n, sizeof *v->value, err);
  bool good = v->key && v->value;
  for (size_t k = 0; good && k < n_keys; k++) good = (v->key[k] = strdup(c->key[first + k]));
  if (good) return GG_OK;
  gg_varied_clear(v);
  return gg_fail(err, GG_FAILED, "out of memory");
}

/* Keys of the map from `first` on, row by row. */
static gg_status add_rows(gg_sweep *sweep, columns *c, size_t first, size_t n_keys, gg_error *err)
{
  gg_varied v;
  size_t n = c->values[first].n;
  GG_TRY(new_varied(&v, c, first, n_keys, n, err));
  for (size_t k = 0; k < n_keys; k++)
    for (size_t i = 0; i < n; i++) {
      v.value[i * n_keys + k] = c->values[first + k].text[i];
      c->values[first + k].text[i] = NULL;
    }
  return gg_sweep_add(sweep, &v, err);
}

static gg_status refuse_range(gg_scene_reader *r, const columns *c)
{
  for (size_t k = 0; k < c->n; k++)
    if (c->values[k].range)
      return gg_scene_refuse(r, c->node[k], c->key[k],
                             "LOW..HIGH is for random draws: say how many, vary: {random: {points: 100}, ...}; a grid "
                             "has first:last:step or a list");
  return GG_OK;
}

/* The same length for all, as they go together. */
static gg_status add_zipped(gg_scene_reader *r, gg_sweep *sweep, columns *c)
{
  GG_TRY(refuse_range(r, c));
  for (size_t k = 1; k < c->n; k++)
    if (c->values[k].n != c->values[0].n)
      return gg_scene_refuse(r, c->node[k], c->key[k],
                             "has %zu values, and %s, which goes with it, has %zu; keys of one map in a list change "
                             "together",
                             c->values[k].n, c->key[0], c->values[0].n);
  return c->n ? place(r, c->node[0], add_rows(sweep, c, 0, c->n, r->err)) : GG_OK;
}

static gg_status add_grid(gg_scene_reader *r, gg_sweep *sweep, columns *c)
{
  GG_TRY(refuse_range(r, c));
  for (size_t k = 0; k < c->n; k++) GG_TRY(place(r, c->node[k], add_rows(sweep, c, k, 1, r->err)));
  return GG_OK;
}

typedef struct draws {
  int64_t points, seed;
} draws;
static const gg_field draws_fields[] = {
    {"points", GG_FIELD_INTEGER, offsetof(draws, points), 1, GG_MOST_POINTS, .doc = "how many"},
    {"seed", GG_FIELD_INTEGER, offsetof(draws, seed), 0, 9223372036854775807.0, .doc = "of the draws"}};

static gg_status read_draws(gg_scene_reader *r, const yaml_node_t *map, draws *d)
{
  *d = (draws){.seed = 1};
  for (yaml_node_pair_t *i = map->type == YAML_MAPPING_NODE ? map->data.mapping.pairs.start : NULL;
       i && i < map->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const yaml_node_t *value = yaml_document_get_node(r->document, i->value);
    const char *word = name->type == YAML_SCALAR_NODE ? (const char *)name->data.scalar.value : "?";
    int k = 0;
    char key[96];
    snprintf(key, sizeof key, "vary.random.%.60s", word);
    while (k < 2 && strcmp(draws_fields[k].key, word) != 0) k++;
    if (k == 2) return gg_scene_refuse(r, name, key, "no such key; under random there are points and seed");
    GG_TRY(gg_scene_read_value(r, &draws_fields[k], key, value, d));
  }
  if (d->points) return GG_OK;
  return gg_scene_refuse(r, map, "vary.random", "say how many points are to be drawn: random: {points: 100, seed: 1}");
}

/* A stream for each key: more points or more keys leave the draws that there were. */
static gg_status add_random(gg_scene_reader *r, gg_sweep *sweep, columns *c)
{
  draws d;
  gg_varied v;
  GG_TRY(read_draws(r, c->random, &d));
  if (!c->n) return gg_scene_refuse(r, c->random, "vary", "no key is drawn");
  GG_TRY(new_varied(&v, c, 0, c->n, (size_t)d.points, r->err));
  for (size_t k = 0; k < c->n; k++) {
    gg_rng rng = gg_rng_seed((uint64_t)d.seed, gg_checksum(GG_CHECKSUM_START, c->key[k], strlen(c->key[k])));
    for (size_t i = 0; i < v.n; i++)
      if (!(v.value[i * c->n + k] = gg_values_draw(&c->values[k], c->key[k], &rng))) {
        gg_varied_clear(&v);
        return gg_fail(r->err, GG_FAILED, "out of memory");
      }
  }
  return place(r, c->random, gg_sweep_add(sweep, &v, r->err));
}

static gg_status read_one(gg_scene_reader *r, gg_sweep *sweep, const yaml_node_t *map, bool zipped)
{
  columns c = {0};
  gg_status status =
      map->type == YAML_MAPPING_NODE
          ? read_map(r, "", map, &c)
          : gg_scene_refuse(r, map, "vary", "keys with their values are expected: vary: {phi: [0.1, 0.2]}");
  if (status == GG_OK)
    status = c.random ? add_random(r, sweep, &c) : zipped ? add_zipped(r, sweep, &c) : add_grid(r, sweep, &c);
  clear_columns(&c);
  return status;
}

static gg_status read_vary(gg_scene_reader *r, gg_sweep *sweep, const yaml_node_t *node)
{
  size_t before = sweep->n_varied;
  if (node->type != YAML_SEQUENCE_NODE) GG_TRY(read_one(r, sweep, node, false));
  for (yaml_node_item_t *i = node->type == YAML_SEQUENCE_NODE ? node->data.sequence.items.start : NULL;
       i && i < node->data.sequence.items.top; i++)
    GG_TRY(read_one(r, sweep, yaml_document_get_node(r->document, *i), true));
  return sweep->n_varied > before ? GG_OK
                                  : gg_scene_refuse(r, node, "vary", "no key is varied, e.g. vary: {phi: [0.1, 0.2]}");
}

/* A reader with what its use needs besides. */
typedef struct sweep_reader {
  gg_scene_reader reader;
  gg_sweep *sweep;
} sweep_reader;

static gg_status use_sweep(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  gg_sweep *sweep = ((sweep_reader *)(void *)r)->sweep;
  const yaml_node_t *vary = NULL, *settings = NULL;
  GG_TRY(gg_scene_read_root(r, key, root));
  for (yaml_node_pair_t *i = root->data.mapping.pairs.start; i < root->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const char *word = (const char *)name->data.scalar.value;
    const yaml_node_t **which = strcmp(word, "vary") == 0 ? &vary : strcmp(word, "sweep") == 0 ? &settings : NULL;
    if (which && *which) return gg_scene_refuse(r, name, word, "is given twice");
    if (which) *which = yaml_document_get_node(r->document, i->value);
  }
  if (settings) GG_TRY(gg_sweep_settings_read(r, settings, &sweep->settings));
  return vary ? read_vary(r, sweep, vary) : GG_OK;
}

gg_status gg_sweep_read_text(gg_sweep *sweep, const char *yaml, size_t length, const char *name, gg_error *err)
{
  static const char *const others[] = {"vary", "sweep", NULL};
  sweep_reader s = {{.name = name, .lines = true, .scene = &sweep->base, .others = others, .err = err}, sweep};
  return gg_scene_with_document(&s.reader, yaml, length, "", use_sweep);
}
