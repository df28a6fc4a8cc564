/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The archive in a checkpoint, items of it changed: what a run makes of it that goes on from there for some samples,
 * and of what it saves then. The first byte chooses the run; the second an item to be cut or made longer, or none; the
 * rest are records (patch.h), each with the item before it. */
#include <stdlib.h>

#include "base.h"
#include "fuzz.h"
#include "patch.h"
#include "graingas.h"

enum { LOOKS = 6, RECORD = 1 + FUZZ_RECORD };

static bool enough(void *context)
{
  return ++*(int *)context > LOOKS;
}

static gg_status save(void *context, gg_archive *archive, gg_error *err)
{
  (void)context, (void)archive, (void)err;
  return GG_OK;
}

/* Items of the scene are compared with the scene's alone, and are left as they are mostly. */
static gg_item *item_of(gg_archive *a, uint8_t which)
{
  size_t first = 0;
  while (first < a->n_items && strncmp(a->items[first].name, "scene/", 6) == 0) first++;
  if (which == 255 || first == a->n_items) first = 0;
  return &a->items[first + which % (a->n_items - first)];
}

static void change(gg_archive *a, const uint8_t *data, size_t size)
{
  for (int k = 0; k < FUZZ_MOST_RECORDS && size >= RECORD; k++, data += RECORD, size -= RECORD) {
    gg_item *item = item_of(a, data[0]);
    fuzz_patch(item->data, item->count * gg_base_archive_item_size(item->type), NULL, 0, data + 1, FUZZ_RECORD);
  }
}

/* Shorter or longer by one, or of another type. */
static void bend(gg_archive *a, uint8_t how)
{
  if (how < 128) return;
  gg_item *item = item_of(a, how & 63);
  if (how & 64)
    item->type = item->type == GG_ITEM_U8 ? GG_ITEM_F64 : GG_ITEM_U8;
  else
    item->count -= item->count > 0;
  if (item->type == GG_ITEM_F64 && how & 64) item->count /= 8;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  if (size < 2) return 0;
  const fuzz_base *base = fuzz_base_of(data[0]);
  gg_archive a = {0};
  gg_result *result = NULL;
  gg_error err;
  int looks = 0;
  const gg_run_callbacks hooks = {.context = &looks, .interrupted = enough, .checkpoint = save};
  if (gg_base_archive_append(&a, &base->archive, NULL) == GG_OK) {
    bend(&a, data[1]);
    change(&a, data + 2, size - 2);
    gg_run_scene(&base->scene, &a, 1, &hooks, &result, &err);
  }
  gg_result_free(result);
  gg_base_archive_clear(&a);
  return 0;
}
