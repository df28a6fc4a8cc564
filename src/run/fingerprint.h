/* What of a scene fixes a trajectory or what is averaged, extensions included: kept with a checkpoint, to refuse
 * another scene. */
#ifndef GG_FINGERPRINT_H
#define GG_FINGERPRINT_H

#include "common/archive.h"
#include "common/scene.h"

gg_status gg_fingerprint_put(const gg_scene *scene, gg_archive *archive, gg_error *err);
/* GG_BAD_INPUT names the extension or the first key that differs. */
gg_status gg_fingerprint_check(const gg_scene *scene, const gg_archive *archive, gg_error *err);

#endif
