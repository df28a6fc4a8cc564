/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The map `theories` of a scene or a sweep: theories as formulas or tables of points. */
#ifndef GG_API_SCENE_THEORIES_H
#define GG_API_SCENE_THEORIES_H

#include <jansson.h>

#include "scene/scene.h"

/* Add those of the YAML text to the scene, which holds its extension; files lie beside `path` (NULL: in the current
 * folder). Nothing where the text has no such map. */
gg_status gg_api_scene_theories_add(gg_scene *scene, const char *yaml, size_t length, const char *name,
                                    const char *path, gg_error *err);

/* The map as the scene's text gives it, tables by their whole path; empty without any. Theories that a program defines
 * are not in it. Failed allocations are counted (io/checked_json.h). */
json_t *gg_api_scene_theories_json(const gg_scene *scene);

#endif
