/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of a slab that grow, and the moves of its events between buckets. */
#include "md/parallel/slab.h"

#include <stdlib.h>
#include <string.h>

void *gg_md_append(gg_md_slab *s, gg_md_growing *list, size_t size)
{
  if (list->n == list->room) {
    const uint32_t room = list->room ? 2 * list->room : 64;
    void *item = aligned_alloc(64, room * size); /* items begin on cache lines, which realloc does not keep */
    if (!item) {
      s->out_of_memory = true;
      return &s->spare;
    }
    if (list->n) memcpy(item, list->item, list->n * size);
    free(list->item);
    list->item = item;
    list->room = room;
  }
  return (char *)list->item + size * list->n++;
}

void gg_md_add_due(gg_md_slab *s, gg_md_growing *list, gg_md_due due)
{
  *(gg_md_due *)gg_md_append(s, list, sizeof due) = due;
}

void gg_md_add_fresh(gg_md_slab *s, gg_md_due due)
{
  gg_md_add_due(s, &s->fresh, due);
  if (s->out_of_memory) return;
  gg_md_due *item = s->fresh.item;
  uint32_t k = s->fresh.n - 1;
  for (; k > 0 && gg_md_is_before(item[k - 1], due); k--) item[k] = item[k - 1];
  item[k] = due;
}

static void move(gg_md_slab *s, uint32_t bucket, uint32_t grain, uint32_t out)
{
  gg_md_growing *moves = &s->moves[s->phase - 1][bucket / 8 % (uint32_t)s->all->n_slabs];
  const uint64_t order = (uint64_t)(s->phase * GG_MD_MOST_SLABS + s->self) << 32 | s->n_moves++;
  *(gg_md_move *)gg_md_append(s, moves, sizeof(gg_md_move)) = (gg_md_move){bucket | out, grain, order};
}

void gg_md_requeue(gg_md_slab *s, uint32_t grain, double from, double to)
{
  const gg_md_queue *q = &s->all->engine->queue;
  const uint32_t before = gg_md_bucket_of(q, from), after = gg_md_bucket_of(q, to), end = s->all->end;
  if (before >= end && before < q->n_buckets) move(s, before, grain, GG_MD_OUT);
  if (after < end)
    gg_md_add_fresh(s, (gg_md_due){to, grain});
  else if (after < q->n_buckets)
    move(s, after, grain, 0);
}
