/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An archive: named arrays in memory, the state of an engine or a run, as checkpoints store and restore it. Files are
 * none of its business: src/io writes it to HDF5. The archive owns copies of everything put into it. */
#ifndef GG_ARCHIVE_H
#define GG_ARCHIVE_H

#include "base/cancellation.h"

typedef enum gg_item_type {
  GG_ITEM_F64,
  GG_ITEM_I64,
  GG_ITEM_U64,
  GG_ITEM_U8,
  GG_ITEM_F32,
  GG_ITEM_TYPES
} gg_item_type;

typedef struct gg_item {
  char name[64]; /* "md/grains": may hold one level of folders */
  gg_item_type type;
  size_t count;
  void *data;
} gg_item;

typedef struct gg_archive {
  gg_item *items;
  size_t n_items, capacity;
  const gg_stop *stop; /* borrowed: asked at every item that goes in or out; NULL: never */
} gg_archive;

size_t gg_base_archive_item_size(gg_item_type type);

/* Copy `count` items in under a new name. Plain structs go in as bytes: GG_ITEM_U8, sizeof. */
gg_status gg_base_archive_put(gg_archive *a, const char *name, gg_item_type type, const void *data, size_t count,
                              gg_error *err);
/* Copy out an array that must be there with this type and count; GG_BAD_FILE says what is wrong. */
gg_status gg_base_archive_get(const gg_archive *a, const char *name, gg_item_type type, void *data, size_t count,
                              gg_error *err);
/* The item of that name, or NULL. */
const gg_item *gg_base_archive_find(const gg_archive *a, const char *name);
void gg_base_archive_clear(gg_archive *a);

/* Copy every item of `from` into `to` under prefix/name, and back those that stand under a prefix. */
gg_status gg_base_archive_nest(gg_archive *to, const char *prefix, const gg_archive *from, gg_error *err);
gg_status gg_base_archive_unnest(gg_archive *to, const char *prefix, const gg_archive *from, gg_error *err);
/* Copy every item of `from` into `to`. */
gg_status gg_base_archive_append(gg_archive *to, const gg_archive *from, gg_error *err);

#endif
