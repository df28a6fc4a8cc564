/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of parallel windows of events (parallel.h), and the functions of this folder by the file that defines them.
 *
 * The box is partitioned into slabs along z, one a thread. A window is a span of time, whole buckets of the event
 * queue. Its events run in three phases: in all slabs at once; in slabs shifted by half a slab, the events that the
 * first phase deferred; on one thread, the events that the second phase deferred. The footprint of an event is the
 * cells of its grains; it reads the cells around them. Two events far from each other may run in any order. If a later
 * phase finds a straggler, an event earlier than an event beside it that has run, the later event and all that followed
 * from it are rolled back (rollback.c). So of any two events beside each other the earlier one has run first, as in a
 * serial run, and all bits are the same.
 *
 * Within a phase no thread writes what another thread reads: events whose footprint includes an outer layer of cells of
 * a slab are deferred. */
#ifndef GG_MD_PARALLEL_SLAB_H
#define GG_MD_PARALLEL_SLAB_H

#include <stdatomic.h>

#include "base/thread_pool.h"
#include "md/parallel/parallel.h"

enum { GG_MD_MOST_SLABS = 16, GG_MD_PHASES = 3, GG_MD_MOST_AROUND = 63, GG_MD_MOST_FOOTPRINT = 2 * GG_MD_MOST_AROUND };

/* A list that grows. Its items are of one type, by the use of the list. */
typedef struct gg_md_growing {
  void *item;
  uint32_t n, room;
} gg_md_growing;

/* Footprint of an event: the cells of its grain and of its partner, or the cells that the grain may enter. */
typedef struct gg_md_footprint {
  uint32_t n, cell[GG_MD_MOST_FOOTPRINT];
  uint16_t layer[GG_MD_MOST_FOOTPRINT]; /* of each cell along z */
  bool crosses, collides;
  bool wide; /* it includes all cells that the event reads: with neighbour lists a new skin changes lists around it */
} gg_md_footprint;

/* State of a cell in a window. */
typedef struct gg_md_cell_state {
  uint32_t
      word;   /* number of the window and, in the lowest bits, its state; the state of another window means nothing */
  float last; /* time of the last event with this cell in its footprint, from 0 to 1 in the window */
} gg_md_cell_state;
enum {
  GG_MD_LAST = 3,      /* mask: phase of the last event, from 1; 0: none */
  GG_MD_BLOCKED = 4,   /* bit: the cell depends on an event that phase 1 deferred; the next bit: phase 2 */
  GG_MD_STATE_BITS = 4 /* number of these bits */
};

/* A grain before an event. */
typedef struct gg_md_saved {
  gg_md_grain grain;
  gg_md_node node;
} gg_md_saved;
typedef struct gg_md_saved_more {
  gg_vec spin;
  double last;
  gg_md_image image;
} gg_md_saved_more;

/* Terms of a collision in the sums: stress xx, yy, zz, xy, yx; loss; overlap. */
typedef struct gg_md_addend {
  double stress[5], loss, given, overlap;
} gg_md_addend;

/* A neighbour list and its skin before an event. */
typedef struct gg_md_saved_list {
  uint32_t neighbour[GG_MD_LIST];
  gg_md_skin skin;
} gg_md_saved_list;

/* A cell of the footprint before an event. */
typedef struct gg_md_saved_cell {
  uint32_t cell, layer;
  gg_md_cell_state before;
} gg_md_saved_cell;

/* An event that has run. Its saved state begins at these places of the log. */
typedef struct gg_md_record {
  double time;
  uint32_t grain, partner; /* partner GG_MD_NONE: no collision */
  uint32_t saved;          /* its grains, one or two */
  uint32_t cells, n_cells; /* its footprint */
  uint32_t beside;         /* of a collision its addend; of a new skin the saved list */
  uint16_t pair;           /* of species */
  bool crosses, wide, rolled_back, treated, clamped;
} gg_md_record;

/* Log of a phase. */
enum {
  GG_MD_LOG_RECORDS, /* gg_md_record */
  GG_MD_LOG_SAVED,   /* gg_md_saved */
  GG_MD_LOG_MORE,    /* gg_md_saved_more, if grains have any of that */
  GG_MD_LOG_CELLS,   /* gg_md_saved_cell */
  GG_MD_LOG_ADDENDS, /* gg_md_addend */
  GG_MD_LOG_LISTS,   /* gg_md_saved_list */
  GG_MD_LOG_PARTS
};
typedef struct gg_md_log {
  gg_md_growing part[GG_MD_LOG_PARTS];
} gg_md_log;

/* Insertion of a grain into a bucket of the event queue beyond the window or, with GG_MD_OUT, its removal. It is
 * applied at the end of the window. */
#define GG_MD_OUT 0x80000000u
typedef struct gg_md_move {
  uint32_t bucket, grain;
  uint64_t order; /* by phase, slab and time, for overflow lists of buckets */
} gg_md_move;

/* Any item of the lists. */
typedef union gg_md_any {
  gg_md_record record;
  gg_md_saved saved;
  gg_md_saved_more more;
  gg_md_saved_list list;
  gg_md_addend addend;
  gg_md_saved_cell cell;
  gg_md_move move;
  gg_md_due due;
} gg_md_any;

typedef struct gg_md_parallel gg_md_parallel;

typedef struct gg_md_slab {
  gg_md_parallel *all;
  gg_md *local;     /* thread-local engine, with its own clock, counts and candidates */
  int self, phase;  /* from 0, from 1 */
  uint32_t blocked; /* bit of a cell that is blocked in this phase */
  uint32_t at;      /* next event in `due` */
  uint32_t mark;    /* last mark of this slab (rollback.c); every n_slabs-th number is a mark of this slab */
  uint32_t n_moves;
  bool overflowed;                        /* the window must be cancelled */
  bool out_of_memory;                     /* a list could not grow */
  gg_md_due pair[2];                      /* queue of the local engine: an event, and the event after it */
  gg_md_growing outbox[GG_MD_MOST_SLABS]; /* gg_md_due from this slab's part of the buckets, by slab that runs it */
  gg_md_growing due;                      /* gg_md_due of this phase, earliest first */
  gg_md_growing fresh;                    /* gg_md_due predicted in this phase, latest first */
  gg_md_growing deferring;                /* gg_md_due deferred in this phase */
  gg_md_growing deferred;                 /* gg_md_due deferred in the phase before */
  gg_md_growing rolled_back;              /* records of the present rollback (rollback.c) */
  gg_md_log log[GG_MD_PHASES];
  gg_md_growing full_buckets;                          /* gg_md_move of full buckets */
  gg_md_growing moves[GG_MD_PHASES][GG_MD_MOST_SLABS]; /* gg_md_move by slab that applies it */
  gg_md_any spare;                                     /* written in place of an item if memory lacks; never read */
} gg_md_slab;

/* A layer of cells along z in a phase. */
typedef struct gg_md_layer {
  uint8_t owner; /* slab */
  bool outer;    /* next to another slab */
} gg_md_layer;

/* Statistics of the windows. */
typedef struct gg_md_window_counts {
  uint64_t events;
  uint64_t deferred[2]; /* events that the first and the second phase deferred */
  uint64_t rolled_back; /* events */
  uint64_t cancelled;   /* windows */
} gg_md_window_counts;

/* Comparison of parallel and serial events in wall time. No bit depends on it. If other processes keep the processors
 * busy, threads block each other and serial events may be faster. */
typedef struct gg_md_trial {
  bool serial;
  uint64_t from, until; /* events */
  double began;         /* wall time */
  double cost[2];       /* seconds per event, parallel and serial; 0: not known yet */
  uint32_t number;
} gg_md_trial;

struct gg_md_parallel {
  bool adapts;
  gg_md_trial trial;
  gg_md *engine;
  gg_thread_pool *pool;
  int n_slabs, phase;
  uint32_t window;     /* number of the window */
  uint32_t n_buckets;  /* usual size of a window */
  uint32_t begin, end; /* buckets of this window */
  gg_md_window_counts counts;
  uint64_t serial_until; /* events up to which no window is tried */
  gg_md_layer *layers[GG_MD_PHASES];
  _Atomic uint16_t *layer; /* of each grain */
  size_t n_cells;
  gg_md_cell_state *cell;
  uint32_t *mark; /* of each cell (rollback.c) */
  /* Cells around a cell along x for sheared lists, in the rows below, beside and above it; [1]: in images of rows. */
  int32_t from[3][2], to[3][2];
  double start, inverse_length; /* of the window, for gg_md_window_time */
  gg_md_slab *slab;
};

/* slab.c: room for one more item at the end of a list; if memory lacks, the spare item. */
void *gg_md_append(gg_md_slab *s, gg_md_growing *list, size_t size);
/* Append an event to a list of events. */
void gg_md_add_due(gg_md_slab *s, gg_md_growing *list, gg_md_due due);
/* Add a newly predicted event within the window, or one that was rolled back. */
void gg_md_add_fresh(gg_md_slab *s, gg_md_due due);
/* Move the event of a grain from one time to another. */
void gg_md_requeue(gg_md_slab *s, uint32_t grain, double from, double to);

/* shared_event.c: run an event with this footprint. */
void gg_md_run_in_window(gg_md_slab *s, gg_md_due due, const gg_md_footprint *footprint);

/* window.c: run the window of buckets p->begin to p->end. False: its events are left to the serial loop. */
bool gg_md_run_window(gg_md_parallel *p);

/* commit.c: commit a window to the event queue, the counts and the sums. */
void gg_md_commit(gg_md_parallel *p);
/* Number of collisions in the window, or of its events if these do not exceed collisions_left. */
uint64_t gg_md_window_collisions(const gg_md_parallel *p);

/* footprint.c: find the footprint of the next event of a grain. False: the partner is in another slab; its cell is not
 * in the footprint. */
bool gg_md_find_footprint(const gg_md_slab *s, uint32_t grain, gg_md_footprint *footprint);
/* Cells that are searched from a cell, the cell included, layer by layer; returns their number. */
int gg_md_cells_around(const gg_md_parallel *p, uint32_t cell, uint32_t index[GG_MD_MOST_AROUND]);
/* Set p->from and p->to for a new window. False: a grain may reach too many cells. */
bool gg_md_measure_around(gg_md_parallel *p);

/* rollback.c: true if this event is a straggler: an event beside it with a later or nearly the same time has run in an
 * earlier phase. */
bool gg_md_is_straggler(const gg_md_slab *s, double time, const gg_md_footprint *footprint);
typedef enum gg_md_rollback_status {
  GG_MD_NO_ROLLBACK,      /* no event depends on the straggler */
  GG_MD_ROLLED_BACK,      /* events were rolled back */
  GG_MD_ROLLBACK_BLOCKED, /* some of these events belong to another slab: nothing was rolled back */
} gg_md_rollback_status;
/* Roll back all events that depend on a straggler. */
gg_md_rollback_status gg_md_rollback(gg_md_slab *s, double time, const gg_md_footprint *footprint);
/* Roll back a whole window. */
void gg_md_rollback_all(gg_md_parallel *p);

GG_INLINE const gg_md_layer *gg_md_layer_of(const gg_md_slab *s, int32_t z)
{
  return &s->all->layers[s->phase - 1][z];
}

/* Layer of a grain. Another slab may change it meanwhile, but only to a layer of its own. */
GG_INLINE int32_t gg_md_layer_of_grain(const gg_md_parallel *p, uint32_t grain)
{
  return atomic_load_explicit(&p->layer[grain], memory_order_relaxed);
}

GG_INLINE void gg_md_set_layer(const gg_md_parallel *p, const gg_md *e, uint32_t grain)
{
  atomic_store_explicit(&p->layer[grain], (uint16_t)e->node[grain].cell[2], memory_order_relaxed);
}

GG_INLINE gg_md_record *gg_md_record_at(const gg_md_log *log, uint32_t k)
{
  return (gg_md_record *)log->part[GG_MD_LOG_RECORDS].item + k;
}

/* State bits of a cell in this window. */
GG_INLINE uint32_t gg_md_bits_of(const gg_md_parallel *p, const gg_md_cell_state *c)
{
  return c->word >> GG_MD_STATE_BITS == p->window ? c->word & ((1u << GG_MD_STATE_BITS) - 1) : 0;
}

GG_INLINE void gg_md_set_bits(const gg_md_parallel *p, gg_md_cell_state *c, uint32_t clear, uint32_t set)
{
  c->word = p->window << GG_MD_STATE_BITS | (gg_md_bits_of(p, c) & ~clear) | set;
}

GG_INLINE float gg_md_window_time(const gg_md_parallel *p, double time)
{
  return (float)((time - p->start) * p->inverse_length);
}

#endif
