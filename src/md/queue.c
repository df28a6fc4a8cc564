#include "md/queue.h"

#include <stdlib.h>

#include "md/cells.h"

enum { FEWEST_BUCKETS = 64, SMALL = 64, AHEAD = 3 };

gg_status gg_queue_make(gg_queue *q, uint32_t n, gg_error *err)
{
  *q = (gg_queue){.n_buckets = n > FEWEST_BUCKETS ? 4 * n : 4 * FEWEST_BUCKETS};
  q->head = gg_md_new_lines((size_t)q->n_buckets + 1, sizeof *q->head, err);
  q->due = gg_new_array((size_t)n + 1, sizeof *q->due, err);
  if (!q->head || !q->due) return GG_FAILED;
  gg_queue_reset(q, 1);
  return GG_OK;
}

void gg_queue_free(gg_queue *q)
{
  free(q->head);
  free(q->due);
  *q = (gg_queue){0};
}

void gg_queue_reset(gg_queue *q, double width)
{
  q->width = width;
  q->inverse_width = 1 / width;
  q->current = 0;
  q->n_due = 0;
  for (uint32_t b = 0; b <= q->n_buckets; b++) q->head[b] = GG_NONE;
}

/* The same time always falls into the same bucket: removal finds it again. */
static uint32_t bucket_of(const gg_queue *q, double time)
{
  double b = time * q->inverse_width;
  return b < q->n_buckets ? (uint32_t)b : q->n_buckets;
}

/* Equal times go by the grain's index, so that the order never depends on the history of the calendar. */
static bool is_before(gg_due a, gg_due b)
{
  return a.time < b.time || (a.time == b.time && a.grain < b.grain);
}

static void insert_due(gg_queue *q, gg_due new)
{
  uint32_t k = q->n_due++;
  for (; k > 0 && is_before(q->due[k - 1], new); k--) q->due[k] = q->due[k - 1];
  q->due[k] = new;
}

static void remove_due(gg_queue *q, uint32_t grain)
{
  uint32_t k = q->n_due - 1;
  while (q->due[k].grain != grain) k--;
  q->n_due--;
  for (; k < q->n_due; k++) q->due[k] = q->due[k + 1];
}

void gg_queue_insert(gg_queue *q, gg_node *node, uint32_t grain)
{
  uint32_t b = bucket_of(q, node[grain].time);
  if (b <= q->current) {
    insert_due(q, (gg_due){node[grain].time, grain});
    return;
  }
  uint32_t next = q->head[b];
  node[grain].later = next;
  node[grain].earlier = GG_NONE;
  if (next != GG_NONE) node[next].earlier = grain;
  q->head[b] = grain;
}

void gg_queue_remove(gg_queue *q, gg_node *node, uint32_t grain)
{
  uint32_t b = bucket_of(q, node[grain].time);
  if (b <= q->current) {
    remove_due(q, grain);
    return;
  }
  uint32_t later = node[grain].later, earlier = node[grain].earlier;
  if (later != GG_NONE) node[later].earlier = earlier;
  if (earlier != GG_NONE)
    node[earlier].later = later;
  else
    q->head[b] = later;
}

static int compare_due(const void *a, const void *b)
{
  return is_before(*(const gg_due *)a, *(const gg_due *)b) ? 1 : -1;
}

bool gg_queue_turn(gg_queue *q, gg_node *node)
{
  uint32_t b = q->current;
  while (q->n_due == 0) {
    if (++b >= q->n_buckets) return false;
    q->current = b;
    uint32_t count = 0, soon = b + AHEAD < q->n_buckets ? q->head[b + AHEAD] : GG_NONE;
    if (soon != GG_NONE) __builtin_prefetch(&node[soon]);
    for (uint32_t i = q->head[b]; i != GG_NONE; i = node[i].later) q->due[count++] = (gg_due){node[i].time, i};
    q->head[b] = GG_NONE;
    if (count > SMALL)
      qsort(q->due, count, sizeof *q->due, compare_due);
    else
      for (uint32_t k = 0; k < count; k++) {
        gg_due new = q->due[k];
        q->n_due = k;
        insert_due(q, new);
      }
    q->n_due = count;
  }
  return true;
}

void gg_queue_rescale(gg_queue *q, double factor)
{
  q->width *= factor;
  q->inverse_width = 1 / q->width;
  for (uint32_t k = 0; k < q->n_due; k++) q->due[k].time *= factor;
}
