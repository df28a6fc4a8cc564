/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep from YAML: the scene's keys, and beside them the maps `vary` and `sweep`. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "scene/scene_reader.h"
#include "sweep/sweep.h"

static const gg_word does[] = {{"run", GG_DOES_RUN, "one engine, the scene's"},
                               {"compare", GG_DOES_COMPARE, "both engines and the theories"},
                               {"theory", GG_DOES_THEORY, "the theories alone"},
                               {0}};
static const gg_word seeds[] = {
    {"independent", GG_SEEDS_INDEPENDENT, "each point its own, made of run.seed and of what is simulated there"},
    {"common", GG_SEEDS_COMMON, "run.seed for all"},
    {0}};

#define AT(member) offsetof(gg_sweep_settings, member)

static const gg_field settings_fields[] = {
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

static const char unknown_setting[] = "no such key; under sweep there are does, seeds, at_once, longest";

gg_sweep_settings gg_sweep_settings_defaults(void)
{
  return (gg_sweep_settings){.longest = 600};
}

/* A reader of YAML, and what it fills: a sweep or the settings alone. */
typedef struct sweep_reader {
  gg_scene_reader reader;
  gg_sweep *sweep;
  gg_sweep_settings *settings;
} sweep_reader;

static gg_status use_setting(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  const gg_field *f = settings_fields;
  if (!root) return gg_scene_reject(r, root, key, "no value is given");
  while (f->key && strcmp(f->key, key) != 0) f++;
  if (!f->key) return gg_scene_reject(r, root, key, unknown_setting);
  return gg_scene_read_value(r, f, key, root, ((sweep_reader *)(void *)r)->settings);
}

gg_status gg_sweep_settings_set(gg_sweep_settings *settings, const char *key, const char *value, gg_error *err)
{
  gg_sweep_settings changed = *settings;
  sweep_reader s = {.reader = {.err = err}, .settings = &changed};
  GG_TRY(gg_scene_with_value(&s.reader, key, value, use_setting));
  *settings = changed;
  return GG_OK;
}

json_t *gg_sweep_settings_schema(void)
{
  json_auto_t *whole = gg_scene_schema_of(settings_fields);
  return json_incref(json_object_get(json_object_get(whole, "properties"), "sweep"));
}

void gg_sweep_settings_print(FILE *out, const gg_sweep_settings *settings)
{
  fputs("sweep:\n", out);
  for (const gg_field *f = settings_fields; f->key; f++) {
    char text[64];
    json_t *value = gg_scene_field_json(f, settings, NULL);
    gg_scene_flow_style_text(value, text, sizeof text);
    fprintf(out, "  %s: %s\n", strchr(f->key, '.') + 1, text);
    json_decref(value);
  }
}

/* One map of `vary` as it is read: the values of each key. */
typedef struct value_lists {
  size_t n;
  gg_values values[GG_MOST_VARIED];
  const yaml_node_t *node[GG_MOST_VARIED];
  const yaml_node_t *random; /* the map of random draws; NULL: none */
} value_lists;

/* Characters of a value: an alias may contain itself, without end. */
enum { LONGEST_VALUE = 10000 };

/* A node as YAML on one line; cut where it is too long. */
static void print_node(const gg_scene_reader *r, const yaml_node_t *node, FILE *out)
{
  if (ftell(out) > LONGEST_VALUE) return;
  if (node->type == YAML_SCALAR_NODE) {
    const char *text = (const char *)node->data.scalar.value;
    if (node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE)
      fputs(text, out);
    else
      gg_scene_yaml_quoted_print(out, text);
  } else if (node->type == YAML_SEQUENCE_NODE) {
    fputc('[', out);
    for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++) {
      if (i != node->data.sequence.items.start) fputs(", ", out);
      print_node(r, yaml_document_get_node(r->document, *i), out);
    }
    fputc(']', out);
  } else if (node->type == YAML_MAPPING_NODE) {
    fputc('{', out);
    const char *separator = "";
    for (gg_scene_entry e = {0}; gg_scene_entry_next(r, node, &e); separator = ", ") {
      fputs(separator, out);
      print_node(r, e.name, out);
      fputs(": ", out);
      print_node(r, e.value, out);
    }
    fputc('}', out);
  }
}

static gg_status add_node(const gg_scene_reader *r, gg_values *values, const yaml_node_t *node)
{
  GG_FREED char *text = NULL;
  FILE *out = gg_base_memory_stream_open(&text);
  if (out) print_node(r, node, out);
  if (!gg_base_memory_stream_close(out, &text))
    return gg_base_error_prefix(r->err, gg_base_out_of_memory(r->err), "%s", r->name);
  if (strlen(text) > LONGEST_VALUE)
    return gg_scene_reject(r, node, values->key, "a value is longer than %d characters", LONGEST_VALUE);
  return gg_sweep_values_add(values, text, r->err);
}

/* A message of parameter_grid.c, with the file and the line before it. */
static gg_status place(const gg_scene_reader *r, const yaml_node_t *node, gg_status status)
{
  if (status == GG_OK || status == GG_FAILED) return status;
  return gg_base_error_prefix(r->err, status, "%s:%zu", r->name, node->start_mark.line + 1);
}

static gg_status read_item(const gg_scene_reader *r, const yaml_node_t *node, gg_values *values)
{
  if (node->type != YAML_SCALAR_NODE || node->data.scalar.style != YAML_PLAIN_SCALAR_STYLE)
    return add_node(r, values, node);
  return place(r, node, gg_sweep_values_parse(values, gg_scene_scalar(node), r->err));
}

static gg_status read_values(const gg_scene_reader *r, const yaml_node_t *node, gg_values *values)
{
  if (node->type != YAML_SEQUENCE_NODE) return read_item(r, node, values);
  for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++)
    GG_TRY(read_item(r, yaml_document_get_node(r->document, *i), values));
  if (values->range && values->n)
    return gg_scene_reject(r, node, values->key, "is either drawn from LOW..HIGH or from a list");
  if (!values->n && !values->range) return gg_scene_reject(r, node, values->key, "has no values");
  return GG_OK;
}

static gg_status read_lists(const gg_scene_reader *r, const char *section, const yaml_node_t *map, value_lists *lists)
{
  char key[GG_SCENE_KEY];
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, map, &e);) {
    GG_TRY(gg_scene_entry_key(r, &e, section, "vary", key));
    if (strcmp(key, "random") == 0) {
      lists->random = e.value;
      continue;
    }
    if (gg_scene_is_section(key) && e.value->type == YAML_MAPPING_NODE) {
      GG_TRY(read_lists(r, key, e.value, lists));
      continue;
    }
    if (lists->n == GG_MOST_VARIED)
      return gg_scene_reject(r, e.name, key, "more than %d keys are varied", GG_MOST_VARIED);
    gg_values *values = &lists->values[lists->n];
    lists->node[lists->n++] = e.value;
    snprintf(values->key, sizeof values->key, "%s", key);
    GG_TRY(read_values(r, e.value, values));
  }
  return GG_OK;
}

static gg_status reject_range(const gg_scene_reader *r, const value_lists *l)
{
  for (size_t k = 0; k < l->n; k++)
    if (l->values[k].range)
      return gg_scene_reject(r, l->node[k], l->values[k].key,
                             "LOW..HIGH is for random draws: say how many, vary: {random: {points: 100}, ...}; a grid "
                             "has first:last:step or a list");
  return GG_OK;
}

/* Add keys that change together; their lists have one length. */
static gg_status add_zipped(const gg_scene_reader *r, gg_sweep *sweep, value_lists *l)
{
  GG_TRY(reject_range(r, l));
  for (size_t k = 1; k < l->n; k++)
    if (l->values[k].n != l->values[0].n)
      return gg_scene_reject(
          r, l->node[k], l->values[k].key,
          "has %zu values, and %s, which goes with it, has %zu; keys of one map in a list change together",
          l->values[k].n, l->values[0].key, l->values[0].n);
  return l->n ? place(r, l->node[0], gg_sweep_add_rows(sweep, l->values, l->n, r->err)) : GG_OK;
}

typedef struct draws {
  int64_t points, seed;
} draws;
static const gg_field draws_fields[] = {
    {"points", GG_FIELD_INTEGER, offsetof(draws, points), 1, GG_MOST_POINTS, .doc = "how many"},
    {"seed", GG_FIELD_INTEGER, offsetof(draws, seed), 0, 9223372036854775807.0, .doc = "of the draws"},
    {0}};

static gg_status add_random(const gg_scene_reader *r, gg_sweep *sweep, const value_lists *l)
{
  draws d = {.seed = 1};
  if (l->random->type == YAML_MAPPING_NODE)
    GG_TRY(gg_scene_read_map(r, "vary.random", l->random, draws_fields,
                             "no such key; under random there are points and seed", &d));
  if (!d.points)
    return gg_scene_reject(r, l->random, "vary.random",
                           "say how many points are to be drawn: random: {points: 100, seed: 1}");
  if (!l->n) return gg_scene_reject(r, l->random, "vary", "no key is drawn");
  return place(r, l->random, gg_sweep_add_draws(sweep, l->values, l->n, (size_t)d.points, (uint64_t)d.seed, r->err));
}

static gg_status add_map(const gg_scene_reader *r, gg_sweep *sweep, const yaml_node_t *map, bool zipped)
{
  value_lists l = {0};
  gg_status status =
      map->type == YAML_MAPPING_NODE
          ? read_lists(r, "", map, &l)
          : gg_scene_reject(r, map, "vary", "keys with their values are expected: vary: {phi: [0.1, 0.2]}");
  if (status == GG_OK)
    status = l.random ? add_random(r, sweep, &l) : zipped ? add_zipped(r, sweep, &l) : reject_range(r, &l);
  for (size_t k = 0; k < l.n && !l.random && !zipped && status == GG_OK; k++)
    status = place(r, l.node[k], gg_sweep_add_rows(sweep, &l.values[k], 1, r->err));
  for (size_t k = 0; k < l.n; k++) gg_sweep_values_clear(&l.values[k]);
  return status;
}

static gg_status read_vary(const gg_scene_reader *r, gg_sweep *sweep, const yaml_node_t *node)
{
  if (node->type != YAML_SEQUENCE_NODE) GG_TRY(add_map(r, sweep, node, false));
  for (yaml_node_item_t *i = node->type == YAML_SEQUENCE_NODE ? node->data.sequence.items.start : NULL;
       i && i < node->data.sequence.items.top; i++)
    GG_TRY(add_map(r, sweep, yaml_document_get_node(r->document, *i), true));
  return sweep->n_varied ? GG_OK : gg_scene_reject(r, node, "vary", "no key is varied, e.g. vary: {phi: [0.1, 0.2]}");
}

static gg_status use_sweep(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  gg_sweep *sweep = ((sweep_reader *)(void *)r)->sweep;
  const yaml_node_t *vary = NULL, *settings = NULL;
  GG_TRY(gg_scene_read_root(r, key, root));
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, root, &e);) {
    const yaml_node_t **which = strcmp(e.word, "vary") == 0 ? &vary : strcmp(e.word, "sweep") == 0 ? &settings : NULL;
    if (which && *which) return gg_scene_reject(r, e.name, e.word, "is given twice");
    if (which) *which = e.value;
  }
  if (settings && settings->type != YAML_MAPPING_NODE)
    return gg_scene_reject(r, settings, "sweep", "is a section: its keys go below it, indented");
  if (settings) GG_TRY(gg_scene_read_map(r, "sweep", settings, settings_fields, unknown_setting, &sweep->settings));
  return vary ? read_vary(r, sweep, vary) : GG_OK;
}

gg_status gg_sweep_read_text(gg_sweep *sweep, const char *yaml, size_t length, const char *name, gg_error *err)
{
  static const char *const others[] = {"vary", "sweep", "theories", NULL};
  sweep_reader s = {{.name = name, .lines = true, .scene = sweep->base, .others = others, .err = err}, sweep, NULL};
  return gg_scene_with_document(&s.reader, yaml, length, "", use_sweep);
}
