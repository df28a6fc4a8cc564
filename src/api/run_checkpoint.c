/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gg_checkpoint_about: content of checkpoints and saved simulations. */
#include <stdlib.h>
#include <string.h>

#include "api/run.h"
#include "api/simulation.h"
#include "base/memory.h"
#include "files/h5/checkpoint_file.h"
#include "scene/fields.h"

static gg_status describe_comparison(const gg_archive *a, gg_checkpoint_info *info, gg_error *err)
{
  info->kind = "comparison";
  for (int k = 0; k < GG_N_ENGINES; k++) {
    GG_CLEARED(gg_base_archive_clear) gg_archive one = {0};
    const char *name = gg_common_engine_of(k)->name;
    GG_TRY(gg_base_archive_unnest(&one, name, a, err));
    if (!one.n_items) continue;
    info->part[k].engine = name;
    GG_TRY(gg_run_how_far(&one, &info->part[k], err));
  }
  return GG_OK;
}

static gg_status describe(const gg_archive *a, const char *path, const gg_scene *scene, gg_checkpoint_info *info,
                          gg_error *err)
{
  gg_simulation *simulation;
  if (gg_base_archive_find(a, "md/campaign/state") || gg_base_archive_find(a, "dsmc/campaign/state"))
    return describe_comparison(a, info, err);
  if (!gg_base_archive_find(a, "simulation/scene")) {
    info->kind = "run";
    info->part[0].engine = gg_common_engine_of(scene->engine)->name;
    return gg_run_how_far(a, &info->part[0], err);
  }
  GG_TRY(gg_simulation_load(path, NULL, NULL, NULL, &simulation, err));
  gg_simulation_state now;
  info->kind = "simulation";
  info->part[0] = (gg_checkpoint_part){.engine = simulation->engine->ops->name, .phase = "stepped"};
  if (gg_simulation_get_state(simulation, &now, NULL) == GG_OK)
    info->part[0].collisions_per_grain = now.collisions_per_grain;
  gg_simulation_free(simulation);
  return GG_OK;
}

static gg_status about(const gg_archive *a, const char *path, gg_checkpoint_info *info, gg_scene **scene, gg_error *err)
{
  gg_scene *stored = NULL;
  const unsigned before = gg_base_memory_failures();
  GG_FREED char *yaml = gg_files_checkpoint_scene(path, info->older);
  bool out_of_memory = gg_base_memory_failures() != before;
  gg_status status = yaml            ? gg_scene_parse(yaml, path, &stored, err)
                     : out_of_memory ? gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", path)
                                     : gg_base_fail(err, GG_BAD_FILE, "%s: its scene cannot be read", path);
  info->frames = gg_api_trajectory_frames(a);
  if (status == GG_OK) status = describe(a, path, stored, info, err);
  if (status == GG_OK && scene)
    *scene = stored;
  else
    gg_scene_free(stored);
  return status;
}

gg_status gg_checkpoint_check_result(const char *path, const char *result_file, gg_error *err)
{
  GG_NEED(path, result_file);
  gg_error why;
  gg_scene *scene = NULL;
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *c = NULL;
  GG_CLEARED(gg_base_archive_clear) gg_archive keys = {0};
  GG_TRY(gg_comparison_read(result_file, &c, err));
  GG_TRY(gg_checkpoint_about(path, &(gg_checkpoint_info){0}, &scene, err));
  gg_status status = gg_scene_resumption_put(scene, &keys, err);
  gg_scene_free(scene);
  if (status != GG_OK || gg_scene_resumption_check(c->scene, &keys, &why) == GG_OK) return status;
  return GG_REFUSE(err, "%s: is not the result of the run in %s: %.600s", result_file, path, why.message);
}

gg_status gg_checkpoint_about(const char *path, gg_checkpoint_info *info, gg_scene **scene, gg_error *err)
{
  GG_NEED(path, info);
  bool older = false;
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {0};
  gg_checkpoint_info found = {0};
  GG_TRY(gg_files_checkpoint_read(path, true, &archive, &older, err));
  found.older = older;
  GG_TRY(about(&archive, path, &found, scene, err));
  return *info = found, GG_OK;
}
