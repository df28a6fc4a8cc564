/* What of a scene a checkpoint keeps, to refuse another scene when a run is resumed: every key of the field table but
 * those that `may_change`, and what the calling program had added to it. */
#ifndef GG_RESUMPTION_H
#define GG_RESUMPTION_H

#include "base/archive.h"
#include "common/scene.h"

/* Items "scene/KEY", and "scene/extension". */
gg_status gg_scene_resumption_put(const gg_scene *scene, gg_archive *archive, gg_error *err);
/* GG_BAD_INPUT names the first key that differs, with both values; numbers are compared to the last bit. */
/* Before the scene's model is made: an ensemble that was chosen for the error asked for at first stays as large. */
gg_status gg_scene_resumption_settle(gg_scene *scene, const gg_archive *archive, gg_error *err);
gg_status gg_scene_resumption_check(const gg_scene *scene, const gg_archive *archive, gg_error *err);

#endif
