/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The event queue: a bounded-increment priority queue (Paul, J. Comput. Phys. 221 (2007) 615) with one entry per grain.
 * Buckets of equal width cover the present epoch. A bucket is one cache line of unsorted grains; only the present
 * bucket is sorted. Insertion and removal cost O(1), access one cache line of a bucket and no other grain's node, and
 * have no unpredictable branch. A full bucket has an overflow list. Events beyond the epoch are not stored: at the end
 * of the epoch every grain is inserted again.
 *
 * In large systems a random bucket is not in the cache. The event loop therefore defers insertions: a deferred grain
 * waits in `pending` while the line of its bucket is fetched, until gg_md_queue_store_pending. That has no branch: an
 * empty place names the bucket behind the last one, which is never read. */
#ifndef GG_MD_QUEUE_H
#define GG_MD_QUEUE_H

#include "base/error.h"
#include "common/surface/surface.h"
#include <stdbool.h>
#include <stdint.h>

#include "common/vec.h"
#include "simd/words.h"

#define GG_MD_NONE UINT32_MAX

/* Next event of a grain, and its place in the event queue and the grid: read by the grain's own events only. */
typedef struct gg_md_node {
  double time;               /* of the next event */
  double collision;          /* of the next predicted collision, >= time; equal: it is the event */
  uint32_t partner, counter; /* of that collision; counter of the partner when it was predicted */
  uint32_t later, earlier;   /* in the overflow list of a full bucket */
  int32_t cell[3];
  uint32_t neighbours; /* number in its list; with overlapping cells: bits of the axes along which it is in two cells */
  int32_t face;        /* of the cell that is crossed next: 2 axis + (1 if upwards); or GG_MD_IMAGES_MOVED */
  int32_t upper;       /* overlapping cells in rows: cell along x in the upper of two rows */
  double skin_time;    /* time when its list was made: under shear its skin shrinks */
} __attribute__((aligned(64))) gg_md_node;

/* Event: the neighbouring cells across the sheared boundary have moved and must be searched again. */
enum { GG_MD_IMAGES_MOVED = 8 };

/* Partners that are no grains: surfaces of the model, from 0. GG_MD_NO_GRAIN is true for a surface and for GG_MD_NONE.
 */
#define GG_MD_SURFACE(w) (UINT32_MAX - 1 - (uint32_t)(w))
#define GG_MD_SURFACE_OF(partner) ((int)(UINT32_MAX - 1 - (partner)))
#define GG_MD_NO_GRAIN(partner) ((partner) >= GG_MD_SURFACE(GG_MOST_SURFACES - 1))

typedef struct gg_md_due {
  double time;
  uint32_t grain;
} gg_md_due;

enum {
  GG_MD_BUCKET = 14,     /* grains in a bucket without an overflow list */
  GG_MD_BUCKET_MEAN = 6, /* mean number of grains */
  GG_MD_PENDING = 2      /* deferred insertions: an event makes one or two */
};
typedef struct gg_md_bucket {
  uint32_t chain, count, grain[GG_MD_BUCKET]; /* chain: first grain of the overflow list, or GG_MD_NONE */
} __attribute__((aligned(64))) gg_md_bucket;

/* Deferred insertion of a grain into a bucket. */
typedef struct gg_md_pending {
  gg_md_bucket *bucket;
  uint32_t grain;
} gg_md_pending;

typedef struct gg_md_queue {
  double inverse_width, width;
  uint32_t n_buckets, current; /* events of buckets up to and including `current` are in `due` */
  gg_md_bucket *bucket;        /* and one behind the last, for events that are not stored */
  gg_md_due *due;              /* latest first: the next event is the last entry */
  uint32_t n_due;
  gg_md_pending pending[GG_MD_PENDING];
} gg_md_queue;

gg_status gg_md_queue_make(gg_md_queue *q, uint32_t n_grains, gg_error *err);
void gg_md_queue_free(gg_md_queue *q);
/* Bucket width that suits a rate of events. */
double gg_md_bucket_width(double events_per_time);
/* Empty the queue, at bucket 0, with buckets of this width. */
void gg_md_queue_reset(gg_md_queue *q, double width);
/* Store deferred insertions, and sort the next non-empty bucket into `due`. False: the epoch is over. */
bool gg_md_queue_next_bucket(gg_md_queue *q, gg_md_node *node);
/* Multiply all times in the queue by a power of two. */
void gg_md_queue_rescale(gg_md_queue *q, double factor);
/* Insert an event into `due`; rare. */
void gg_md_queue_insert_due(gg_md_queue *q, gg_md_due new);
/* Insert a grain into the overflow list of a bucket, or remove it. */
void gg_md_queue_chain(gg_md_bucket *bucket, gg_md_node *node, uint32_t grain);
void gg_md_queue_unchain(gg_md_bucket *bucket, gg_md_node *node, uint32_t grain);

/* Length of the epoch. */
GG_INLINE double gg_md_queue_span(const gg_md_queue *q)
{
  return q->width * q->n_buckets;
}

/* Bucket of a time. The same time always has the same bucket, so that removal finds it. */
GG_INLINE uint32_t gg_md_bucket_of(const gg_md_queue *q, double time)
{
  double b = time * q->inverse_width;
  return b < q->n_buckets ? (uint32_t)b : q->n_buckets;
}

/* Order of events. Equal times are ordered by the index of the grain, so that the order never depends on the history of
 * the queue. */
GG_INLINE bool gg_md_is_before(gg_md_due a, gg_md_due b)
{
  return (a.time < b.time) | ((a.time == b.time) & (a.grain < b.grain));
}

/* Remove the next event. */
GG_INLINE void gg_md_queue_remove_next(gg_md_queue *q)
{
  q->n_due--;
}

GG_INLINE void gg_md_queue_remove_due(gg_md_queue *q, uint32_t grain)
{
  uint32_t k = q->n_due - 1;
  while (q->due[k].grain != grain) k--;
  q->n_due--;
  for (; k < q->n_due; k++) q->due[k] = q->due[k + 1];
}

/* Insert a grain into a future bucket, or remove it. False: the bucket is full, or the grain is in its overflow list.
 */
GG_INLINE bool gg_md_bucket_add(gg_md_bucket *bucket, uint32_t grain)
{
  if (bucket->count == GG_MD_BUCKET) return false;
  bucket->grain[bucket->count++] = grain;
  return true;
}

GG_INLINE bool gg_md_bucket_take(gg_md_bucket *bucket, uint32_t grain)
{
  uint32_t found = gg_words_equal16((const uint32_t *)bucket, grain) >> 2 & gg_lowest_bits(bucket->count);
  if (__builtin_expect(found == 0, 0)) return false;
  bucket->grain[__builtin_ctz(found)] = bucket->grain[--bucket->count];
  return true;
}

GG_INLINE void gg_md_queue_insert(gg_md_queue *q, gg_md_node *node, uint32_t grain)
{
  uint32_t b = gg_md_bucket_of(q, node[grain].time);
  if (b <= q->current) {
    gg_md_queue_insert_due(q, (gg_md_due){node[grain].time, grain});
    return;
  }
  if (b < q->n_buckets && !gg_md_bucket_add(&q->bucket[b], grain)) gg_md_queue_chain(&q->bucket[b], node, grain);
}

/* Insert a grain, at once into `due`, deferred into a later bucket. The place in `pending` must be empty. */
GG_INLINE void gg_md_queue_defer(gg_md_queue *q, gg_md_node *node, uint32_t grain, int place)
{
  uint32_t b = gg_md_bucket_of(q, node[grain].time);
  if (__builtin_expect(b <= q->current, 0)) {
    gg_md_queue_insert_due(q, (gg_md_due){node[grain].time, grain});
    return;
  }
  __builtin_prefetch(&q->bucket[b], 1);
  q->pending[place] = (gg_md_pending){&q->bucket[b], grain};
}

GG_INLINE void gg_md_queue_no_pending(gg_md_queue *q)
{
  for (int k = 0; k < GG_MD_PENDING; k++) q->pending[k].bucket = &q->bucket[q->n_buckets];
  q->bucket[q->n_buckets].count = 0;
}

/* Store deferred insertions. It precedes the removal of a grain that may be deferred, and anything that reads buckets.
 */
GG_INLINE void gg_md_queue_store_pending(gg_md_queue *q, gg_md_node *node)
{
  for (int k = 0; k < GG_MD_PENDING; k++)
    if (__builtin_expect(!gg_md_bucket_add(q->pending[k].bucket, q->pending[k].grain), 0))
      gg_md_queue_chain(q->pending[k].bucket, node, q->pending[k].grain);
  gg_md_queue_no_pending(q);
}

GG_INLINE void gg_md_queue_remove(gg_md_queue *q, gg_md_node *node, uint32_t grain)
{
  uint32_t b = gg_md_bucket_of(q, node[grain].time);
  if (b <= q->current) {
    gg_md_queue_remove_due(q, grain);
    return;
  }
  if (b < q->n_buckets && !gg_md_bucket_take(&q->bucket[b], grain)) gg_md_queue_unchain(&q->bucket[b], node, grain);
}

#endif
