/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of shared windows of events (parallel.h): slabs of the box along z, one a thread, and what each keeps of a
 * window.
 *
 * A window is a span of time, whole buckets of the event queue. Its events run in three phases: all slabs at once;
 * slabs shifted by half of one, with what the first phase put off; on one thread, with what the second put off. An
 * event touches the cells of its grains, and reads the cells around. Two events far from each other may run in any
 * order. Whenever a later phase comes to an event that is earlier than one beside it that has run, the later one, and
 * all that followed from it, is taken back (take_back.c). So of any two events beside each other the earlier has run
 * first, as in a serial run, and all bits are the same.
 *
 * Within a phase nobody writes what another thread reads: events that touch the outer layers of cells of a slab are put
 * off. */
#ifndef GG_MD_SLAB_H
#define GG_MD_SLAB_H

#include <stdatomic.h>

#include "base/thread_pool.h"
#include "md/parallel/parallel.h"

enum { GG_MD_MOST_SLABS = 16, GG_MD_PHASES = 3, GG_MD_MOST_AROUND = 63, GG_MD_MOST_TOUCHED = 2 * GG_MD_MOST_AROUND };

/* A list that grows. */
typedef struct gg_md_growing {
  void *item;
  uint32_t n, room;
} gg_md_growing;

/* The cells that an event touches, and their layers: the grain's own; its partner's, or those that it may come into.
 * It reads those around. Where grains have lists, a new skin changes those of grains in the cells around: such an event
 * is wide, it touches all that it reads. */
typedef struct gg_md_touched {
  uint32_t n, cell[GG_MD_MOST_TOUCHED];
  uint16_t layer[GG_MD_MOST_TOUCHED];
  bool crosses, collides, wide;
} gg_md_touched;

/* Of a cell in a window: the last event that touched it, in which phase (GG_MD_LAST) and when, in the window's lengths
 * since it began; and whether it is closed in a phase (GG_MD_CLOSED), for what depends on an event that was put off.
 * `word` has the window's number before these bits: that of another window says nothing. */
enum { GG_MD_LAST = 3, GG_MD_CLOSED = 4, GG_MD_STATE_BITS = 4 };
typedef struct gg_md_cell_state {
  uint32_t word;
  float last;
} gg_md_cell_state;

/* The state of a grain before an event. */
typedef struct gg_md_saved {
  gg_md_grain grain;
  gg_md_node node;
} gg_md_saved;
typedef struct gg_md_saved_more {
  gg_vec spin;
  double last;
} gg_md_saved_more;

/* What a collision adds to the sums: xx, yy, zz, xy, yx; a collision's loss. */
typedef struct gg_md_addend {
  double stress[5], loss, overlap;
} gg_md_addend;

/* A list and its skin. */
typedef struct gg_md_saved_list {
  uint32_t neighbour[GG_MD_LIST];
  gg_md_skin skin;
} gg_md_saved_list;

/* The state of a cell before an event that touched it. */
typedef struct gg_md_stamp {
  uint32_t cell, layer;
  gg_md_cell_state before;
} gg_md_stamp;

/* An event that has run, with all that it takes to take it back: from where on in the log. */
typedef struct gg_md_record {
  double time;
  uint32_t grain, partner;                /* GG_MD_NONE: no collision */
  uint32_t saved, stamp, touched, beside; /* beside: an addend of a collision, or a list */
  uint16_t pair;                          /* of species */
  bool crosses, wide, gone, treated;
} gg_md_record;

/* The records of a phase, and what stands beside them. */
typedef struct gg_md_log {
  gg_md_growing record, saved, more, stamp, addend, list;
} gg_md_log;
enum { GG_MD_LOG_PARTS = sizeof(gg_md_log) / sizeof(gg_md_growing) };

/* A grain into a bucket of the event queue beyond the window, or (GG_MD_OUT) out of it: done at the window's end. */
#define GG_MD_OUT 0x80000000u
typedef struct gg_md_move {
  uint32_t bucket, grain;
  uint64_t order; /* by phase, slab and time: of overflow lists */
} gg_md_move;

/* Any item of the lists. */
typedef union gg_md_any {
  gg_md_record record;
  gg_md_saved saved;
  gg_md_saved_more more;
  gg_md_saved_list list;
  gg_md_addend addend;
  gg_md_stamp stamp;
  gg_md_move move;
  gg_md_due due;
} gg_md_any;

typedef struct gg_md_parallel gg_md_parallel;

typedef struct gg_md_slab {
  gg_md_parallel *all;
  gg_md *view;     /* the engine as this slab's events know it: with a clock, counts and candidates of its own */
  int self, phase; /* from 0, from 1 */
  uint32_t closed; /* the word's bits of a cell that is closed in this phase */
  uint32_t at;     /* in `due`: up to there it is done */
  uint32_t mark;   /* the last one: each slab has every n_slabs-th */
  uint32_t n_moves;
  bool crowded, out_of_memory;
  gg_md_due pair[2];                    /* the view's queue: an event, and the one after it */
  gg_md_growing mail[GG_MD_MOST_SLABS]; /* of the window's buckets that it emptied: whose event, for which slab */
  gg_md_growing due, fresh;             /* earliest first; new ones, latest first */
  gg_md_growing late, put_off;          /* put off in this phase, and in the one before */
  gg_md_growing back;                   /* take_back.c: records */
  gg_md_log log[GG_MD_PHASES];
  gg_md_growing overflow;                              /* gg_md_move of full buckets */
  gg_md_growing moves[GG_MD_PHASES][GG_MD_MOST_SLABS]; /* by who does it */
  gg_md_any spare;                                     /* written where memory lacked, and not read */
} gg_md_slab;

/* Of a layer of cells in a phase: whose it is, and whether it is an outer one. */
typedef struct gg_md_layer {
  uint8_t owner;
  bool outer;
} gg_md_layer;

/* How windows went: events, those that the first and the second phase put off, those taken back; and windows given up.
 */
typedef struct gg_md_window_counts {
  uint64_t events, put_off[2], taken_back, cancelled;
} gg_md_window_counts;

/* Which is faster, shared events or serial ones? The clock decides, since no bit depends on it: where other processes
 * keep the processors busy, threads wait for each other. */
typedef struct gg_md_trial {
  bool serial;
  uint64_t from, until; /* events */
  double began;         /* by the clock */
  double cost[2];       /* seconds per event, shared and serial; 0: not known yet */
  uint32_t number;
} gg_md_trial;

struct gg_md_parallel {
  bool adapts;
  gg_md_trial trial;
  gg_md *engine;
  gg_thread_pool *pool;
  int n_slabs, phase;
  uint32_t window, n_buckets; /* its number, and of how many buckets it usually is */
  uint32_t begin, end;        /* buckets of this one */
  gg_md_window_counts counts;
  uint64_t serial_until; /* events up to which there are none */
  gg_md_layer *layers[GG_MD_PHASES];
  _Atomic uint16_t *layer; /* of each grain */
  size_t n_cells;
  gg_md_cell_state *cell;
  uint32_t *mark;               /* of each cell: take_back.c */
  int32_t from[3][2], to[3][2]; /* sheared lists: cells around in rows below, beside, above; in images of them */
  double start, inverse_length; /* of the window, as cells have it */
  gg_md_slab *slab;
};

/* slab.c: room for one more at the end of a list; where memory lacks, the spare room. */
void *gg_md_append(gg_md_slab *s, gg_md_growing *list, size_t size);
/* At the end of a list of events. */
void gg_md_add_due(gg_md_slab *s, gg_md_growing *list, gg_md_due due);
/* An event within the window that is new, or back again. */
void gg_md_add_fresh(gg_md_slab *s, gg_md_due due);
/* The grain's event has another time. */
void gg_md_requeue(gg_md_slab *s, uint32_t grain, double from, double to);

/* shared_event.c: an event runs, which touches these cells. */
void gg_md_run_shared(gg_md_slab *s, gg_md_due due, const gg_md_touched *touched);
/* window.c: one of buckets p->begin to p->end; false: it is for the serial loop. */
bool gg_md_run_window(gg_md_parallel *p);
/* settle.c: what the window leaves: the event queue, and the counts and sums. */
void gg_md_settle(gg_md_parallel *p);
uint64_t gg_md_window_collisions(const gg_md_parallel *p);

/* touched.c: the cells that the next event of a grain touches; false: but for a partner elsewhere, and its cell. The
 * cells that are searched from a cell, itself included, layer by layer. What goes with a new window; false: too much.
 */
bool gg_md_find_touched(const gg_md_slab *s, uint32_t grain, gg_md_touched *touched);
int gg_md_cells_around(const gg_md_parallel *p, uint32_t cell, uint32_t index[GG_MD_MOST_AROUND]);
bool gg_md_measure_around(gg_md_parallel *p);

/* take_back.c: has a later event run beside this one, in an earlier phase, or one at nearly the same time? If so:
 * take it back, unless some of what followed from it is not this slab's. And all of a window. */
bool gg_md_is_overtaken(const gg_md_slab *s, double time, const gg_md_touched *touched);
typedef enum gg_md_taken { GG_MD_NOTHING, GG_MD_TAKEN_BACK, GG_MD_NOT_MINE } gg_md_taken;
gg_md_taken gg_md_take_back(gg_md_slab *s, double time, const gg_md_touched *touched);
void gg_md_take_back_all(gg_md_parallel *p);

GG_INLINE const gg_md_layer *gg_md_layer_of(const gg_md_slab *s, int32_t z)
{
  return &s->all->layers[s->phase - 1][z];
}

/* While its slab is at work it may change, but to no other slab. */
GG_INLINE int32_t gg_md_layer_of_grain(const gg_md_parallel *p, uint32_t grain)
{
  return atomic_load_explicit(&p->layer[grain], memory_order_relaxed);
}

GG_INLINE void gg_md_note_layer(const gg_md_parallel *p, const gg_md *e, uint32_t grain)
{
  atomic_store_explicit(&p->layer[grain], (uint16_t)e->node[grain].cell[2], memory_order_relaxed);
}

GG_INLINE gg_md_record *gg_md_record_at(const gg_md_log *log, uint32_t k)
{
  return (gg_md_record *)log->record.item + k;
}

/* Of a cell in this window. */
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
