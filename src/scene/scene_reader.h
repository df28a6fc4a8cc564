/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes from text: every key is checked by itself when it is read, and how keys go together when a scene is used
 * (gg_scene_finish). */
#ifndef GG_SCENE_READER_H
#define GG_SCENE_READER_H

#include <limits.h>
#include <yaml.h>

#include "scene/fields.h"

enum { GG_SCENE_MAX_BYTES = 1 << 20 };

/* Read YAML text into a scene, which begins as gg_scene_defaults; `name` stands for the file in messages. */
gg_status gg_scene_read(gg_scene *scene, const char *yaml, size_t length, const char *name, gg_error *err);
/* The text of a file ("-": standard input), at most a byte more than a scene may have; to be freed. And its name in
 * messages. */
gg_status gg_scene_file_text(const char *path, char **text, size_t *length, gg_error *err);
const char *gg_scene_file_name(const char *path);

/* One key: "collision.e", also "collision.e.12" and "species.2.mass"; value in YAML. The scene is unchanged on failure.
 */
gg_status gg_scene_override(gg_scene *scene, const char *key, const char *value, gg_error *err);

/* For readers of files that hold more than a scene (sweep/sweep_reader.c). */

typedef struct gg_scene_reader {
  yaml_document_t *document;
  const char *name; /* file, for messages; or the override as it was typed */
  bool lines;       /* name the line, too */
  gg_scene *scene;
  const char *const *others;  /* keys of the root that others read, left out here; ends with NULL. NULL: none */
  int line_of[GG_MAX_FIELDS]; /* line on which this document gave the key, 0: not yet */
  gg_error *err;
} gg_scene_reader;

/* Parse one document and hand its root (NULL: nothing there) on. */
typedef gg_status gg_scene_use(gg_scene_reader *r, const char *key, const yaml_node_t *root);
gg_status gg_scene_with_document(gg_scene_reader *r, const char *yaml, size_t length, const char *key,
                                 gg_scene_use *use);
/* The same of a value that overrides a key: messages begin with the key; without a value there is an error. */
gg_status gg_scene_with_value(gg_scene_reader *r, const char *key, const char *value, gg_scene_use *use);
/* A whole scene; `key` is "". */
gg_status gg_scene_read_root(gg_scene_reader *r, const char *key, const yaml_node_t *root);

/* speed_table.c: path of a file that a scene names; a relative one is relative to the folder of the file `beside`
 * (NULL: the current one). GG_BAD_FILE where it is no file: a pipe would block whoever reads the scene. */
gg_status gg_scene_file_beside(const char *file, const char *beside, char path[PATH_MAX], gg_error *err);
/* Append a row to a table of the normal speed; append the rows of a file, two columns separated by
 * blanks or a comma, without lines that begin with # and a first line of words. */
gg_status gg_scene_speed_table_add(double speed, double value, char text[GG_LAWS_TEXT], gg_error *err);
gg_status gg_scene_speed_table_read(const char *file, const char *beside, char text[GG_LAWS_TEXT], gg_error *err);

/* yaml_value.c */

/* Entries of a map, one after another: start with {0}; false after the last. */
typedef struct gg_scene_entry {
  const yaml_node_t *name, *value;
  const char *word; /* the name; NULL: it is no scalar */
  yaml_node_pair_t *pair;
} gg_scene_entry;
bool gg_scene_entry_next(const gg_scene_reader *r, const yaml_node_t *map, gg_scene_entry *entry);
/* "SECTION.NAME", or NAME where the section is ""; GG_BAD_INPUT, of the key `of`, where the name is no scalar. */
enum { GG_SCENE_KEY = 96 };
gg_status gg_scene_entry_key(const gg_scene_reader *r, const gg_scene_entry *entry, const char *section, const char *of,
                             char key[GG_SCENE_KEY]);
const char *gg_scene_scalar(const yaml_node_t *node); /* its text; NULL: it is a list or a map */

/* The node's value into the member of `base` that the field names. */
gg_status gg_scene_read_value(const gg_scene_reader *r, const gg_field *field, const char *key, const yaml_node_t *node,
                              void *base);
/* A map whose keys are rows of a table, each at most once, into `base`. `unknown` is the message for other keys; NULL:
 * the likely key is named. */
gg_status gg_scene_read_map(const gg_scene_reader *r, const char *section, const yaml_node_t *map,
                            const gg_field *fields, const char *unknown, void *base);

/* Validation errors: GG_BAD_INPUT with "file:line: key 'KEY': ..." */
gg_status gg_scene_reject(const gg_scene_reader *r, const yaml_node_t *node, const char *key, const char *format, ...)
    GG_PRINTF(4, 5);
/* The same of the text itself: "file:line: ...", without the line where it is 0; of an override "key 'KEY': ...". */
gg_status gg_scene_reject_text(const gg_scene_reader *r, size_t line, const char *format, ...) GG_PRINTF(3, 4);
/* An unknown key: the likely one is named if there is one, all are listed otherwise. */
gg_status gg_scene_reject_key(const gg_scene_reader *r, const yaml_node_t *node, const char *key);
/* A word of the scene's as a message shows it: cut to `size` bytes, without what a terminal would act on. */
void gg_scene_quote(const char *word, char *text, size_t size);

#endif
