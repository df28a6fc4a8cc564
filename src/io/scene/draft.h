/* A scene on its way from text to a run: values, and which of them were given. */
#ifndef GG_SCENE_DRAFT_H
#define GG_SCENE_DRAFT_H

#include "io/scene/fields.h"

typedef struct gg_scene_draft {
  gg_scene scene; /* first: the gg_scene of the public interface is one of these */
  bool given[GG_MAX_FIELDS];
} gg_scene_draft;

void gg_scene_draft_start(gg_scene_draft *draft);

/* Read YAML text; `name` stands for the file in messages. Every key is checked by itself. */
gg_status gg_scene_draft_parse(gg_scene_draft *draft, const char *yaml, size_t length, const char *name, gg_error *err);
gg_status gg_scene_draft_load(gg_scene_draft *draft, const char *path, gg_error *err);

/* One override: key "collision.e", also "collision.e.12" and "species.2.mass"; value in YAML. */
gg_status gg_scene_draft_set(gg_scene_draft *draft, const char *key, const char *value, gg_error *err);

/* Fill in the defaults that depend on other keys, and check what concerns several keys. */
gg_status gg_scene_draft_finish(gg_scene_draft *draft, const char *name, gg_error *err);

#endif
