/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/queue.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "md/aligned_memory.h"

enum { FEWEST_BUCKETS = 64 };

/* The number of buckets is such that a grain has one or two events an epoch: 16 bytes a grain. */
gg_status gg_md_queue_make(gg_md_queue *q, uint32_t n, gg_error *err)
{
  *q = (gg_md_queue){.n_buckets = n > 4 * FEWEST_BUCKETS ? n / 4 : FEWEST_BUCKETS};
  q->bucket = gg_md_new_lines(q->n_buckets + 1, sizeof *q->bucket, err);
  q->due = gg_base_array_new((size_t)n + GG_MD_BUCKET, sizeof *q->due, err);
  if (!q->bucket || !q->due) return GG_FAILED;
  gg_md_queue_reset(q, 1);
  return GG_OK;
}

void gg_md_queue_free(gg_md_queue *q)
{
  free(q->bucket);
  free(q->due);
  *q = (gg_md_queue){0};
}

/* The width has few binary digits, so that differences of whole buckets are exact. */
double gg_md_bucket_width(double events_per_time)
{
  int exponent;
  double mantissa = frexp(GG_MD_BUCKET_MEAN / events_per_time, &exponent);
  return ldexp(floor(8 * mantissa), exponent - 3);
}

void gg_md_queue_reset(gg_md_queue *q, double width)
{
  q->width = width;
  q->inverse_width = 1 / width;
  q->current = 0;
  q->n_due = 0;
  gg_md_queue_no_pending(q);
  for (uint32_t b = 0; b < q->n_buckets; b++) {
    q->bucket[b].chain = GG_MD_NONE;
    q->bucket[b].count = 0;
  }
}

void gg_md_queue_insert_due(gg_md_queue *q, gg_md_due new)
{
  uint32_t k = q->n_due++;
  for (; k > 0 && gg_md_is_before(q->due[k - 1], new); k--) q->due[k] = q->due[k - 1];
  q->due[k] = new;
}

void gg_md_queue_chain(gg_md_bucket *bucket, gg_md_node *node, uint32_t grain)
{
  uint32_t next = bucket->chain;
  node[grain].later = next;
  node[grain].earlier = GG_MD_NONE;
  if (next != GG_MD_NONE) node[next].earlier = grain;
  bucket->chain = grain;
}

void gg_md_queue_unchain(gg_md_bucket *bucket, gg_md_node *node, uint32_t grain)
{
  uint32_t later = node[grain].later, earlier = node[grain].earlier;
  if (later != GG_MD_NONE) node[later].earlier = earlier;
  if (earlier != GG_MD_NONE)
    node[earlier].later = later;
  else
    bucket->chain = later;
}

static int compare_due(const void *a, const void *b)
{
  return gg_md_is_before(*(const gg_md_due *)a, *(const gg_md_due *)b) ? 1 : -1;
}

/* Sort the events of a bucket, latest first. The place of an event is the number of later ones, without a branch. */
static void sort_few(gg_md_due *due, uint32_t count)
{
  gg_md_due all[GG_MD_BUCKET];
  uint32_t place[GG_MD_BUCKET];
  for (uint32_t k = 0; k < count; k++) {
    uint32_t later = 0;
    for (uint32_t m = 0; m < k; m++) {
      uint32_t before = gg_md_is_before(due[k], due[m]);
      later += before;
      place[m] += 1 - before;
    }
    place[k] = later;
  }
  memcpy(all, due, count * sizeof *due);
  for (uint32_t k = 0; k < count; k++) due[place[k]] = all[k];
}

static void sort_due(gg_md_queue *q, uint32_t count)
{
  if (count <= GG_MD_BUCKET)
    sort_few(q->due, count);
  else
    qsort(q->due, count, sizeof *q->due, compare_due);
  q->n_due = count;
}

bool gg_md_queue_next_bucket(gg_md_queue *q, gg_md_node *node)
{
  uint32_t b = q->current;
  gg_md_queue_store_pending(q, node);
  while (q->n_due == 0) {
    if (++b >= q->n_buckets) return false;
    q->current = b;
    gg_md_bucket *bucket = &q->bucket[b];
    uint32_t count = bucket->count;
    for (uint32_t k = 0; k < count; k++) q->due[k] = (gg_md_due){node[bucket->grain[k]].time, bucket->grain[k]};
    for (uint32_t i = bucket->chain; i != GG_MD_NONE; i = node[i].later) q->due[count++] = (gg_md_due){node[i].time, i};
    bucket->count = 0;
    bucket->chain = GG_MD_NONE;
    sort_due(q, count);
  }
  return true;
}

void gg_md_queue_rescale(gg_md_queue *q, double factor)
{
  q->width *= factor;
  q->inverse_width = 1 / q->width;
  for (uint32_t k = 0; k < q->n_due; k++) q->due[k].time *= factor;
}
