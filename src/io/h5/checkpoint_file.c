#include "io/h5/checkpoint_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io/atomic_file.h"
#include "io/checksum.h"
#include "io/h5/h5.h"
#include "io/scene/json.h"

static const struct {
  const char *name;
} item_types[] = {[GG_ITEM_F64] = {"f64"},
                  [GG_ITEM_I64] = {"i64"},
                  [GG_ITEM_U64] = {"u64"},
                  [GG_ITEM_U8] = {"u8"},
                  [GG_ITEM_F32] = {"f32"}};

static hid_t type_of(gg_item_type type)
{
  switch (type) {
  case GG_ITEM_F64: return H5T_NATIVE_DOUBLE;
  case GG_ITEM_I64: return H5T_NATIVE_INT64;
  case GG_ITEM_U64: return H5T_NATIVE_UINT64;
  case GG_ITEM_F32: return H5T_NATIVE_FLOAT;
  case GG_ITEM_U8:
  case GG_ITEM_TYPES: break;
  }
  return H5T_NATIVE_UINT8;
}

static uint64_t checksum(const gg_archive *a)
{
  uint64_t sum = GG_CHECKSUM_START;
  for (size_t i = 0; i < a->n_items; i++) {
    const gg_item *item = &a->items[i];
    sum = gg_checksum(sum, item->name, strlen(item->name));
    sum = gg_checksum(sum, &item->count, sizeof item->count);
    sum = gg_checksum(sum, item->data, item->count * gg_item_size(item->type));
  }
  return sum;
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
    gg_h5_text_attribute(h, path, "type", item_types[item->type].name);
  }
}

gg_status gg_checkpoint_write(const char *path, const gg_archive *a, const gg_scene *scene, gg_error *err)
{
  gg_h5 h;
  gg_atomic_file file;
  uint64_t sum = checksum(a), n = a->n_items;
  size_t size = 0;
  GG_TRY(gg_atomic_open(&file, path, err));
  char *yaml = gg_scene_yaml(scene), *before = NULL;
  gg_h5_create_in_memory(&h, file.temporary);
  gg_h5_text(&h, "/checkpoint/scene", yaml ? yaml : "");
  gg_h5_text(&h, "/checkpoint/version", GG_VERSION);
  gg_h5_attribute(&h, "/checkpoint", "items", H5T_NATIVE_UINT64, &n, 0);
  gg_h5_attribute(&h, "/checkpoint", "checksum", H5T_NATIVE_UINT64, &sum, 0);
  write_items(&h, a);
  void *image = gg_h5_image(&h, &size);
  gg_h5_close(&h);
  gg_status status = gg_h5_status(&h, path, "written", err);
  if (status == GG_OK) status = gg_atomic_write(&file, image, size, err);
  free(image);
  free(yaml);
  /* The one before gives way only once this one is safe on the disk. */
  if (status == GG_OK && fsync(file.fd) == 0 && asprintf(&before, "%s.1", path) >= 0) {
    rename(path, before); /* fails the first time: there is none */
    free(before);
  }
  if (status == GG_OK) return gg_atomic_commit(&file, err);
  gg_atomic_abandon(&file);
  return status;
}

static char *read_text_attribute(gg_h5 *h, const char *object, const char *name)
{
  char *text = NULL;
  hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  gg_h5_read_attribute(h, object, name, type, &text);
  H5Tclose(type);
  return text;
}

static gg_status read_item(gg_h5 *h, size_t i, gg_archive *a, gg_error *err)
{
  char path[48];
  snprintf(path, sizeof path, "/checkpoint/%zu", i);
  char *name = read_text_attribute(h, path, "name"), *word = read_text_attribute(h, path, "type");
  gg_status status = GG_OK;
  int type = 0;
  while (!h->failed && type < GG_ITEM_TYPES && strcmp(item_types[type].name, word) != 0) type++;
  if (!h->failed && type < GG_ITEM_TYPES) {
    size_t count;
    void *data = gg_h5_read_array(h, path, type_of((gg_item_type)type), gg_item_size((gg_item_type)type), &count);
    if (data) status = gg_archive_put(a, name, (gg_item_type)type, data, count, err);
    free(data);
  }
  if (name) H5free_memory(name);
  if (word) H5free_memory(word);
  return status;
}

/* States are saved as they stand in memory, which another version may have laid out otherwise. */
static void check_version(gg_h5 *h)
{
  char *version = gg_h5_read_text(h, "/checkpoint/version"), why[160];
  if (version && strcmp(version, GG_VERSION) != 0) {
    snprintf(why, sizeof why, "graingas %.20s has written it, and this is graingas %s; only the same version can go on",
             version, GG_VERSION);
    gg_h5_failed(h, why);
  }
  free(version);
}

static gg_status read_file(const char *path, gg_archive *a, gg_error *err)
{
  gg_h5 h;
  uint64_t n = 0, sum = 0;
  gg_status status = GG_OK;
  FILE *there = fopen(path, "r");
  if (!there) return gg_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
  fclose(there);
  gg_h5_open(&h, path);
  if (!h.failed && !gg_h5_exists(&h, "/checkpoint")) gg_h5_failed(&h, "it is not a checkpoint of graingas");
  check_version(&h);
  gg_h5_read_attribute(&h, "/checkpoint", "items", H5T_NATIVE_UINT64, &n);
  gg_h5_read_attribute(&h, "/checkpoint", "checksum", H5T_NATIVE_UINT64, &sum);
  for (uint64_t i = 0; i < n && status == GG_OK && !h.failed; i++) status = read_item(&h, i, a, err);
  if (status == GG_OK && !h.failed && checksum(a) != sum)
    gg_h5_failed(&h, "its checksum does not match: it is damaged");
  gg_h5_close(&h);
  if (status == GG_OK) status = gg_h5_status(&h, path, "read", err);
  if (status != GG_OK) gg_archive_clear(a);
  return status;
}

gg_status gg_checkpoint_read(const char *path, gg_archive *a, bool *older, gg_error *err)
{
  gg_status status = read_file(path, a, err);
  char *before = NULL;
  *older = false;
  if (status != GG_BAD_FILE || asprintf(&before, "%s.1", path) < 0) return status;
  gg_error second;
  *older = read_file(before, a, &second) == GG_OK;
  free(before);
  return *older ? GG_OK : status;
}

char *gg_checkpoint_path(const char *result_path)
{
  char *path = NULL;
  size_t length = strlen(result_path);
  if (length > 3 && strcmp(result_path + length - 3, ".h5") == 0) length -= 3;
  return asprintf(&path, "%.*s.checkpoint.h5", (int)length, result_path) < 0 ? NULL : path;
}
