/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The event queue: a bounded-increment priority queue (Paul, J. Comput. Phys. 221 (2007) 615) with one entry per grain.
 * Buckets of equal width cover the present epoch. A bucket is one cache line of unsorted grains; only the present
 * bucket is sorted. Insertion and removal cost O(1), touch one cache line of a bucket and no other grain's node, and
 * have no unpredictable branch. A full bucket has an overflow list. Events beyond the epoch are not stored: at the end
 * of the epoch every grain is inserted again. */
#ifndef GG_MD_QUEUE_H
#define GG_MD_QUEUE_H

#include "base/error.h"
#include "common/surface/surface.h"
#include <stdbool.h>
#include <stdint.h>

#include "common/vec.h"
#include "simd/words.h"

#define GG_MD_NONE UINT32_MAX

/* A grain's next event and its place in the event queue and the grid: read only by the grain's own events. */
typedef struct gg_md_node {
  double time;               /* of the next event */
  double collision;          /* of the next predicted collision, >= time; equal: that is the event */
  uint32_t partner, counter; /* of that collision, and the partner's counter when it was predicted */
  uint32_t later, earlier;   /* in the overflow list of a full bucket */
  int32_t cell[3];
  uint32_t neighbours; /* in its list; of overlapping cells: bits of those along which it is in two */
  int32_t face;        /* of the cell, crossed next: 2 axis + (1 if upwards), or GG_MD_IMAGES_MOVED */
  int32_t upper;       /* overlapping cells in rows: where along x in the upper one of two rows */
  double skin_time;    /* when the grain's list was made: under shear its skin shrinks */
} __attribute__((aligned(64))) gg_md_node;

/* The neighbouring cells across the sheared boundary have moved: search them again. */
enum { GG_MD_IMAGES_MOVED = 8 };

/* Partners that are no grains: the surfaces of the model, from 0. Of a partner: which is it? Is it one, or nobody? */
#define GG_MD_SURFACE(w) (UINT32_MAX - 1 - (uint32_t)(w))
#define GG_MD_SURFACE_OF(partner) ((int)(UINT32_MAX - 1 - (partner)))
#define GG_MD_NO_GRAIN(partner) ((partner) >= GG_MD_SURFACE(GG_MOST_SURFACES - 1))

typedef struct gg_md_due {
  double time;
  uint32_t grain;
} gg_md_due;

enum { GG_MD_BUCKET = 14, GG_MD_BUCKET_MEAN = 6 };
typedef struct gg_md_bucket {
  uint32_t chain, count, grain[GG_MD_BUCKET]; /* chain: the first of those beyond the fourteen, GG_MD_NONE */
} __attribute__((aligned(64))) gg_md_bucket;

typedef struct gg_md_queue {
  double inverse_width, width;
  uint32_t n_buckets, current; /* buckets up to and including `current` stand in `due` */
  gg_md_bucket *bucket;
  gg_md_due *due; /* latest first, so that the next event is the last entry */
  uint32_t n_due;
} gg_md_queue;

gg_status gg_md_queue_make(gg_md_queue *q, uint32_t n_grains, gg_error *err);
void gg_md_queue_free(gg_md_queue *q);
/* Bucket width that suits a rate of events. */
double gg_md_bucket_width(double events_per_time);
/* Empty it, at bucket 0, with buckets of this width. */
void gg_md_queue_reset(gg_md_queue *q, double width);
/* Bring the next non-empty bucket into `due`; false if the epoch is over. */
bool gg_md_queue_turn(gg_md_queue *q, gg_md_node *node);
/* All times have been multiplied by this power of two. */
void gg_md_queue_rescale(gg_md_queue *q, double factor);
/* For buckets that overflow. */
void gg_md_queue_chain(gg_md_bucket *bucket, gg_md_node *node, uint32_t grain);
void gg_md_queue_unchain(gg_md_bucket *bucket, gg_md_node *node, uint32_t grain);

/* Length of the epoch that the buckets cover. */
GG_INLINE double gg_md_queue_span(const gg_md_queue *q)
{
  return q->width * q->n_buckets;
}

/* The same time always falls into the same bucket: removal finds it again. */
GG_INLINE uint32_t gg_md_bucket_of(const gg_md_queue *q, double time)
{
  double b = time * q->inverse_width;
  return b < q->n_buckets ? (uint32_t)b : q->n_buckets;
}

/* Equal times go by the grain's index, so that the order never depends on the history of the queue. */
GG_INLINE bool gg_md_is_before(gg_md_due a, gg_md_due b)
{
  return (a.time < b.time) | ((a.time == b.time) & (a.grain < b.grain));
}

GG_INLINE void gg_md_queue_insert_due(gg_md_queue *q, gg_md_due new)
{
  uint32_t k = q->n_due++;
  for (; k > 0 && gg_md_is_before(q->due[k - 1], new); k--) q->due[k] = q->due[k - 1];
  q->due[k] = new;
}

GG_INLINE void gg_md_queue_remove_due(gg_md_queue *q, uint32_t grain)
{
  uint32_t k = q->n_due - 1;
  while (q->due[k].grain != grain) k--;
  q->n_due--;
  for (; k < q->n_due; k++) q->due[k] = q->due[k + 1];
}

/* Into a bucket to come, and out of it; false: the bucket is full, or the grain is not among its fourteen. */
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
