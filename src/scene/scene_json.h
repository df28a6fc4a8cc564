/* Scenes written back: as JSON for results, as YAML for people; either can be read again as a scene. */
#ifndef GG_SCENE_JSON_H
#define GG_SCENE_JSON_H

#include <jansson.h>
#include <stdio.h>

#include "scene/fields.h"

/* Every key with its value; NULL only if out of memory. The caller owns the reference. */
json_t *gg_scene_json(const gg_scene *scene);
/* One value of it; the same. */
json_t *gg_scene_field_json(const gg_field *field, const void *base, const gg_scene *scene);
/* The value of one key: "collision.e", "collision.e.12", "species.2.mass". NULL: there is no such key,
 * or out of memory. */
json_t *gg_scene_key_json(const gg_scene *scene, const char *key);
/* A JSON value on one line, as YAML flow style. */
void gg_scene_print_flow_style(FILE *out, const json_t *value);
/* The same, cut to `size` bytes. */
void gg_scene_flow_style_text(const json_t *value, char *text, size_t size);
/* The scene as YAML text, to be freed; NULL if out of memory. */
char *gg_scene_yaml(const gg_scene *scene);

#endif
