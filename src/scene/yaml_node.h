/* Reading the value of one key from a YAML node. */
#ifndef GG_SCENE_NODE_H
#define GG_SCENE_NODE_H

#include <yaml.h>

#include "scene/fields.h"

typedef struct gg_scene_reader {
  yaml_document_t *document;
  const char *name; /* file, for messages; or the override as it was typed */
  bool lines;       /* say the line, too */
  gg_scene *scene;
  const char *const *others; /* keys of the root that others read, left out here; ends with NULL. NULL: none */
  int seen[GG_MAX_FIELDS];   /* line on which this document gave the key, 0: not yet */
  gg_error *err;
} gg_scene_reader;

/* GG_BAD_INPUT with "file:line: key 'KEY': ..." */
gg_status gg_scene_refuse(const gg_scene_reader *r, const yaml_node_t *node, const char *key, const char *format, ...)
    GG_PRINTF(4, 5);

/* The same of the text itself: "file:line: ...", without the line where it is 0; of an override "key 'KEY': ...". */
gg_status gg_scene_refuse_text(const gg_scene_reader *r, size_t line, const char *format, ...) GG_PRINTF(3, 4);

/* A word of the scene's as a message shows it: cut to `size` bytes, without what a terminal would act on. */
void gg_scene_quote(const char *word, char *text, size_t size);

/* Parse one document and hand its root (NULL: nothing there) on. */
typedef gg_status gg_scene_use(gg_scene_reader *r, const char *key, const yaml_node_t *root);
gg_status gg_scene_with_document(gg_scene_reader *r, const char *yaml, size_t length, const char *key,
                                 gg_scene_use *use);
/* A whole scene; `key` is "". */
gg_status gg_scene_read_root(gg_scene_reader *r, const char *key, const yaml_node_t *root);

/* Is the text small and shallow enough to be a scene? */
gg_status gg_scene_check_limits(const gg_scene_reader *r, const char *yaml, size_t length);

/* The node's value into the member of `base` that the field names. */
gg_status gg_scene_read_value(const gg_scene_reader *r, const gg_field *field, const char *key, const yaml_node_t *node,
                              void *base);
/* One number within the field's range. */
gg_status gg_scene_read_number(const gg_scene_reader *r, const gg_field *field, const char *key,
                               const yaml_node_t *node, double *value);

/* The nearest word is named if there is one, all are listed otherwise. */
gg_status gg_scene_refuse_key(const gg_scene_reader *r, const yaml_node_t *node, const char *key);

#endif
