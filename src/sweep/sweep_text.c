/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep as the text that it can be read from again: the scene's keys that were given, `vary` and `sweep`. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "io/file_writer.h"
#include "scene/fields.h"
#include "sweep/folder.h"

/* The keys that were given, as JSON: a default that is written out can have another effect than a key left out. */
static json_t *given_json(const gg_scene *base)
{
  json_t *root = gg_scene_json(base);
  for (const gg_field *f = gg_scene_fields; root && f->key; f++) {
    const char *dot = strchr(f->key, '.');
    char section[32];
    snprintf(section, sizeof section, "%.*s", dot ? (int)(dot - f->key) : 0, f->key);
    json_t *in = dot ? json_object_get(root, section) : root;
    if (!gg_scene_is_given(base, f->key)) json_object_del(in, dot ? dot + 1 : f->key);
    if (dot && json_object_size(in) == 0) json_object_del(root, section);
  }
  return root;
}

/* Rows of keys that change together. */
static void print_varied(FILE *out, const gg_varied *v)
{
  for (size_t k = 0; k < v->n_keys; k++) {
    fprintf(out, "  %s %s: [", k ? " " : "-", v->key[k]);
    for (size_t i = 0; i < v->n; i++) fprintf(out, "%s%s", i ? ", " : "", v->value[i * v->n_keys + k]);
    fputs("]\n", out);
  }
}

static char *text_of(const gg_sweep *sweep)
{
  char *text = NULL;
  const unsigned before = gg_base_memory_failures();
  FILE *out = gg_base_memory_stream_open(&text);
  json_auto_t *given = given_json(sweep->base);
  if (out && given) {
    fputs("# Written by graingas sweep: graingas sweep FOLDER reads it.\n", out);
    gg_scene_yaml_print(out, given);
    fprintf(out, "vary:\n");
    for (size_t f = 0; f < sweep->n_varied; f++) print_varied(out, &sweep->varied[f]);
    gg_sweep_settings_print(out, &sweep->settings);
  }
  if (gg_base_memory_stream_close(out, &text) && gg_base_memory_failures() == before) return text;
  free(text);
  return NULL;
}

/* True if the file holds this text: tasks of a cluster start together, and one of them writes it. */
static bool holds(const char *path, const char *text)
{
  GG_CLOSED FILE *in = fopen(path, "r");
  const size_t length = strlen(text);
  GG_FREED char *found = in ? malloc(length + 2) : NULL;
  return found && fread(found, 1, length + 2, in) == length && memcmp(found, text, length) == 0;
}

static gg_status write_text(const char *path, const char *text, gg_error *err)
{
  gg_atomic_file file = GG_ATOMIC_NONE;
  gg_status status = gg_io_atomic_open(&file, path, true, err);
  file.repeated = true;
  if (status == GG_OK) status = gg_io_atomic_write(&file, text, strlen(text), err);
  return gg_io_atomic_commit(&file, status, err);
}

gg_status gg_sweep_folder_note(const gg_sweep *sweep, const char *folder, gg_error *err)
{
  char path[PATH_MAX];
  gg_file_lock lock = GG_FILE_LOCK_NONE;
  if (!gg_sweep_folder_text_path(folder, path)) return GG_OK;
  GG_FREED char *text = text_of(sweep);
  if (!text) return gg_base_out_of_memory(err);
  gg_status status = gg_io_file_lock_take(&lock, path, path, err); /* removes what a dead process left */
  if (status == GG_OK && !holds(path, text)) status = write_text(path, text, err);
  if (lock.busy) status = GG_OK; /* another process is writing the same */
  gg_io_file_lock_release(&lock);
  return status;
}

bool gg_sweep_folder_text_path(const char *folder, char *path)
{
  return snprintf(path, PATH_MAX, "%s/sweep.yaml", folder) < PATH_MAX;
}
