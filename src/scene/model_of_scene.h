/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model of a scene: keys in the user's units become the problem in the engines' units. */
#ifndef GG_MODEL_OF_SCENE_H
#define GG_MODEL_OF_SCENE_H

#include "common/model.h"
#include "scene/scene.h"

/* Make the model for the engine that the caller means to use: it fixes the number of grains. temperature0 and ratio0
 * are order-of-magnitude estimates unless the scene gives them; a caller may improve them before making an engine. */
gg_status gg_scene_model_make(const gg_scene *scene, gg_engine_kind engine, gg_model *model, gg_error *err);

/* The same for theories alone, which have no grains: fractions are the scene's, however small. */
gg_status gg_scene_model_for_theories(const gg_scene *scene, gg_model *model, gg_error *err);

/* Set theta/T of the start where the scene gives its rotational temperature. */
void gg_scene_model_set_ratio(const gg_scene *scene, gg_model *model);

#endif
