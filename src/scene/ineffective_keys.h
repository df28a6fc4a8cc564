/* Keys that a scene gives, and that the rest of it leaves without effect: no mistakes, since scans go over flows and
 * engines with one scene, but to be told. */
#ifndef GG_SCENE_INERT_H
#define GG_SCENE_INERT_H

#include "base/string_list.h"
#include "scene/conditions.h"

/* A line for each reason: "walls.e, walls.beta have no effect ...". Keys with their default values are left out.
 * `scene` is finished, `uses` a sum of GG_USE_MD and so on. */
void gg_scene_inert(const gg_scene *scene, unsigned uses, gg_text_list *lines);

#endif
