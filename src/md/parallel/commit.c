/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commit of a window: its moves are applied to the event queue, and its counts and sums are added in the order of time,
 * whatever the order in which its events ran. */
#include <math.h>
#include <stdlib.h>

#include "md/parallel/slab.h"

enum { AHEAD = 8, MOST_LOGS = 2 * GG_MD_MOST_SLABS + 1 };

/* Apply moves to buckets. Overflow lists link grains of several slabs, so the few moves of full buckets are left to one
 * thread. */
static void apply(gg_md_slab *s, const gg_md_growing *moves)
{
  const gg_md_queue *q = &s->all->engine->queue;
  const gg_md_move *m = moves->item;
  for (uint32_t k = 0; k < moves->n; k++) {
    if (k + AHEAD < moves->n) __builtin_prefetch(&q->bucket[m[k + AHEAD].bucket & ~GG_MD_OUT], 1);
    gg_md_bucket *bucket = &q->bucket[m[k].bucket & ~GG_MD_OUT];
    if (!(m[k].bucket & GG_MD_OUT ? gg_md_bucket_take(bucket, m[k].grain) : gg_md_bucket_add(bucket, m[k].grain)))
      *(gg_md_move *)gg_md_append(s, &s->full_buckets, sizeof *m) = m[k];
  }
}

/* Apply moves phase by phase: within a phase all moves of a grain are in one slab. */
static void apply_part(void *context, int self)
{
  const gg_md_parallel *p = context;
  for (int phase = 0; phase < GG_MD_PHASES; phase++)
    for (int k = 0; k < p->n_slabs; k++) apply(&p->slab[self], &p->slab[k].moves[phase][self]);
}

static int in_order(const void *a, const void *b)
{
  const uint64_t x = ((const gg_md_move *)a)->order, y = ((const gg_md_move *)b)->order;
  return (x > y) - (x < y);
}

static void apply_to_full_buckets(gg_md_parallel *p)
{
  const gg_md *e = p->engine;
  gg_md_growing *all = &p->slab[0].full_buckets;
  for (int k = 1; k < p->n_slabs; k++)
    for (uint32_t m = 0; m < p->slab[k].full_buckets.n; m++)
      *(gg_md_move *)gg_md_append(&p->slab[0], all, sizeof(gg_md_move)) =
          ((gg_md_move *)p->slab[k].full_buckets.item)[m];
  if (all->n) qsort(all->item, all->n, sizeof(gg_md_move), in_order);
  for (uint32_t k = 0; k < all->n; k++) {
    const gg_md_move *m = (gg_md_move *)all->item + k;
    gg_md_bucket *bucket = &e->queue.bucket[m->bucket & ~GG_MD_OUT];
    (m->bucket & GG_MD_OUT ? gg_md_queue_unchain : gg_md_queue_chain)(bucket, e->node, m->grain);
  }
}

static void count(gg_md_counts *k, const gg_md_record *r, const gg_md_addend *a)
{
  k->events++;
  if (r->partner == GG_MD_NONE) return;
  k->collisions++;
  k->collisions_left--;
  k->treated += r->treated;
  k->clamped += r->clamped;
  k->worst_overlap = fmax(k->worst_overlap, a->overlap);
  k->transfer.collisions[r->pair]++;
  double(*stress)[3] = k->transfer.stress[r->pair];
  for (int c = 0; c < 3; c++) stress[c][c] += a->stress[c];
  stress[0][1] += a->stress[3];
  stress[1][0] += a->stress[4];
  k->transfer.loss[r->pair] += a->loss;
  k->transfer.given[r->pair] += a->given;
}

static bool is_earlier(const gg_md_record *a, const gg_md_record *b)
{
  return a->time < b->time || (a->time == b->time && a->grain < b->grain);
}

static const gg_md_log *log_of(const gg_md_parallel *p, int k)
{
  return k == 2 * p->n_slabs ? &p->slab[0].log[2] : &p->slab[k / 2].log[k % 2];
}

/* Merge all logs in the order of time. */
static void count_all(gg_md_parallel *p)
{
  gg_md_counts *k = &p->engine->k;
  const gg_md_record *next[MOST_LOGS], *end[MOST_LOGS];
  const gg_md_addend *addend[MOST_LOGS];
  int n = 0;
  for (int m = 0; m <= 2 * p->n_slabs; m++) {
    const gg_md_log *log = log_of(p, m);
    if (!log->part[GG_MD_LOG_RECORDS].n) continue;
    next[n] = log->part[GG_MD_LOG_RECORDS].item;
    end[n] = next[n] + log->part[GG_MD_LOG_RECORDS].n;
    addend[n++] = log->part[GG_MD_LOG_ADDENDS].item;
  }
  while (n) {
    int first = 0;
    for (int m = 1; m < n; m++)
      if (is_earlier(next[m], next[first])) first = m;
    const gg_md_record *r = next[first]++;
    if (r->rolled_back)
      p->counts.rolled_back++;
    else
      count(k, r, addend[first] + r->beside), k->now = r->time;
    if (next[first] < end[first]) continue;
    n--;
    next[first] = next[n];
    end[first] = end[n];
    addend[first] = addend[n];
  }
}

uint64_t gg_md_window_collisions(const gg_md_parallel *p)
{
  uint64_t events = 0, collisions = 0;
  for (int k = 0; k <= 2 * p->n_slabs; k++) events += log_of(p, k)->part[GG_MD_LOG_RECORDS].n;
  if (events < p->engine->k.collisions_left) return events;
  for (int k = 0; k <= 2 * p->n_slabs; k++)
    for (uint32_t m = 0; m < log_of(p, k)->part[GG_MD_LOG_RECORDS].n; m++) {
      const gg_md_record *r = gg_md_record_at(log_of(p, k), m);
      collisions += !r->rolled_back && r->partner != GG_MD_NONE;
    }
  return collisions;
}

void gg_md_commit(gg_md_parallel *p)
{
  gg_base_thread_pool_for(p->pool, p->n_slabs, apply_part, p);
  apply_to_full_buckets(p);
  const uint64_t before = p->engine->k.events;
  count_all(p);
  p->counts.events += p->engine->k.events - before;
}
