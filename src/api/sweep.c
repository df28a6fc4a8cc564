/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps: read, changed, checked and queried. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "api/api.h"
#include "api/scene_theories.h"
#include "base/memory.h"
#include "common/extension.h"
#include "scene/scene_reader.h"
#include "sweep/folder.h"
#include "sweep/sweep_table.h"

static void destroy(void *handle)
{
  gg_sweep *sweep = handle;
  for (size_t f = 0; f < sweep->n_varied; f++) gg_sweep_varied_clear(&sweep->varied[f]);
  gg_scene_free(sweep->base);
  free(sweep->point);
  free(sweep->name);
  free(sweep);
}

static gg_sweep *new_sweep(const char *name, gg_error *err)
{
  gg_sweep *sweep = gg_base_array_new(1, sizeof *sweep, err);
  if (!sweep) return NULL;
  gg_base_busy_init(&sweep->busy, "sweep", destroy, sweep);
  const gg_scene defaults = gg_scene_defaults();
  sweep->base = gg_scene_copy_new(&defaults, err);
  sweep->settings = gg_sweep_settings_defaults();
  sweep->name = strdup(name);
  if (sweep->name && sweep->base) return sweep;
  gg_base_out_of_memory(err);
  gg_sweep_free(sweep);
  return NULL;
}

void gg_sweep_free(gg_sweep *sweep)
{
  if (sweep) gg_base_busy_free(&sweep->busy);
}

static gg_status read_text(const char *yaml, size_t length, const char *name, const char *path, gg_sweep **sweep,
                           gg_error *err)
{
  const unsigned before = gg_base_memory_failures();
  gg_sweep *made = new_sweep(name, err);
  if (!made) return GG_FAILED;
  gg_status status = gg_sweep_read_text(made, yaml, length, name, err);
  if (status == GG_OK) status = gg_api_scene_theories_add(made->base, yaml, length, name, path, err);
  status = gg_base_memory_check(before, status, err);
  if (status == GG_OK)
    *sweep = made;
  else
    gg_sweep_free(made);
  return status;
}

gg_status gg_sweep_load(const char *path, gg_sweep **sweep, gg_error *err)
{
  GG_NEED(path, sweep);
  GG_FREED char *text = NULL;
  char inside[PATH_MAX];
  size_t length;
  if (gg_sweep_folder_text_path(path, inside) && access(inside, R_OK) == 0) path = inside;
  GG_TRY(gg_scene_file_text(path, &text, &length, err));
  return read_text(text, length, gg_scene_file_name(path), path, sweep, err);
}

gg_status gg_sweep_parse(const char *yaml, const char *name, gg_sweep **sweep, gg_error *err)
{
  GG_NEED(yaml, sweep);
  return read_text(yaml, strlen(yaml), name ? name : "sweep", NULL, sweep, err);
}

static gg_status check_open(const gg_sweep *sweep, gg_error *err)
{
  return sweep->n ? GG_REFUSE(err, "%s: the sweep was checked already and cannot be changed", sweep->name) : GG_OK;
}

gg_status gg_sweep_set(gg_sweep *sweep, const char *key, const char *value, gg_error *err)
{
  GG_NEED_ALONE(sweep, key, value);
  GG_TRY(check_open(sweep, err));
  if (gg_sweep_varies(sweep, key)) return GG_REFUSE(err, "key '%.60s': is varied: each point sets its own value", key);
  return strncmp(key, "sweep.", 6) == 0 ? gg_sweep_settings_set(&sweep->settings, key, value, err)
                                        : gg_scene_override(sweep->base, key, value, err);
}

gg_status gg_sweep_vary(gg_sweep *sweep, const char *key, const char *values, gg_error *err)
{
  GG_NEED_ALONE(sweep, key, values);
  GG_CLEARED(gg_sweep_values_clear) gg_values list = {0};
  snprintf(list.key, sizeof list.key, "%s", key);
  GG_TRY(check_open(sweep, err));
  GG_TRY(gg_sweep_values_parse(&list, values, err));
  if (list.range)
    return GG_REFUSE(
        err,
        "key '%.60s': LOW..HIGH is for random draws, which a sweep's file asks for; here first:last:step or v1,v2,...",
        key);
  return gg_sweep_add_rows(sweep, &list, 1, err);
}

gg_status gg_sweep_check(gg_sweep *sweep, gg_error *err)
{
  GG_NEED_ALONE(sweep);
  return gg_sweep_check_points(sweep, err);
}

size_t gg_sweep_points(const gg_sweep *sweep)
{
  return sweep ? sweep->n : 0;
}

const char *gg_sweep_does(const gg_sweep *sweep)
{
  return sweep ? gg_sweep_does_words[sweep->settings.does] : NULL;
}

static gg_status check_point(const gg_sweep *sweep, size_t i, gg_error *err)
{
  if (!sweep->n) return GG_REFUSE(err, "%s: call gg_sweep_check first", sweep->name);
  if (i >= sweep->n)
    return GG_REFUSE(err, "%s: there is no point %zu; the sweep has %zu", sweep->name, i + 1, sweep->n);
  return GG_OK;
}

static gg_status resolve(const gg_sweep *sweep, size_t i, gg_scene *scene, gg_error *err)
{
  GG_TRY(check_point(sweep, i, err));
  return gg_sweep_resolve(sweep, i, scene, err);
}

gg_status gg_sweep_at(const gg_sweep *sweep, size_t i, gg_sweep_point *point, gg_error *err)
{
  GG_NEED_READING(sweep, point);
  gg_scene scene;
  GG_TRY(resolve(sweep, i, &scene, err));
  *point =
      (gg_sweep_point){.cpu_seconds = sweep->point[i].seconds, .replicas = scene.run.replicas, .seed = scene.run.seed};
  gg_sweep_point_name(sweep->point[i].id, point->name);
  return GG_OK;
}

gg_status gg_sweep_scene(const gg_sweep *sweep, size_t i, gg_scene **scene, gg_error *err)
{
  GG_NEED_READING(sweep, scene);
  gg_scene made;
  GG_TRY(resolve(sweep, i, &made, err));
  return gg_scene_copy(&made, scene, err);
}

gg_status gg_sweep_find(const gg_sweep *sweep, const char *folder, size_t i, gg_point_state *state, char **file,
                        gg_error *err)
{
  GG_NEED_READING(sweep, folder, state);
  GG_TRY(check_point(sweep, i, err));
  const uint64_t id = sweep->point[i].id;
  const bool fell_short = gg_sweep_point_status(folder, id) == GG_POINT_SHORT;
  *state = gg_sweep_point_state(folder, id);
  if (!file) return GG_OK;
  char path[PATH_MAX];
  *file = strdup(gg_sweep_point_path(folder, id, fell_short ? ".short.h5" : ".h5", path));
  return *file ? GG_OK : gg_base_out_of_memory(err);
}

gg_status gg_sweep_to_json(const gg_sweep *sweep, const char *folder, char **text, gg_error *err)
{
  GG_NEED_READING(sweep, folder, text);
  GG_TRY(check_point(sweep, 0, err));
  return gg_api_text_copy(gg_sweep_document(sweep, folder), text, err);
}

const char *gg_sweep_key(const gg_sweep *sweep, size_t k)
{
  return gg_sweep_column_key(sweep, k);
}

const char *gg_sweep_value(const gg_sweep *sweep, size_t i, size_t k)
{
  return gg_sweep_column_value(sweep, i, k);
}
