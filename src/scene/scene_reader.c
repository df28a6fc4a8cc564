/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/scene_reader.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"

static bool is_for_others(const gg_scene_reader *r, const char *key)
{
  for (const char *const *other = r->others; key && other && *other; other++)
    if (strcmp(*other, key) == 0) return true;
  return false;
}

static gg_status apply(gg_scene_reader *r, const char *key, const yaml_node_t *name, const yaml_node_t *value);

static gg_status apply_members(gg_scene_reader *r, const char *section, const yaml_node_t *map)
{
  char key[GG_SCENE_KEY];
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, map, &e);) {
    if (!*section && is_for_others(r, e.word)) continue;
    GG_TRY(gg_scene_entry_key(r, &e, section, section, key));
    GG_TRY(apply(r, key, e.name, e.value));
  }
  return GG_OK;
}

static gg_status read_key(gg_scene_reader *r, int id, const gg_field *f, const char *key, const yaml_node_t *value)
{
  r->scene->given.bits[id / 64] |= (uint64_t)1 << id % 64;
  return gg_scene_read_value(r, f, key, value, r->scene);
}

static gg_status apply(gg_scene_reader *r, const char *key, const yaml_node_t *name, const yaml_node_t *value)
{
  int id = gg_scene_field_find(key);
  if (id >= 0) {
    if (r->line_of[id]) return gg_scene_reject(r, name, key, "is given twice, first on line %d", r->line_of[id]);
    r->line_of[id] = (int)name->start_mark.line + 1;
    return read_key(r, id, &gg_scene_fields[id], key, value);
  }
  if (!gg_scene_is_section(key)) return gg_scene_reject_key(r, name, key);
  if (value->type != YAML_MAPPING_NODE)
    return gg_scene_reject(r, value, key, "is a section: its keys go below it, indented");
  return apply_members(r, key, value);
}

static int step_of(yaml_token_type_t type)
{
  switch (type) {
  case YAML_BLOCK_SEQUENCE_START_TOKEN:
  case YAML_BLOCK_MAPPING_START_TOKEN:
  case YAML_FLOW_SEQUENCE_START_TOKEN:
  case YAML_FLOW_MAPPING_START_TOKEN: return 1;
  case YAML_BLOCK_END_TOKEN:
  case YAML_FLOW_SEQUENCE_END_TOKEN:
  case YAML_FLOW_MAPPING_END_TOKEN: return -1;
  default: return 0;
  }
}

/* Input limits: what is far beyond a scene is rejected before it is parsed, since libyaml takes a time quadratic in the
 * depth of brackets, in the anchors and in the directives of a text. Text that is not YAML passes: the parser rejects
 * it, with its place. */
static gg_status check_tokens(const gg_scene_reader *r, yaml_parser_t *parser)
{
  enum { MOST_TOKENS = 20000, DEEPEST = 16 }; /* the deepest of ours: collision: {e: {11: 1}}, 3 */
  yaml_token_type_t type = YAML_NO_TOKEN;
  for (int n = 0, depth = 0; type != YAML_STREAM_END_TOKEN; n++) {
    yaml_token_t token;
    if (!yaml_parser_scan(parser, &token)) return GG_OK;
    size_t line = token.start_mark.line + 1;
    type = token.type;
    yaml_token_delete(&token);
    depth += step_of(type);
    if (depth > DEEPEST)
      return gg_scene_reject_text(r, line, "is not a scene: lists and maps stand more than %d deep in each other",
                                  DEEPEST);
    if (n == MOST_TOKENS)
      return gg_scene_reject_text(r, line, "is not a scene: it has more than %d words and marks", MOST_TOKENS);
  }
  return GG_OK;
}

/* libyaml's word for what is wrong, with the line. */
static gg_status reject_syntax(const gg_scene_reader *r, const yaml_parser_t *parser)
{
  if (parser->error == YAML_MEMORY_ERROR || !parser->problem)
    return gg_base_error_prefix(r->err, gg_base_out_of_memory(r->err), "%s", r->name);
  const char *problem = parser->problem, *context = parser->context;
  size_t line = parser->problem_mark.line + 1;
  if (parser->error == YAML_READER_ERROR)
    return gg_scene_reject_text(r, 0, "is not a scene: no YAML text (%s at byte %zu)", problem, parser->problem_offset);
  if (parser->unread && *parser->buffer.pointer == '\t')
    return gg_scene_reject_text(r, line, "is not YAML: a tab cannot indent; use blanks");
  if (parser->error == YAML_SCANNER_ERROR && context) line = parser->context_mark.line + 1; /* what is open begins */
  return gg_scene_reject_text(r, line, "is not YAML: %s%s%s", problem, context ? " " : "", context ? context : "");
}

static gg_status check_end(const gg_scene_reader *r, yaml_parser_t *parser)
{
  yaml_document_t next;
  if (!yaml_parser_load(parser, &next)) return reject_syntax(r, parser);
  const bool more = yaml_document_get_root_node(&next) != NULL;
  yaml_document_delete(&next);
  return more ? gg_scene_reject_text(r, 0, "holds more than one document; a scene is one") : GG_OK;
}

static gg_status use_document(gg_scene_reader *r, yaml_parser_t *parser, const char *key, gg_scene_use *use)
{
  yaml_document_t document;
  if (!yaml_parser_load(parser, &document)) return reject_syntax(r, parser);
  r->document = &document;
  gg_status status = use(r, key, yaml_document_get_root_node(&document));
  if (status == GG_OK && yaml_document_get_root_node(&document)) status = check_end(r, parser);
  yaml_document_delete(&document);
  return status;
}

gg_status gg_scene_with_document(gg_scene_reader *r, const char *yaml, size_t length, const char *key,
                                 gg_scene_use *use)
{
  yaml_parser_t parser;
  gg_status status = GG_OK;
  if (length > GG_SCENE_MAX_BYTES) return gg_scene_reject_text(r, 0, "is not a scene: larger than 1 MiB");
  for (int pass = 0; pass < 2 && status == GG_OK; pass++) {
    if (!yaml_parser_initialize(&parser))
      return gg_base_error_prefix(r->err, gg_base_out_of_memory(r->err), "%s", r->name);
    yaml_parser_set_input_string(&parser, (const unsigned char *)yaml, length);
    status = pass == 0 ? check_tokens(r, &parser) : use_document(r, &parser, key, use);
    yaml_parser_delete(&parser);
  }
  return status;
}

gg_status gg_scene_with_value(gg_scene_reader *r, const char *key, const char *value, gg_scene_use *use)
{
  char word[61], name[80];
  gg_scene_quote(key, word, sizeof word);
  snprintf(name, sizeof name, "key '%s'", word);
  r->name = name;
  gg_status status = gg_scene_with_document(r, value, strlen(value), key, use);
  r->name = NULL;
  return status;
}

gg_status gg_scene_read_root(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  if (!root || (root->type == YAML_SCALAR_NODE && root->data.scalar.length == 0))
    return gg_scene_reject_text(r, 0, "is empty; a scene needs at least flow and phi");
  if (root->type != YAML_MAPPING_NODE)
    return gg_scene_reject_text(r, root->start_mark.line + 1, "is not a scene: lines of 'key: value' are expected");
  return apply_members(r, key, root);
}

gg_status gg_scene_read(gg_scene *scene, const char *yaml, size_t length, const char *name, gg_error *err)
{
  static const char *const others[] = {"theories", NULL}; /* api/scene_theories.h */
  gg_scene_reader r = {.name = name, .lines = true, .scene = scene, .others = others, .err = err};
  return gg_scene_with_document(&r, yaml, length, "", gg_scene_read_root);
}

static gg_status use_override(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  gg_field member;
  int number, used = 0;
  const int n = r->scene->n_species, id = gg_scene_key_find(key, n, &member);
  if (!root) return gg_scene_reject(r, root, key, "no value is given");
  if (id >= 0) return read_key(r, id, &member, key, root);
  if (sscanf(key, "species.%d.%n", &number, &used) != 1 || !used) return apply(r, key, root, root);
  if (number < 1 || number > n) return gg_scene_reject(r, root, key, "this scene has %d species", n);
  return gg_scene_reject_key(r, root, key);
}

gg_status gg_scene_override(gg_scene *scene, const char *key, const char *value, gg_error *err)
{
  gg_scene changed = *scene;
  gg_scene_reader r = {.scene = &changed, .err = err};
  GG_TRY(gg_scene_with_value(&r, key, value, use_override));
  *scene = changed;
  return GG_OK;
}

enum { MAX_BYTES = GG_SCENE_MAX_BYTES + 1 }; /* enough to see that it is too large */

/* All of an open file, or what is wrong with it. */
static gg_status read_text(int fd, const char *path, char *text, size_t *length, gg_error *err)
{
  struct stat about;
  if (fstat(fd, &about) == 0 && S_ISDIR(about.st_mode))
    return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: it is a folder", path);
  *length = 0;
  for (ssize_t got = 1; got != 0 && *length < MAX_BYTES;) {
    got = read(fd, text + *length, MAX_BYTES - *length);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    *length += (size_t)got;
  }
  if (*length >= 8 && memcmp(text, "\x89HDF\r\n\x1a\n", 8) == 0)
    return GG_REFUSE(err, "%s: is an HDF5 file, not a scene (for a result: graingas info, graingas plot)", path);
  return GG_OK;
}

gg_status gg_scene_file_text(const char *path, char **out, size_t *length, gg_error *err)
{
  bool standard = strcmp(path, "-") == 0;
  int fd = standard ? dup(STDIN_FILENO) : open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
  GG_FREED char *text = gg_base_array_new(MAX_BYTES + 1, 1, err); /* ends with a zero */
  gg_status status = text ? read_text(fd, path, text, length, err) : GG_FAILED;
  close(fd);
  if (status == GG_OK) GG_HAND_OVER(out, text);
  return status;
}

const char *gg_scene_file_name(const char *path)
{
  return strcmp(path, "-") == 0 ? "standard input" : path;
}
