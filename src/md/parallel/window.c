/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A window of events: distributed to slabs and run in three phases (slab.h). */
#include "md/parallel/slab.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  MOST_MORE = 16, /* a slab with this many times its due events is given up: contacts may accumulate without end */
  AHEAD = 4       /* events between two stages of prefetching */
};

/* Insertion sort, earliest first: the events are nearly in order. */
static void sort(gg_md_growing *list)
{
  gg_md_due *item = list->item;
  for (uint32_t n = 1; n < list->n; n++) {
    const gg_md_due due = item[n];
    uint32_t k = n;
    for (; k > 0 && gg_md_is_before(due, item[k - 1]); k--) item[k] = item[k - 1];
    item[k] = due;
  }
}

static bool take_next(gg_md_slab *s, gg_md_due *next)
{
  const gg_md_due *due = s->due.item, *fresh = s->fresh.item;
  if (s->at == s->due.n && s->fresh.n == 0) return false;
  if (s->at == s->due.n || (s->fresh.n && gg_md_is_before(fresh[s->fresh.n - 1], due[s->at])))
    *next = fresh[--s->fresh.n];
  else
    *next = due[s->at++];
  return true;
}

static bool is_accessible(const gg_md_slab *s, const gg_md_footprint *t, uint32_t k)
{
  const gg_md_layer *layer = gg_md_layer_of(s, t->layer[k]);
  if (layer->owner != s->self || layer->outer) return false;
  return !(gg_md_bits_of(s->all, &s->all->cell[t->cell[k]]) & s->blocked);
}

static bool may_run(const gg_md_slab *s, uint32_t i, gg_md_footprint *t)
{
  if (!gg_md_find_footprint(s, i, t)) return false;
  for (uint32_t k = 0; k < t->n; k++)
    if (!is_accessible(s, t, k)) return false;
  return true;
}

/* Block the cells around, layer by layer. The outer layers of a slab are inaccessible anyway. */
static void block_around(const gg_md_slab *s, uint32_t cell, int32_t z)
{
  uint32_t index[GG_MD_MOST_AROUND];
  const int32_t n = s->local->cells.n[2], each = gg_md_cells_around(s->all, cell, index) / 3;
  for (int32_t m = 0; m < 3; m++) {
    const gg_md_layer *layer = gg_md_layer_of(s, (z + m - 1 + n) % n);
    if (layer->owner != s->self || layer->outer) continue;
    for (int32_t k = m * each; k < (m + 1) * each; k++) gg_md_set_bits(s->all, &s->all->cell[index[k]], 0, s->blocked);
  }
}

/* Defer an event, and block the cells of all events that depend on it. */
static void defer(gg_md_slab *s, gg_md_due due, const gg_md_footprint *t)
{
  gg_md_add_due(s, &s->deferring, due);
  for (uint32_t k = 0; k < t->n; k++)
    if (!t->wide)
      block_around(s, t->cell[k], t->layer[k]);
    else if (gg_md_layer_of(s, t->layer[k])->owner == s->self)
      gg_md_set_bits(s->all, &s->all->cell[t->cell[k]], 0, s->blocked);
}

/* Prefetch the states of the cells in the footprint of a grain's event. Inline, because gcc removes calls of a function
 * that only prefetches. */
GG_INLINE void prefetch_states(const gg_md_slab *s, uint32_t i)
{
  const gg_md *e = s->local;
  gg_md_footprint t;
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS && e->node[i].time < e->node[i].collision) return;
  gg_md_find_footprint(s, i, &t);
  for (uint32_t k = 0; k < t.n; k++) __builtin_prefetch(&s->all->cell[t.cell[k]]);
}

GG_INLINE void prefetch_grain(const gg_md *e, uint32_t i)
{
  __builtin_prefetch(&e->grain[i]);
  __builtin_prefetch(&e->node[i]);
  if (e->spin) __builtin_prefetch(&e->spin[i]);
  if (e->last) __builtin_prefetch(&e->last[i]);
  if (e->search.kind != GG_MD_NEIGHBOUR_LISTS) return;
  const uint32_t *list = e->search.lists.neighbour + (size_t)i * GG_MD_LIST;
  __builtin_prefetch(list);
  __builtin_prefetch(list + 16);
}

/* Prefetch for the next events, in three stages: the grain, its partner, the states of its cells. */
GG_INLINE void prefetch(const gg_md_slab *s)
{
  const gg_md *e = s->local;
  const gg_md_due *due = (gg_md_due *)s->due.item + s->at;
  const uint32_t left = s->due.n - s->at;
  if (left > 3 * AHEAD) prefetch_grain(e, due[3 * AHEAD].grain);
  if (left > 2 * AHEAD) {
    const uint32_t j = e->node[due[2 * AHEAD].grain].partner;
    if (!GG_MD_NO_GRAIN(j)) {
      prefetch_grain(e, j);
      __builtin_prefetch(&s->all->layer[j]);
    }
  }
  if (left > AHEAD) prefetch_states(s, due[AHEAD].grain);
}

/* True if the serial loop must take over: for full cells or lists, NaN, and lack of memory. */
static bool is_over(const gg_md_slab *s)
{
  return s->out_of_memory | s->local->out_of_memory | s->local->no_number | s->local->lists_are_full;
}

static void run_phase(gg_md_slab *s)
{
  gg_md_footprint t;
  const gg_md_growing *records = &s->log[s->phase - 1].part[GG_MD_LOG_RECORDS];
  const uint32_t most = MOST_MORE * (s->due.n + 64);
  for (gg_md_due due; take_next(s, &due);) {
    prefetch(s);
    if (s->local->node[due.grain].time != due.time) continue; /* it has been re-predicted */
    gg_md_rollback_status status = GG_MD_ROLLBACK_BLOCKED;
    if (may_run(s, due.grain, &t))
      status = gg_md_is_straggler(s, due.time, &t) ? gg_md_rollback(s, due.time, &t) : GG_MD_NO_ROLLBACK;
    if (status == GG_MD_NO_ROLLBACK)
      gg_md_run_in_window(s, due, &t);
    else if (status == GG_MD_ROLLED_BACK)
      gg_md_add_fresh(s, due); /* a rolled-back event may be earlier, if only by its index */
    else
      defer(s, due, &t);
    if (records->n > most || is_over(s)) {
      s->overflowed = true;
      return;
    }
  }
}

/* Distribute the events of this slab's part of the buckets to all slabs. */
static void distribute_part(void *context, int self)
{
  const gg_md_parallel *p = context;
  gg_md_slab *s = &p->slab[self];
  const gg_md_queue *q = &p->engine->queue;
  const gg_md_node *node = p->engine->node;
  const uint32_t n = (uint32_t)p->n_slabs, all = p->end - p->begin, from = p->begin + all * (uint32_t)self / n,
                 to = p->begin + all * (uint32_t)(self + 1) / n;
  for (uint32_t b = from; b < to; b++) {
    if (b + 4 < to)
      for (uint32_t k = 0; k < q->bucket[b + 4].count; k++) {
        __builtin_prefetch(&node[q->bucket[b + 4].grain[k]]);
        __builtin_prefetch(&p->layer[q->bucket[b + 4].grain[k]]);
      }
    gg_md_bucket *bucket = &q->bucket[b];
    uint32_t i = bucket->chain;
    for (uint32_t k = 0; k < bucket->count || i != GG_MD_NONE; k++) {
      const uint32_t grain = k < bucket->count ? bucket->grain[k] : i;
      if (k >= bucket->count) i = node[i].later;
      gg_md_add_due(s, &s->outbox[p->layers[0][gg_md_layer_of_grain(p, grain)].owner],
                    (gg_md_due){node[grain].time, grain});
    }
    bucket->count = 0;
    bucket->chain = GG_MD_NONE;
  }
}

/* Collect the events of this slab: from the outboxes of all slabs in phase 1, from deferred events in later phases. */
static void collect(gg_md_slab *s)
{
  const gg_md_parallel *p = s->all;
  s->due.n = s->fresh.n = s->at = 0;
  for (int k = 0; k < p->n_slabs; k++) {
    const gg_md_growing *from = s->phase == 1 ? &p->slab[k].outbox[s->self] : &p->slab[k].deferred;
    const gg_md_due *item = from->item;
    for (uint32_t m = 0; m < from->n; m++)
      if (s->phase == 1 || p->layers[s->phase - 1][gg_md_layer_of_grain(p, item[m].grain)].owner == s->self)
        gg_md_add_due(s, &s->due, item[m]);
  }
  sort(&s->due);
}

static void phase_part(void *context, int self)
{
  gg_md_parallel *p = context;
  gg_md_slab *s = &p->slab[self];
  s->phase = p->phase;
  s->blocked = 2u << p->phase;
  collect(s);
  run_phase(s);
}

static bool is_good(const gg_md_parallel *p)
{
  for (int k = 0; k < p->n_slabs; k++)
    if (p->slab[k].overflowed) return false;
  return true;
}

/* Run the phases, in all slabs at once; the last phase in the first slab alone. The lists of deferred events are
 * exchanged before a phase, so that slabs read the old lists while they fill the new ones. */
static bool run_phases(gg_md_parallel *p)
{
  for (p->phase = 1; p->phase <= GG_MD_PHASES; p->phase++) {
    bool any = p->phase == 1;
    for (int k = 0; k < p->n_slabs; k++) {
      gg_md_slab *s = &p->slab[k];
      const gg_md_growing other = s->deferred;
      s->deferred = s->deferring;
      s->deferring = other;
      s->deferring.n = 0;
      any |= s->deferred.n > 0;
      if (p->phase > 1) p->counts.deferred[p->phase - 2] += s->deferred.n;
    }
    if (!any) return true;
    gg_base_thread_pool_for(p->pool, p->phase < GG_MD_PHASES ? p->n_slabs : 1, phase_part, p);
    if (!is_good(p)) return false;
  }
  return true;
}

static void begin_window(gg_md_parallel *p)
{
  gg_md_queue *q = &p->engine->queue;
  if (++p->window >> (32 - GG_MD_STATE_BITS)) {
    memset(p->cell, 0, p->n_cells * sizeof *p->cell);
    p->window = 1;
  }
  p->start = p->begin * q->width;
  p->inverse_length = 1 / ((p->end - p->begin) * q->width);
  for (int k = 0; k < p->n_slabs; k++) {
    gg_md_slab *s = &p->slab[k];
    s->overflowed = s->local->lists_are_full = s->local->out_of_memory = s->local->no_number = false;
    s->n_moves = 0;
    s->full_buckets.n = 0;
    s->deferring.n = s->deferred.n = 0;
    for (int phase = 0; phase < GG_MD_PHASES; phase++) {
      gg_md_growing *part = s->log[phase].part;
      for (int m = 0; m < GG_MD_LOG_PARTS; m++) part[m].n = 0;
      for (int to = 0; to < p->n_slabs; to++) s->moves[phase][to].n = 0;
    }
    for (int to = 0; to < p->n_slabs; to++) s->outbox[to].n = 0;
  }
  for (uint32_t k = q->n_due; k-- > 0;)
    gg_md_add_due(&p->slab[0], &p->slab[0].outbox[p->layers[0][gg_md_layer_of_grain(p, q->due[k].grain)].owner],
                  q->due[k]);
  q->n_due = 0;
  gg_base_thread_pool_for(p->pool, p->n_slabs, distribute_part, p);
  q->current = p->end - 1;
}

static int latest_first(const void *a, const void *b)
{
  return gg_md_is_before(*(const gg_md_due *)a, *(const gg_md_due *)b) ? 1 : -1;
}

/* Restore the state before the window, except that the events of its buckets are in `due`. */
static void cancel(gg_md_parallel *p)
{
  gg_md_queue *q = &p->engine->queue;
  p->counts.cancelled++;
  gg_md_rollback_all(p);
  for (int k = 0; k < p->n_slabs; k++)
    for (int to = 0; to < p->n_slabs; to++) {
      const gg_md_growing *outbox = &p->slab[k].outbox[to];
      if (outbox->n) memcpy(q->due + q->n_due, outbox->item, outbox->n * sizeof *q->due);
      q->n_due += outbox->n;
    }
  qsort(q->due, q->n_due, sizeof *q->due, latest_first);
}

/* True if memory lacked in a slab. Then the window cannot be rolled back, and the run ends. */
static bool lacks_memory(const gg_md_parallel *p)
{
  for (int k = 0; k < p->n_slabs; k++) p->engine->out_of_memory |= p->slab[k].out_of_memory;
  return p->engine->out_of_memory;
}

bool gg_md_run_window(gg_md_parallel *p)
{
  gg_md *e = p->engine;
  begin_window(p);
  const bool good = run_phases(p);
  if (lacks_memory(p)) return false;
  if (good && gg_md_window_collisions(p) < e->k.collisions_left) {
    gg_md_commit(p);
    return !lacks_memory(p);
  }
  cancel(p);
  return false;
}
