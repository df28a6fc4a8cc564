/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A window of events: dealt out to slabs, and run in three phases (slab.h). */
#include "md/parallel/slab.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* More events in a slab than so many times those that were due: contacts that accumulate, perhaps without end. */
enum { MOST_MORE = 16, AHEAD = 4 };

/* Earliest first; nearly in order as they come. */
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

static bool is_open(const gg_md_slab *s, const gg_md_touched *t, uint32_t k)
{
  const gg_md_layer *layer = gg_md_layer_of(s, t->layer[k]);
  if (layer->owner != s->self || layer->outer) return false;
  return !(gg_md_bits_of(s->all, &s->all->cell[t->cell[k]]) & s->closed);
}

static bool may_run(const gg_md_slab *s, uint32_t i, gg_md_touched *t)
{
  if (!gg_md_find_touched(s, i, t)) return false;
  for (uint32_t k = 0; k < t->n; k++)
    if (!is_open(s, t, k)) return false;
  return true;
}

/* Close the cells around, layer by layer; the outer layers of a slab are closed anyway. */
static void close_around(const gg_md_slab *s, uint32_t cell, int32_t z)
{
  uint32_t index[GG_MD_MOST_AROUND];
  const int32_t n = s->view->cells.n[2], each = gg_md_cells_around(s->all, cell, index) / 3;
  for (int32_t m = 0; m < 3; m++) {
    const gg_md_layer *layer = gg_md_layer_of(s, (z + m - 1 + n) % n);
    if (layer->owner != s->self || layer->outer) continue;
    for (int32_t k = m * each; k < (m + 1) * each; k++) gg_md_set_bits(s->all, &s->all->cell[index[k]], 0, s->closed);
  }
}

/* What depends on it waits, too. */
static void put_off(gg_md_slab *s, gg_md_due due, const gg_md_touched *t)
{
  gg_md_add_due(s, &s->late, due);
  for (uint32_t k = 0; k < t->n; k++)
    if (!t->wide)
      close_around(s, t->cell[k], t->layer[k]);
    else if (gg_md_layer_of(s, t->layer[k])->owner == s->self)
      gg_md_set_bits(s->all, &s->all->cell[t->cell[k]], 0, s->closed);
}

/* The states of the cells that the event of a grain will touch. (Inline: gcc takes a call of a function that does
 * nothing but prefetch for one that does nothing.) */
GG_INLINE void prefetch_states(const gg_md_slab *s, uint32_t i)
{
  const gg_md *e = s->view;
  gg_md_touched t;
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS && e->node[i].time < e->node[i].collision) return;
  gg_md_find_touched(s, i, &t);
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

/* What events to come will read: their grains; when those are there, their partners; and then their cells' states. */
GG_INLINE void prefetch(const gg_md_slab *s)
{
  const gg_md *e = s->view;
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

/* What the serial loop has to do: cells or lists that are full, NaN, and the end. */
static bool is_over(const gg_md_slab *s)
{
  return s->out_of_memory | s->view->out_of_memory | s->view->no_number | s->view->lists_are_full;
}

static void run_phase(gg_md_slab *s)
{
  gg_md_touched t;
  const gg_md_growing *records = &s->log[s->phase - 1].record;
  const uint32_t most = MOST_MORE * (s->due.n + 64);
  for (gg_md_due due; take_next(s, &due);) {
    prefetch(s);
    if (s->view->node[due.grain].time != due.time) continue; /* it has been predicted anew */
    gg_md_taken taken = GG_MD_NOT_MINE;
    if (may_run(s, due.grain, &t))
      taken = gg_md_is_overtaken(s, due.time, &t) ? gg_md_take_back(s, due.time, &t) : GG_MD_NOTHING;
    if (taken == GG_MD_NOTHING)
      gg_md_run_shared(s, due, &t);
    else if (taken == GG_MD_TAKEN_BACK)
      gg_md_add_fresh(s, due); /* what was taken back may be earlier, if only by its number */
    else
      put_off(s, due, &t);
    if (records->n > most || is_over(s)) {
      s->crowded = true;
      return;
    }
  }
}

/* Empty this slab's part of the window's buckets. */
static void deal_part(void *context, int self)
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
      gg_md_add_due(s, &s->mail[p->layers[0][gg_md_layer_of_grain(p, grain)].owner],
                    (gg_md_due){node[grain].time, grain});
    }
    bucket->count = 0;
    bucket->chain = GG_MD_NONE;
  }
}

/* The events of all slabs that are this one's: those dealt out, or those put off. */
static void collect(gg_md_slab *s)
{
  const gg_md_parallel *p = s->all;
  s->due.n = s->fresh.n = s->at = 0;
  for (int k = 0; k < p->n_slabs; k++) {
    const gg_md_growing *from = s->phase == 1 ? &p->slab[k].mail[s->self] : &p->slab[k].put_off;
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
  s->closed = 2u << p->phase;
  collect(s);
  run_phase(s);
}

static bool is_good(const gg_md_parallel *p)
{
  for (int k = 0; k < p->n_slabs; k++)
    if (p->slab[k].crowded) return false;
  return true;
}

/* All slabs at once; or the first one alone, in the last phase. Each collects what was put off before any puts off. */
static bool run_phases(gg_md_parallel *p)
{
  for (p->phase = 1; p->phase <= GG_MD_PHASES; p->phase++) {
    bool any = p->phase == 1;
    for (int k = 0; k < p->n_slabs; k++) {
      gg_md_slab *s = &p->slab[k];
      const gg_md_growing other = s->put_off;
      s->put_off = s->late;
      s->late = other;
      s->late.n = 0;
      any |= s->put_off.n > 0;
      if (p->phase > 1) p->counts.put_off[p->phase - 2] += s->put_off.n;
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
    s->crowded = s->view->lists_are_full = s->view->out_of_memory = s->view->no_number = false;
    s->n_moves = 0;
    s->overflow.n = 0;
    s->late.n = s->put_off.n = 0;
    for (int phase = 0; phase < GG_MD_PHASES; phase++) {
      gg_md_growing *part = &s->log[phase].record;
      for (int m = 0; m < GG_MD_LOG_PARTS; m++) part[m].n = 0;
      for (int to = 0; to < p->n_slabs; to++) s->moves[phase][to].n = 0;
    }
    for (int to = 0; to < p->n_slabs; to++) s->mail[to].n = 0;
  }
  for (uint32_t k = q->n_due; k-- > 0;)
    gg_md_add_due(&p->slab[0], &p->slab[0].mail[p->layers[0][gg_md_layer_of_grain(p, q->due[k].grain)].owner],
                  q->due[k]);
  q->n_due = 0;
  gg_base_thread_pool_for(p->pool, p->n_slabs, deal_part, p);
  q->current = p->end - 1;
}

static int latest_first(const void *a, const void *b)
{
  return gg_md_is_before(*(const gg_md_due *)a, *(const gg_md_due *)b) ? 1 : -1;
}

/* As before the window, but for its buckets, all of which stand in `due`. */
static void cancel(gg_md_parallel *p)
{
  gg_md_queue *q = &p->engine->queue;
  p->counts.cancelled++;
  gg_md_take_back_all(p);
  for (int k = 0; k < p->n_slabs; k++)
    for (int to = 0; to < p->n_slabs; to++) {
      const gg_md_growing *mail = &p->slab[k].mail[to];
      if (mail->n) memcpy(q->due + q->n_due, mail->item, mail->n * sizeof *q->due);
      q->n_due += mail->n;
    }
  qsort(q->due, q->n_due, sizeof *q->due, latest_first);
}

/* Then what the window has done cannot be taken back, and the run is over. */
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
    gg_md_settle(p);
    return !lacks_memory(p);
  }
  cancel(p);
  return false;
}
