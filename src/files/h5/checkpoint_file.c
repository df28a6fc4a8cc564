/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/h5/checkpoint_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/build.h"
#include "base/memory.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_reader.h"
#include "files/h5/hdf5_writer.h"
#include "io/atomic_file.h"
#include "scene/fields.h"

static const char *const item_types[] = {
    [GG_ITEM_F64] = "f64", [GG_ITEM_I64] = "i64", [GG_ITEM_U64] = "u64", [GG_ITEM_U8] = "u8", [GG_ITEM_F32] = "f32"};

static hid_t type_of(gg_item_type type)
{
  const hid_t types[] = {[GG_ITEM_F64] = H5T_NATIVE_DOUBLE,
                         [GG_ITEM_I64] = H5T_NATIVE_INT64,
                         [GG_ITEM_U64] = H5T_NATIVE_UINT64,
                         [GG_ITEM_U8] = H5T_NATIVE_UINT8,
                         [GG_ITEM_F32] = H5T_NATIVE_FLOAT};
  return types[type];
}

/* Items are numbered, so that they come back in order; their names are attributes. */
static void write_items(gg_h5 *h, const gg_archive *a)
{
  for (size_t i = 0; i < a->n_items; i++) {
    const gg_item *item = &a->items[i];
    char path[48];
    hsize_t count = item->count;
    snprintf(path, sizeof path, "/checkpoint/%zu", i);
    gg_h5_array(h, path, type_of(item->type), 1, &count, item->data);
    gg_h5_text_attribute(h, path, "name", item->name);
    gg_h5_text_attribute(h, path, "type", item_types[item->type]);
  }
}

static gg_status make_image(const char *path, const gg_archive *a, const gg_scene *scene, void **image, size_t *size,
                            gg_error *err)
{
  gg_h5 h;
  uint64_t n = a->n_items;
  const int layout = GG_CHECKPOINT_LAYOUT;
  GG_FREED char *yaml = gg_scene_yaml(scene);
  gg_h5_create(&h, NULL);
  h.stop = a->stop;
  if (!yaml) gg_h5_failed(&h, "out of memory");
  gg_h5_text(&h, "/checkpoint/scene", yaml ? yaml : "");
  gg_h5_text(&h, "/checkpoint/version", gg_base_build_version);
  gg_h5_text_attribute(&h, "/checkpoint/version", "identity", gg_base_build_identity);
  gg_h5_attribute(&h, "/checkpoint/version", "layout", H5T_NATIVE_INT, &layout, 0);
  gg_h5_attribute(&h, "/checkpoint", "items", H5T_NATIVE_UINT64, &n, 0);
  write_items(&h, a);
  *image = gg_h5_image(&h, size);
  gg_h5_close(&h);
  return gg_h5_status(&h, path, "written", err);
}

/* The one before gives way only once this one is safe on the disk. A disk error is reported once: who asks again
 * hears that all is well. */
static gg_status keep_before(const gg_atomic_file *file, gg_error *err)
{
  GG_FREED char *before = NULL;
  if (fsync(file->fd) != 0) return gg_io_path_write_error(file->path, strerror(errno), err);
  if (asprintf(&before, "%s.1", file->place.target) < 0) return before = NULL, gg_base_out_of_memory(err);
  bool kept = rename(file->place.target, before) == 0 || errno == ENOENT; /* the first time there is none */
  return kept ? GG_OK : gg_io_path_write_error(file->path, strerror(errno), err);
}

gg_status gg_files_checkpoint_write(const char *path, bool locked, bool keep, const gg_archive *a,
                                    const gg_scene *scene, gg_error *err)
{
  gg_atomic_file file;
  size_t size = 0;
  GG_TRY(gg_io_atomic_open(&file, path, locked, err));
  file.repeated = locked;
  GG_FREED void *image = NULL;
  gg_status status = make_image(path, a, scene, &image, &size, err);
  if (status == GG_OK && file.place.stream)
    status = gg_base_fail(err, GG_BAD_FILE, "%s: is a device or a pipe; " GG_CHECKPOINTS_ARE, path);
  if (status == GG_OK) status = gg_files_checksum_trailer_write(&file, image, size, a->stop, err);
  if (status == GG_OK && a->stop && gg_stop_asked(a->stop))
    status = gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted", path);
  if (status == GG_OK && keep) status = keep_before(&file, err);
  GG_TRY(gg_io_atomic_commit(&file, status, err));
  return keep ? GG_OK : gg_files_checkpoint_remove_before(path, err);
}

static gg_status read_item(gg_h5_in *h, size_t i, gg_archive *a, gg_error *err)
{
  char path[48];
  snprintf(path, sizeof path, "/checkpoint/%zu", i);
  GG_FREED char *name = gg_h5_read_text_attribute(h, path, "name");
  GG_FREED char *word = gg_h5_read_text_attribute(h, path, "type");
  int type = 0;
  size_t count;
  while (!h->failed && type < GG_ITEM_TYPES && strcmp(item_types[type], word) != 0) type++;
  if (h->failed || type == GG_ITEM_TYPES) return GG_OK;
  GG_FREED void *data = gg_h5_read_array(h, path, (gg_item_type)type, &count);
  return data ? gg_base_archive_put(a, name, (gg_item_type)type, data, count, err) : GG_OK;
}

/* An open file, which is closed. */
static gg_status read_all(gg_h5_in *in, const char *path, bool any_build, gg_archive *a, gg_error *err)
{
  uint64_t n = 0;
  gg_status status = GG_OK;
  if (!in->failed && !gg_h5_exists(in, "/checkpoint")) gg_h5_in_failed(in, "it is not a checkpoint of graingas");
  gg_files_checkpoint_check_version(in, any_build);
  gg_h5_read_attribute(in, "/checkpoint", "items", GG_ITEM_U64, &n);
  for (uint64_t i = 0; i < n && status == GG_OK && !in->failed; i++) status = read_item(in, i, a, err);
  gg_h5_in_close(in);
  if (status == GG_OK) status = gg_h5_in_status(in, path, err);
  if (status != GG_OK) gg_base_archive_clear(a);
  return status;
}

static gg_status read_file(const char *path, bool any_build, gg_archive *a, gg_error *err)
{
  gg_h5_in in;
  gg_h5_open(&in, path, false);
  return read_all(&in, path, any_build, a, err);
}

gg_status gg_files_checkpoint_from_bytes(const void *bytes, size_t size, gg_archive *a, gg_error *err)
{
  gg_h5_in in;
  gg_h5_open_bytes(&in, bytes, size);
  return read_all(&in, "the bytes", false, a, err);
}

gg_status gg_files_checkpoint_to_bytes(const gg_archive *a, const gg_scene *scene, void **bytes, size_t *size,
                                       gg_error *err)
{
  size_t image_size = 0;
  void *image = NULL;
  gg_status status = make_image("the simulation", a, scene, &image, &image_size, err);
  if (status != GG_OK) return free(image), status == GG_INTERRUPTED ? status : GG_FAILED;
  if (!(image = gg_files_checksum_trailer_append(image, image_size, err))) return GG_FAILED;
  *bytes = image, *size = image_size + GG_TRAILER_SIZE;
  return GG_OK;
}

gg_status gg_files_checkpoint_read(const char *path, bool any_build, gg_archive *a, bool *older, gg_error *err)
{
  gg_status status = read_file(path, any_build, a, err);
  *older = false;
  if (status != GG_BAD_FILE) return status;
  GG_FREED char *before = gg_files_checkpoint_before(path);
  if (before) *older = read_file(before, any_build, a, NULL) == GG_OK;
  return *older ? GG_OK : status;
}

char *gg_files_checkpoint_before(const char *path)
{
  GG_FREED char *target = gg_io_path_follow_links(path);
  char *before = NULL;
  if (target && asprintf(&before, "%s.1", target) < 0) gg_base_memory_lacked(), before = NULL;
  return before;
}

bool gg_files_checkpoint_is_of(const char *file, const char *path)
{
  if (gg_io_path_is_same_file(file, path)) return true;
  GG_FREED char *before = gg_files_checkpoint_before(path);
  return gg_io_path_is_same_file(file, before);
}

char *gg_files_checkpoint_scene(const char *path, bool older)
{
  GG_CLEARED(gg_h5_in_close) gg_h5_in h = {.fd = -1};
  GG_FREED char *before = NULL;
  if (older && asprintf(&before, "%s.1", path) < 0) return before = NULL;
  gg_h5_open(&h, older ? before : path, false);
  return gg_h5_read_text(&h, "/checkpoint/scene");
}

gg_status gg_files_checkpoint_remove_before(const char *path, gg_error *err)
{
  GG_FREED char *before = gg_files_checkpoint_before(path);
  if (!before) return gg_base_out_of_memory(err);
  return unlink(before), GG_OK;
}
