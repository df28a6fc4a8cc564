/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/archive.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

size_t gg_base_archive_item_size(gg_item_type type)
{
  return type == GG_ITEM_U8 ? 1 : type == GG_ITEM_F32 ? 4 : 8;
}

static gg_status look(const gg_archive *a, gg_error *err)
{
  return a->stop ? gg_stop_check(a->stop, err) : GG_OK;
}

static gg_status grow(gg_archive *a, gg_error *err)
{
  if (a->n_items < a->capacity) return GG_OK;
  size_t capacity = a->capacity ? 2 * a->capacity : 16;
  gg_item *items = realloc(a->items, capacity * sizeof *items);
  if (!items) return gg_base_out_of_memory_for(err, "a checkpoint of %zu items", capacity);
  a->items = items;
  a->capacity = capacity;
  return GG_OK;
}

gg_status gg_base_archive_put(gg_archive *a, const char *name, gg_item_type type, const void *data, size_t count,
                              gg_error *err)
{
  GG_TRY(look(a, err));
  if (gg_base_archive_find(a, name)) return gg_base_fail(err, GG_FAILED, "checkpoint item '%s' was put twice", name);
  GG_TRY(grow(a, err));
  gg_item item = {.type = type, .count = count};
  snprintf(item.name, sizeof item.name, "%s", name);
  item.data = gg_base_array_new(count, gg_base_archive_item_size(type), err);
  if (!item.data) return GG_FAILED;
  if (count) memcpy(item.data, data, count * gg_base_archive_item_size(type));
  a->items[a->n_items++] = item;
  return GG_OK;
}

const gg_item *gg_base_archive_find(const gg_archive *a, const char *name)
{
  for (size_t i = 0; i < a->n_items; i++)
    if (strcmp(a->items[i].name, name) == 0) return &a->items[i];
  return NULL;
}

gg_status gg_base_archive_get(const gg_archive *a, const char *name, gg_item_type type, void *data, size_t count,
                              gg_error *err)
{
  const gg_item *item = gg_base_archive_find(a, name);
  GG_TRY(look(a, err));
  if (!item)
    return gg_base_fail(err, GG_BAD_FILE,
                        "the checkpoint lacks '%s': another version wrote it, or it belongs to another kind of run",
                        name);
  if (item->type != type)
    return gg_base_fail(err, GG_BAD_FILE, "the checkpoint's '%s' holds numbers of another type than is needed", name);
  if (item->count != count)
    return gg_base_fail(err, GG_BAD_FILE,
                        "the checkpoint's '%s' holds %zu items where %zu are needed: another version wrote it, or it "
                        "belongs to another kind of run",
                        name, item->count, count);
  if (count) memcpy(data, item->data, count * gg_base_archive_item_size(type));
  return GG_OK;
}

void gg_base_archive_clear(gg_archive *a)
{
  for (size_t i = 0; i < a->n_items; i++) free(a->items[i].data);
  free(a->items);
  *a = (gg_archive){.stop = a->stop};
}

gg_status gg_base_archive_nest(gg_archive *to, const char *prefix, const gg_archive *from, gg_error *err)
{
  for (size_t i = 0; i < from->n_items; i++) {
    const gg_item *item = &from->items[i];
    char name[sizeof item->name];
    if ((size_t)snprintf(name, sizeof name, "%s/%s", prefix, item->name) >= sizeof name)
      return gg_base_fail(err, GG_FAILED, "checkpoint item name '%s/%s' is too long", prefix, item->name);
    GG_TRY(gg_base_archive_put(to, name, item->type, item->data, item->count, err));
  }
  return GG_OK;
}

gg_status gg_base_archive_unnest(gg_archive *to, const char *prefix, const gg_archive *from, gg_error *err)
{
  size_t length = strlen(prefix);
  for (size_t i = 0; i < from->n_items; i++) {
    const gg_item *item = &from->items[i];
    if (strncmp(item->name, prefix, length) != 0 || item->name[length] != '/') continue;
    GG_TRY(gg_base_archive_put(to, item->name + length + 1, item->type, item->data, item->count, err));
  }
  return GG_OK;
}

gg_status gg_base_archive_append(gg_archive *to, const gg_archive *from, gg_error *err)
{
  for (size_t i = 0; i < from->n_items; i++)
    GG_TRY(gg_base_archive_put(to, from->items[i].name, from->items[i].type, from->items[i].data, from->items[i].count,
                               err));
  return GG_OK;
}
