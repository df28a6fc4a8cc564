/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/scene_theories.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/printable.h"
#include "io/checked_json.h"
#include "scene/scene_reader.h"
#include "theory/formula.h"

typedef struct theories_reader {
  gg_scene_reader reader; /* the first member: callbacks get a pointer to it */
  gg_scene *scene;
  const char *path;
} theories_reader;

/* Report an error with file and line. */
static gg_status reject(const gg_scene_reader *r, const yaml_node_t *node, const char *key, const gg_error *why)
{
  return gg_scene_reject(r, node, key, "%.900s", why->message);
}

/* Register a theory. On success the head of the extension owns `context`. `source`, the theory as the scene gives it,
 * is released. */
static gg_status add(gg_scene *scene, const gg_theory_definition *definition, json_t *source, gg_error *err)
{
  GG_FREED char *text = source ? gg_io_json_text(source, JSON_ENCODE_ANY) : NULL;
  json_decref(source);
  if (!text) return gg_base_out_of_memory(err);
  GG_TRY(gg_scene_add_theory(scene, definition, err));
  gg_common_extension_keep(scene->extension, definition->context);
  gg_common_extension_set_source(scene->extension, text);
  return text = NULL, GG_OK;
}

/* The formulas as the scene gives them. */
static json_t *source_of(const gg_scene_reader *r, const yaml_node_t *map)
{
  json_t *source = json_object();
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, map, &e);)
    json_object_set_new(source, e.word, json_string(gg_scene_scalar(e.value)));
  return source;
}

typedef struct formulas {
  int n;
  const char *name[GG_THEORY_FORMULAS], *text[GG_THEORY_FORMULAS];
  const yaml_node_t *node[GG_THEORY_FORMULAS];
} formulas;

static gg_status list_formulas(const theories_reader *t, const char *key, const yaml_node_t *map, formulas *f)
{
  f->n = 0;
  for (gg_scene_entry e = {0}; gg_scene_entry_next(&t->reader, map, &e);) {
    if (!e.word || !gg_scene_scalar(e.value))
      return gg_scene_reject(&t->reader, e.name, key,
                             "a quantity with its formula is expected: temperature: \"phi*e\"");
    if (f->n == GG_THEORY_FORMULAS)
      return gg_scene_reject(&t->reader, e.name, key, "has more than %d formulas", GG_THEORY_FORMULAS);
    f->name[f->n] = e.word, f->text[f->n] = gg_scene_scalar(e.value), f->node[f->n++] = e.value;
  }
  return GG_OK;
}

static gg_status add_formulas(const theories_reader *t, const char *key, const char *name, const yaml_node_t *map)
{
  gg_error why;
  int failed;
  formulas f;
  const char *quantity[GG_THEORY_FORMULAS];
  gg_formula_theory *made;
  GG_TRY(list_formulas(t, key, map, &f));
  if (gg_theory_formulas_read(f.n, f.name, f.text, &made, quantity, &failed, &why) != GG_OK)
    return reject(&t->reader, f.n ? f.node[failed] : map, key, &why);
  const gg_theory_definition definition = {.name = name,
                                           .title = "formulas of the scene",
                                           .assumptions = "Written in the scene, under theories.",
                                           .n_quantities = made->n_quantities,
                                           .quantities = quantity,
                                           .evaluate = gg_theory_formula_evaluate,
                                           .context = made};
  gg_status status = GG_OK;
  if (add(t->scene, &definition, source_of(&t->reader, map), &why) != GG_OK)
    free(made), status = reject(&t->reader, map, key, &why);
  return status;
}

/* Absolute path as JSON; null if it is not printable; NULL: out of memory. */
static json_t *absolute(const char *path)
{
  GG_FREED char *whole = realpath(path, NULL);
  if (!whole && errno == ENOMEM) return NULL;
  const char *name = whole ? whole : path;
  return gg_base_text_is_printable(name) ? json_string(name) : json_null();
}

static gg_status read_points(const char *path, gg_points_theory **made, char ***quantity, char **names, gg_error *err)
{
  GG_FREED char *text = NULL;
  size_t length;
  GG_TRY(gg_scene_file_text(path, &text, &length, err));
  if (length > GG_SCENE_MAX_BYTES) return GG_REFUSE(err, "%s: is larger than 1 MiB", path);
  return gg_theory_points_read(text, path, made, quantity, names, err);
}

static gg_status add_points(const theories_reader *t, const char *key, const char *name, const yaml_node_t *node)
{
  gg_error why;
  char path[PATH_MAX];
  GG_FREED char *names = NULL, **quantity = NULL;
  gg_points_theory *made = NULL;
  if (gg_scene_file_beside(gg_scene_scalar(node), t->path, path, &why) != GG_OK ||
      read_points(path, &made, &quantity, &names, &why) != GG_OK)
    return reject(&t->reader, node, key, &why);
  const gg_theory_definition definition = {.name = name,
                                           .title = "a table of points of the scene",
                                           .assumptions = "A table named in the scene, under theories.",
                                           .n_quantities = made->n,
                                           .quantities = (const char *const *)quantity,
                                           .evaluate = gg_theory_points_evaluate,
                                           .context = made};
  gg_status status =
      add(t->scene, &definition, absolute(path), &why) == GG_OK ? GG_OK : reject(&t->reader, node, key, &why);
  if (status != GG_OK) free(made);
  return status;
}

static gg_status add_all(const theories_reader *t, const yaml_node_t *map)
{
  char key[GG_SCENE_KEY];
  if (map->type != YAML_MAPPING_NODE)
    return gg_scene_reject(&t->reader, map, "theories", "is a section: its keys go below it, indented");
  for (gg_scene_entry e = {0}; gg_scene_entry_next(&t->reader, map, &e);) {
    GG_TRY(gg_scene_entry_key(&t->reader, &e, "theories", "theories", key));
    if (e.value->type == YAML_MAPPING_NODE)
      GG_TRY(add_formulas(t, key, e.word, e.value));
    else if (gg_scene_scalar(e.value) && *gg_scene_scalar(e.value))
      GG_TRY(add_points(t, key, e.word, e.value));
    else
      return gg_scene_reject(&t->reader, e.value, key,
                             "formulas are expected, {temperature: \"phi*e\"}, or a file, points.csv");
  }
  return GG_OK;
}

static gg_status use(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  const theories_reader *t = (const theories_reader *)(void *)r;
  const yaml_node_t *map = NULL;
  (void)key;
  if (!root || root->type != YAML_MAPPING_NODE) return GG_OK;
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, root, &e);) {
    if (!e.word || strcmp(e.word, "theories") != 0) continue;
    if (map) return gg_scene_reject(r, e.name, e.word, "is given twice");
    map = e.value;
  }
  return map ? add_all(t, map) : GG_OK;
}

json_t *gg_api_scene_theories_json(const gg_scene *scene)
{
  json_t *theories = json_object();
  for (int i = 0; i < gg_common_extension_theories(scene->extension); i++) {
    const char *name = gg_common_extension_theory(scene->extension, i)->name;
    const char *source = gg_common_extension_theory_source(scene->extension, i);
    json_t *value = source ? gg_io_json_made(json_loads(source, JSON_DECODE_ANY, NULL)) : json_null();
    if (!json_is_null(value)) json_object_set_new(theories, name, value);
  }
  return theories;
}

gg_status gg_api_scene_theories_add(gg_scene *scene, const char *yaml, size_t length, const char *name,
                                    const char *path, gg_error *err)
{
  theories_reader t = {{.name = name, .lines = true, .scene = scene, .err = err}, scene, path};
  return gg_scene_with_document(&t.reader, yaml, length, "", use);
}
