/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulations in files and in memory. */
#include <stdlib.h>
#include <string.h>

#include "api/simulation.h"
#include "base/memory.h"
#include "files/h5/checkpoint_file.h"
#include "scene/scene_reader.h"

static const char strained_item[] = "simulation/strained";

static gg_status put_all(const gg_simulation *s, gg_archive *a, gg_error *err)
{
  GG_FREED char *yaml = gg_scene_yaml(&s->scene);
  if (!yaml) return gg_base_out_of_memory(err);
  GG_TRY(gg_base_archive_put(a, "simulation/scene", GG_ITEM_U8, yaml, strlen(yaml), err));
  GG_TRY(gg_scene_resumption_put(&s->scene, a, err));
  GG_TRY(gg_base_archive_put(a, "simulation/clock", GG_ITEM_U8, &s->clock, sizeof s->clock, err));
  if (s->strained.until > 0) GG_TRY(gg_base_archive_put(a, strained_item, GG_ITEM_F64, &s->strained, 2, err));
  return s->engine->ops->save(s->engine, a, err);
}

gg_status gg_simulation_save(const gg_simulation *simulation, const char *path, int (*stop)(void *context),
                             void *context, gg_error *err)
{
  GG_NEED_READING(simulation, path);
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {.stop = &GG_STOP_OF(stop, context)};
  gg_status status = put_all(simulation, &archive, err);
  if (status == GG_OK) status = gg_files_checkpoint_write(path, false, true, &archive, &simulation->scene, err);
  return gg_base_callback_settle(status, err);
}

gg_status gg_simulation_to_bytes(const gg_simulation *simulation, int (*stop)(void *context), void *context,
                                 void **bytes, size_t *size, gg_error *err)
{
  GG_NEED_READING(simulation, bytes, size);
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {.stop = &GG_STOP_OF(stop, context)};
  GG_FREED void *made = NULL;
  size_t length = 0;
  gg_status status = put_all(simulation, &archive, err);
  if (status == GG_OK) status = gg_files_checkpoint_to_bytes(&archive, &simulation->scene, &made, &length, err);
  GG_TRY(gg_base_callback_settle(status, err));
  *size = length;
  return GG_HAND_OVER(bytes, made), GG_OK;
}

static gg_status stored_scene(const gg_archive *a, const char *path, gg_scene *scene, gg_error *err)
{
  const gg_item *yaml = gg_base_archive_find(a, "simulation/scene");
  if (!yaml)
    return GG_REFUSE(err, "%s: is not a saved simulation (a run resumes from a checkpoint: gg_run_options.resume)",
                     path);
  *scene = gg_scene_defaults();
  return gg_scene_read(scene, yaml->data, yaml->count, path, err);
}

static gg_status take_all(gg_simulation *s, const gg_archive *a, gg_error *err)
{
  GG_TRY(gg_scene_resumption_check(&s->scene, a, err));
  GG_TRY(gg_base_archive_get(a, "simulation/clock", GG_ITEM_U8, &s->clock, sizeof s->clock, err));
  if (gg_base_archive_find(a, strained_item))
    GG_TRY(gg_base_archive_get(a, strained_item, GG_ITEM_F64, &s->strained, 2, err));
  return gg_common_engine_of(s->scene.engine)->restore(&s->model, a, &s->engine, err);
}

static gg_status load(const gg_archive *a, const char *path, const gg_scene *scene, int (*stop)(void *context),
                      void *context, gg_simulation **simulation, gg_error *err)
{
  gg_scene stored;
  gg_simulation *s;
  GG_TRY(stored_scene(a, path, &stored, err));
  gg_scene settled = scene ? *scene : stored;
  GG_TRY(gg_scene_resumption_settle(&settled, a, err));
  GG_TRY(gg_api_simulation_prepare(&settled, stop, context, &s, err));
  gg_status status = take_all(s, a, err);
  return gg_api_simulation_hand_over(s, status, simulation, err);
}

gg_status gg_simulation_load(const char *path, const gg_scene *scene, int (*stop)(void *context), void *context,
                             gg_simulation **simulation, gg_error *err)
{
  GG_NEED(path, simulation);
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {.stop = &GG_STOP_OF(stop, context)};
  bool older = false;
  gg_status status = gg_files_checkpoint_read(path, false, &archive, &older, err);
  if (status == GG_OK && older)
    status = gg_base_fail(err, GG_BAD_FILE, "%s: is damaged or missing; the earlier one is intact: %s.1", path, path);
  if (status == GG_OK) status = load(&archive, path, scene, stop, context, simulation, err);
  return gg_base_callback_settle(status, err);
}

gg_status gg_simulation_from_bytes(const void *bytes, size_t size, const gg_scene *scene, int (*stop)(void *context),
                                   void *context, gg_simulation **simulation, gg_error *err)
{
  GG_NEED(bytes, simulation);
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {.stop = &GG_STOP_OF(stop, context)};
  gg_status status = gg_files_checkpoint_from_bytes(bytes, size, &archive, err);
  if (status == GG_OK) status = load(&archive, "the bytes", scene, stop, context, simulation, err);
  return gg_base_callback_settle(status, err);
}
