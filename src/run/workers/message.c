/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/workers/message.h"
#include "base/build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t padded(size_t n)
{
  return (n + 7) & ~(size_t)7;
}

void *gg_run_message_pack(const gg_run_message *head, const void *bytes, size_t n, size_t *size)
{
  *size = sizeof *head + n;
  char *block = malloc(*size);
  if (!block) return NULL;
  memcpy(block, head, sizeof *head);
  if (n) memcpy(block + sizeof *head, bytes, n);
  return block;
}

static size_t bytes_of(const gg_item *item)
{
  return item->count * gg_base_archive_item_size(item->type);
}

/* Item after item: the item's own struct (its pointer means nothing there), then its data. */
void *gg_run_message_pack_archive(const gg_run_message *head, const gg_archive *a, size_t *size)
{
  *size = sizeof *head;
  for (size_t i = 0; i < a->n_items; i++) *size += sizeof *a->items + padded(bytes_of(&a->items[i]));
  char *block = calloc(1, *size), *to = block;
  if (!block) return NULL;
  memcpy(to, head, sizeof *head), to += sizeof *head;
  for (size_t i = 0; i < a->n_items; i++) {
    memcpy(to, &a->items[i], sizeof *a->items), to += sizeof *a->items;
    if (bytes_of(&a->items[i])) memcpy(to, a->items[i].data, bytes_of(&a->items[i]));
    to += padded(bytes_of(&a->items[i]));
  }
  return block;
}

bool gg_run_message_read(const void *block, size_t size, gg_run_message *head)
{
  if (size < sizeof *head) return false;
  memcpy(head, block, sizeof *head);
  return head->kind >= 0 && head->kind < GG_MESSAGE_KINDS;
}

static gg_status broken(gg_error *err)
{
  return gg_base_fail(err, GG_FAILED, "a message between processes arrived broken");
}

gg_status gg_run_message_archive(const void *block, size_t size, gg_archive *archive, gg_error *err)
{
  const char *at = (const char *)block + sizeof(gg_run_message), *end = (const char *)block + size;
  while (at < end) {
    gg_item item;
    if ((size_t)(end - at) < sizeof item) return broken(err);
    memcpy(&item, at, sizeof item), at += sizeof item;
    item.name[sizeof item.name - 1] = 0;
    if ((unsigned)item.type >= GG_ITEM_TYPES || item.count > (size_t)(end - at)) return broken(err);
    if (padded(bytes_of(&item)) > (size_t)(end - at)) return broken(err);
    GG_TRY(gg_base_archive_put(archive, item.name, item.type, at, item.count, err));
    at += padded(bytes_of(&item));
  }
  return GG_OK;
}

gg_status gg_run_message_scene(const void *block, size_t size, gg_scene *scene, gg_error *err)
{
  if (size != sizeof(gg_run_message) + sizeof *scene) return broken(err);
  memcpy(scene, (const char *)block + sizeof(gg_run_message), sizeof *scene);
  scene->extension = NULL;
  return GG_OK;
}

void gg_run_message_build(char *text, size_t size)
{
  snprintf(text, size, "%s %s, %zu %zu %zu", gg_base_build_version, gg_base_build_identity, sizeof(gg_scene),
           sizeof(struct gg_replica_clock), sizeof(gg_run_message));
}

int gg_run_message_nap(int last, bool any)
{
  enum { LEAST = 20, MOST = 1000 };
  return any || last < LEAST ? LEAST : last < MOST ? last + last / 4 + 1 : MOST;
}
