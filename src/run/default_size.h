/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes completed and checked, with the default number of grains: a gas that would swirl and cluster in the usual box
 * gets a smaller one, if one of some hundreds of grains stays homogeneous. */
#ifndef GG_DEFAULT_SIZE_H
#define GG_DEFAULT_SIZE_H

#include <stddef.h>

#include "scene/scene.h"

int64_t gg_run_default_size(const gg_scene *scene);
/* Why a scene that gives none has so many: "automatic: ..."; "" where it has the usual number and that stays
 * homogeneous, or it is unknown. */
void gg_run_default_size_reason(const gg_scene *scene, char *text, size_t size);

/* gg_scene_fill_in and gg_scene_finish, with that number: every use of a scene begins with one of them. */
void gg_run_scene_fill_in(gg_scene *scene);
gg_status gg_run_scene_finish(gg_scene *scene, gg_error *err);

#endif
