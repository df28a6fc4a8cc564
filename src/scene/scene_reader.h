/* Scenes from text: every key is checked by itself when it is read, and how keys go together when a scene is used. */
#ifndef GG_SCENE_READER_H
#define GG_SCENE_READER_H

#include "scene/fields.h"

enum { GG_SCENE_MAX_BYTES = 1 << 20 };

/* Read YAML text into a scene, which begins as gg_common_scene_defaults; `name` stands for the file in messages. */
gg_status gg_scene_read(gg_scene *scene, const char *yaml, size_t length, const char *name, gg_error *err);
/* "-": standard input. */
gg_status gg_scene_read_file(gg_scene *scene, const char *path, gg_error *err);
/* The text of a file, at most a byte more than a scene may have; to be freed. And its name in messages. */
gg_status gg_scene_file_text(const char *path, char **text, size_t *length, gg_error *err);
const char *gg_scene_file_name(const char *path);

/* One key: "collision.e", also "collision.e.12" and "species.2.mass"; value in YAML. The scene is unchanged on failure.
 */
gg_status gg_scene_override(gg_scene *scene, const char *key, const char *value, gg_error *err);

/* Fill in the defaults that depend on other keys. */
void gg_scene_fill_in(gg_scene *scene);
/* The same, with a check of what concerns several keys: what has to be done before a scene is used. */
gg_status gg_scene_finish(gg_scene *scene, gg_error *err);

#endif
