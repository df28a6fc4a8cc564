/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes: read, changed, queried and written back. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "api/api.h"
#include "api/scene_theories.h"
#include "base/memory.h"
#include "base/text.h"
#include "common/engine.h"
#include "common/extension.h"
#include "common/laws/coefficient_tables.h"
#include "files/positions.h"
#include "files/text_format.h"
#include "io/checked_json.h"
#include "run/cost_estimate.h"
#include "run/default_size.h"
#include "run/replica.h"
#include "scene/ensemble_size.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"
#include "theory/goldhirsch_zanetti1993.h"

gg_status gg_api_scene_finish(const gg_scene *scene, gg_scene *copy, gg_error *err)
{
  *copy = *scene;
  copy->fixed.clock_rate = GG_AUTO;
  return gg_run_scene_finish(copy, err);
}

static gg_scene filled_in(const gg_scene *scene)
{
  gg_scene filled = *scene;
  gg_run_scene_fill_in(&filled);
  return filled;
}

/* Read a scene and its theories, whose files are searched beside `path`. */
static gg_status read_text(const char *yaml, size_t length, const char *name, const char *path, gg_scene **scene,
                           gg_error *err)
{
  gg_scene made = gg_scene_defaults();
  const unsigned before = gg_base_memory_failures();
  GG_TRY(gg_scene_read(&made, yaml, length, name, err));
  gg_status status = gg_api_scene_theories_add(&made, yaml, length, name, path, err);
  status = gg_base_memory_check(before, status, err);
  if (status == GG_OK) status = gg_scene_copy(&made, scene, err);
  gg_common_extension_release(made.extension);
  return status;
}

static gg_status reject_positions(gg_scene_reader *r, const char *key, const yaml_node_t *map)
{
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, map, &e);) {
    if (strcmp(e.word, "start") == 0) GG_TRY(reject_positions(r, key, e.value));
    if (strcmp(e.word, "positions") == 0 || strcmp(e.word, key) == 0)
      return gg_scene_reject(r, e.value, key, "%s: cannot be read: %s", r->scene->start.positions, strerror(errno));
  }
  return GG_OK;
}

/* The file of positions has to be there: of scenes that people write, as stored ones outlive it. */
static gg_status check_positions(gg_scene *scene, const char *yaml, size_t length, const char *name, gg_error *err)
{
  gg_scene_reader r = {.name = name, .lines = true, .scene = scene, .err = err};
  if (!gg_files_positions_are_read(scene) || access(scene->start.positions, R_OK) == 0) return GG_OK;
  return gg_scene_with_document(&r, yaml, length, "start.positions", reject_positions);
}

gg_status gg_scene_load(const char *path, gg_scene **scene, gg_error *err)
{
  GG_NEED(path, scene);
  GG_FREED char *text = NULL;
  size_t length;
  GG_TRY(gg_scene_file_text(path, &text, &length, err));
  GG_TRY(read_text(text, length, gg_scene_file_name(path), path, scene, err));
  const gg_status status = check_positions(*scene, text, length, gg_scene_file_name(path), err);
  if (status != GG_OK) gg_scene_free(*scene), *scene = NULL;
  return status;
}

gg_status gg_scene_parse(const char *yaml, const char *name, gg_scene **scene, gg_error *err)
{
  GG_NEED(yaml, scene);
  return read_text(yaml, strlen(yaml), name ? name : "scene", NULL, scene, err);
}

gg_status gg_scene_copy(const gg_scene *scene, gg_scene **copy, gg_error *err)
{
  GG_NEED(scene, copy);
  gg_scene *made = gg_scene_copy_new(scene, err);
  return made ? *copy = made, GG_OK : GG_FAILED;
}

gg_status gg_scene_set(gg_scene *scene, const char *key, const char *value, gg_error *err)
{
  GG_NEED(scene, key, value);
  return gg_scene_override(scene, key, value, err);
}

gg_status gg_scene_get(const gg_scene *scene, const char *key, char *text, size_t size, gg_error *err)
{
  GG_NEED(scene, key, text);
  const gg_scene filled = filled_in(scene);
  const unsigned before = gg_base_memory_failures();
  json_auto_t *value = gg_scene_key_json(&filled, key);
  if (value) gg_scene_flow_style_text(value, text, size);
  gg_status status = value ? GG_OK : GG_REFUSE(err, "a scene has no key '%.60s'", key);
  return gg_base_memory_check(before, status, err);
}

gg_status gg_scene_check(const gg_scene *scene, gg_error *err)
{
  GG_NEED(scene);
  gg_scene copy;
  return gg_api_scene_finish(scene, &copy, err);
}

static void append_theories(const gg_scene *scene, char **yaml)
{
  json_t *theories = gg_api_scene_theories_json(scene);
  char *text = json_object_size(theories) > 0 ? gg_io_json_text(theories, 0) : NULL, *whole = NULL;
  json_decref(theories);
  if (text && asprintf(&whole, "%stheories: %s\n", *yaml, text) < 0) whole = NULL, gg_base_memory_lacked();
  if (whole) {
    free(*yaml);
    *yaml = whole;
  }
  free(text);
}

gg_status gg_scene_to_yaml(const gg_scene *scene, char **text, gg_error *err)
{
  GG_NEED(scene, text);
  const gg_scene filled = filled_in(scene);
  const unsigned before = gg_base_memory_failures();
  char *yaml = gg_scene_yaml(&filled);
  if (yaml) append_theories(&filled, &yaml);
  if (!yaml || gg_base_memory_failures() != before) return free(yaml), gg_base_out_of_memory(err);
  *text = yaml;
  return GG_OK;
}

gg_status gg_scene_to_json(const gg_scene *scene, char **text, gg_error *err)
{
  GG_NEED(scene, text);
  const gg_scene filled = filled_in(scene);
  const unsigned before = gg_base_memory_failures();
  json_t *root = gg_scene_json(&filled);
  json_auto_t *theories = gg_api_scene_theories_json(scene);
  if (root && json_object_size(theories) > 0) json_object_set(root, "theories", theories);
  return gg_api_text_copy(gg_io_json_end(before, root), text, err);
}

gg_status gg_scene_title(const gg_scene *scene, char *text, size_t size, gg_error *err)
{
  GG_NEED(scene, text);
  const gg_scene filled = filled_in(scene);
  gg_files_scene_title(&filled, NULL, text, size);
  return GG_OK;
}

static gg_status make_model(const gg_scene *scene, const char *engine, gg_scene *finished, gg_model *model,
                            gg_engine_kind *kind, gg_error *err)
{
  GG_TRY(gg_api_engine_find(engine, kind, err));
  GG_TRY(gg_api_scene_finish(scene, finished, err));
  GG_TRY(gg_scene_model_make(finished, *kind, model, err));
  return gg_common_engine_of(*kind)->accepts(model, err);
}

gg_status gg_scene_get_needs(const gg_scene *scene, const char *engine, gg_scene_needs *needs, gg_error *err)
{
  GG_NEED(scene, engine, needs);
  gg_scene finished;
  gg_model model;
  gg_engine_kind kind;
  GG_TRY(make_model(scene, engine, &finished, &model, &kind, err));
  const gg_cost_estimate f = gg_run_cost_estimate(&finished, &model, kind);
  *needs = (gg_scene_needs){f.bytes, gg_base_memory_available(), f.collisions, f.seconds, 0, f.file};
  for (int i = 0; i < f.n_costs; i++) needs->observables += f.cost[i].percent / 100;
  return GG_OK;
}

gg_status gg_scene_describe(const gg_scene *scene, const char *engine, void (*line)(void *context, const char *text),
                            void *context, gg_error *err)
{
  GG_NEED(scene, engine);
  GG_NEED_CALLBACK(line);
  gg_scene finished;
  gg_model model;
  gg_engine_kind kind;
  GG_TRY(make_model(scene, engine, &finished, &model, &kind, err));
  gg_extension *held = gg_common_extension_hold(finished.extension); /* the callback may free the scene */
  gg_common_engine_of(kind)->describe(&model, line, context);
  gg_common_coefficients_describe(&model, line, context);
  char chosen[200] = "";
  if (model.ensemble)
    gg_scene_ensemble_size_reason(&finished, chosen, sizeof chosen);
  else
    gg_run_default_size_reason(&finished, chosen, sizeof chosen);
  if (*chosen) {
    char text[240];
    snprintf(text, sizeof text, "%s: %s", model.ensemble ? "size of the ensemble" : "number of grains", chosen);
    line(context, text);
  }
  char stable[200];
  if (gg_theory_stable_size(&model, stable, sizeof stable)) line(context, stable);
  gg_status status = gg_run_unmeasured(&finished, &model, line, context, err);
  gg_cost_estimate cost = gg_run_cost_estimate(&finished, &model, kind);
  gg_run_cost_report(&cost, finished.run.replicas, line, context);
  gg_common_extension_release(held);
  return gg_base_callback_settle(status, err);
}

gg_status gg_scene_warnings(const gg_scene *scene, const char *use, void (*line)(void *context, const char *text),
                            void *context, gg_error *err)
{
  GG_NEED(scene, use);
  GG_NEED_CALLBACK(line);
  gg_scene finished;
  gg_engine_kind kind;
  GG_CLEARED(gg_base_string_list_clear) gg_string_list lines = {0};
  unsigned uses = GG_USE_THEORY;
  if (strcmp(use, "compare") == 0) {
    uses |= GG_USE_MD | GG_USE_DSMC;
  } else if (strcmp(use, "theory") != 0) {
    if (gg_api_engine_find(use, &kind, NULL) != GG_OK)
      return GG_REFUSE(err, "use '%.40s' is not allowed; allowed: md, dsmc, compare, theory", use);
    uses = 1u << kind;
  }
  GG_TRY(gg_api_scene_finish(scene, &finished, err));
  const unsigned before = gg_base_memory_failures();
  gg_scene_ineffective_keys(&finished, uses, &lines);
  gg_status status = gg_base_memory_check(before, GG_OK, err);
  for (size_t i = 0; status == GG_OK && i < lines.n; i++) line(context, lines.text[i]);
  return gg_base_callback_settle(status, err);
}
