/* The calendar of events, one entry a grain: buckets of equal width over the present epoch (a bounded-increment
 * priority queue: Paul, J. Comput. Phys. 221 (2007) 615), doubly linked, filled in any order; only the grains of the
 * present bucket stand sorted. Insertion and removal cost O(1). What lies beyond the epoch waits in one last bucket. */
#ifndef GG_MD_QUEUE_H
#define GG_MD_QUEUE_H

#include "common/error.h"
#include <stdbool.h>
#include <stdint.h>

#include "common/vec.h"

/* A grain's next event and its place in the calendar and the grid: read only by the grain's own events. */
typedef struct gg_node {
  double time;             /* of the next event */
  double collision;        /* of the next collision known of, >= time; equal: that is the event */
  uint32_t partner, stamp; /* of that collision: with whom, and the partner's stamp when it was predicted */
  uint32_t later, earlier; /* chain of the bucket */
  int32_t cell[3];
  uint32_t neighbours; /* in its list */
  int32_t face;        /* of the cell, crossed next: 2 axis + (1 if upwards), GG_SLIDE or GG_SHELL */
} __attribute__((aligned(64))) gg_node;

/* The neighbouring cells across the sheared boundary have slid: look at them anew. The grain leaves its shell. */
enum { GG_SLIDE = 6, GG_SHELL };

/* Partners that are no grains. */
#define GG_LOWER_WALL (UINT32_MAX - 1)
#define GG_UPPER_WALL (UINT32_MAX - 2)
/* Is a partner a wall or nobody? */
#define GG_NO_GRAIN(partner) ((partner) >= GG_UPPER_WALL)

typedef struct gg_due {
  double time;
  uint32_t grain;
} gg_due;

typedef struct gg_queue {
  double inverse_width, width;
  uint32_t n_buckets, current; /* buckets up to and including `current` stand in `due` */
  uint32_t *head;              /* n_buckets + 1: the last one is beyond the epoch */
  gg_due *due;                 /* latest first, so that the next event is the last entry */
  uint32_t n_due;
} gg_queue;

gg_status gg_queue_make(gg_queue *q, uint32_t n_grains, gg_error *err);
void gg_queue_free(gg_queue *q);
/* Empty it, at bucket 0, with buckets of this width. */
void gg_queue_reset(gg_queue *q, double width);
void gg_queue_insert(gg_queue *q, gg_node *node, uint32_t grain);
void gg_queue_remove(gg_queue *q, gg_node *node, uint32_t grain);
/* Bring the next non-empty bucket into `due`; false if the epoch is over. */
bool gg_queue_turn(gg_queue *q, gg_node *node);

/* All times have been multiplied by this power of two. */
void gg_queue_rescale(gg_queue *q, double factor);

/* Length of the epoch that the buckets cover. */
GG_INLINE double gg_queue_span(const gg_queue *q)
{
  return q->width * q->n_buckets;
}

#endif
