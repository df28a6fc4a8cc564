/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of runs whose events several threads share, and the sequence of their windows. */
#include "md/parallel/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "common/thermostat.h"
#include "md/aligned_memory.h"
#include "md/parallel/slab.h"
#include "md/select_search.h"

enum {
  BUCKETS_OF_A_SLAB = 96,  /* in a window, so few that the log of a slab stays in the cache */
  FEWEST_WINDOWS = 128,    /* in an epoch: in shorter windows fewer events depend on a deferred one */
  FEWEST_BUCKETS = 32,     /* in a window */
  FEWEST_LAYERS = 6,       /* of cells in a slab */
  WINDOWS_PER_POLL = 16,   /* between polls of `stop` */
  SERIAL_EVENTS = 1 << 15, /* without windows after a cancelled one */
  TRIALS = 16,             /* one in so many spans of events takes the slower way, to measure it again */
  TRIAL_EVENTS = 1 << 17   /* most events of such a span */
};

/* Serial events are chosen if they take less than this fraction of the time of parallel events. */
#define FASTER 0.95

const char *gg_md_serial_because(const gg_model *m)
{
  double radius;
  int32_t n[3];
  const gg_md_search_kind kind = gg_md_search_select(m, &radius, n);
  if (m->walled) return "walls";
  if (gg_common_heat_of(m) != GG_UNHEATED) return "a thermostat: it couples all grains";
  if (m->law.e) return "a law of restitution of your own";
  if (n[0] < 4 || n[1] < 4 || n[2] < 2 * FEWEST_LAYERS || (kind == GG_MD_PLAIN_CELLS && gg_model_is_sheared(m)))
    return "a small box";
  return NULL;
}

int gg_md_most_slabs(const gg_model *m)
{
  double radius;
  int32_t n[3];
  gg_md_search_select(m, &radius, n);
  if (gg_md_serial_because(m)) return 1;
  const int slabs = n[2] / FEWEST_LAYERS;
  return slabs < GG_MD_MOST_SLABS ? slabs : GG_MD_MOST_SLABS;
}

static void free_slab(gg_md_slab *s)
{
  gg_md_growing *lists[] = {&s->due, &s->fresh, &s->deferring, &s->deferred, &s->rolled_back, &s->full_buckets};
  for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) free(lists[k]->item);
  for (int k = 0; k < GG_MD_MOST_SLABS; k++) free(s->outbox[k].item);
  for (int phase = 0; phase < GG_MD_PHASES; phase++) {
    gg_md_log *log = &s->log[phase];
    for (int k = 0; k < GG_MD_LOG_PARTS; k++) free(log->part[k].item);
    for (int k = 0; k < GG_MD_MOST_SLABS; k++) free(s->moves[phase][k].item);
  }
  gg_md_local_free(s->local);
}

void gg_md_parallel_free(gg_md *e)
{
  gg_md_parallel *p = e->parallel;
  if (!p) return;
  gg_base_thread_pool_free(p->pool);
  for (int k = 0; p->slab && k < p->n_slabs; k++) free_slab(&p->slab[k]);
  for (int phase = 0; phase < GG_MD_PHASES; phase++) free(p->layers[phase]);
  free(p->slab);
  free(p->layer);
  free(p->cell);
  free(p->mark);
  free(p);
  e->parallel = NULL;
}

/* Partition the layers into slabs of equal height; in the second phase half a slab higher, in the last phase one slab.
 */
static void partition_layers(const gg_md_parallel *p, int32_t n)
{
  for (int phase = 0; phase < 2; phase++)
    for (int k = 0; k < p->n_slabs; k++) {
      const int32_t slabs = 2 * p->n_slabs, from = n * (2 * k + phase) / slabs, to = n * (2 * k + 2 + phase) / slabs;
      for (int32_t z = from; z < to; z++) {
        p->layers[phase][z % n] = (gg_md_layer){(uint8_t)k, z == from || z == to - 1};
      }
    }
  for (int32_t z = 0; z < n; z++) p->layers[2][z] = (gg_md_layer){0, false};
}

static bool make_slab(gg_md_parallel *p, int k)
{
  gg_md_slab *s = &p->slab[k];
  s->all = p;
  s->self = k;
  s->mark = (uint32_t)k;
  s->local = gg_md_local_new();
  return s->local != NULL;
}

static uint32_t smaller(uint32_t a, uint32_t b)
{
  return a < b ? a : b;
}

static bool make(gg_md *e, int threads)
{
  gg_md_parallel *p = e->parallel = gg_base_array_new(1, sizeof *p, NULL);
  if (!p) return false;
  const int32_t *n = e->cells.n;
  p->engine = e;
  p->n_slabs = threads;
  p->n_cells = (size_t)n[0] * (size_t)n[1] * (size_t)n[2];
  p->n_buckets = smaller(BUCKETS_OF_A_SLAB * (uint32_t)threads, e->queue.n_buckets / FEWEST_WINDOWS);
  if (p->n_buckets < FEWEST_BUCKETS) p->n_buckets = FEWEST_BUCKETS;
  p->slab = gg_md_new_lines((size_t)threads, sizeof *p->slab, NULL);
  p->layer = gg_md_new_lines(e->n, sizeof *p->layer, NULL);
  p->cell = gg_md_new_lines(p->n_cells, sizeof *p->cell, NULL);
  p->mark = gg_md_new_lines(p->n_cells, sizeof *p->mark, NULL);
  for (int phase = 0; phase < GG_MD_PHASES; phase++)
    if (!(p->layers[phase] = gg_base_array_new((size_t)n[2], sizeof *p->layers[phase], NULL))) return false;
  if (!p->slab || !p->layer || !p->cell || !p->mark) return false;
  for (int k = 0; k < threads; k++)
    if (!make_slab(p, k)) return false;
  partition_layers(p, n[2]);
  p->pool = gg_base_thread_pool_new(threads);
  return p->pool != NULL;
}

void gg_md_use_threads(gg_md *e, int threads, bool adapts)
{
  const int most = gg_md_most_slabs(&e->model);
  gg_md_parallel_free(e);
  if (threads > most) threads = most;
  if (threads > 1 && !make(e, threads)) gg_md_parallel_free(e);
  if (e->parallel) e->parallel->adapts = adapts;
}

double gg_md_parallel_cpu(const gg_md *e)
{
  return e->parallel ? gg_base_thread_pool_cpu(e->parallel->pool) : 0;
}

static void set_layers(void *context, int self)
{
  const gg_md_parallel *p = context;
  const gg_md *e = p->engine;
  const uint64_t n = e->n, from = n * (uint64_t)self / (uint64_t)p->n_slabs,
                 to = n * (uint64_t)(self + 1) / (uint64_t)p->n_slabs;
  for (uint64_t i = from; i < to; i++) gg_md_set_layer(p, e, (uint32_t)i);
}

static void renew_local(gg_md_slab *s)
{
  gg_md_local_renew(s->local, s->all->engine);
  s->local->queue.due = s->pair;
  s->local->look_at = 1;
  s->local->k.collisions_left = UINT64_MAX / 2;
  s->local->k.stop = INFINITY;
}

static void begin(gg_md_parallel *p)
{
  gg_base_thread_pool_for(p->pool, p->n_slabs, set_layers, p);
  for (int k = 0; k < p->n_slabs; k++) renew_local(&p->slab[k]);
}

/* Choose the buckets of the next window. False: none fits before the next stop. */
static bool choose_window(gg_md_parallel *p)
{
  const gg_md *e = p->engine;
  double stop = e->k.stop;
  if (gg_md_search_has_rows(e->search.kind)) stop = fmin(stop, e->search.rows.next_shift);
  const uint64_t last = gg_md_bucket_of(&e->queue, stop), begin = e->queue.current + 1,
                 most = e->k.collisions_left / GG_MD_BUCKET_MEAN;
  uint64_t size = p->n_buckets;
  if (last < begin + 2 * size) size = last > begin ? last - begin : 0;
  if (size > most) size = most;
  p->begin = (uint32_t)begin;
  p->end = (uint32_t)(begin + size);
  return size >= FEWEST_BUCKETS && gg_md_measure_around(p);
}

/* Choose the faster way for the next span of events; once in a while the slower way, to compare. Under contention for
 * the processors events are serial, and the span is not timed. */
static void begin_trial(gg_md_parallel *p, bool contended)
{
  gg_md_trial *t = &p->trial;
  const uint64_t events = p->engine->k.events;
  const double now = gg_base_clock_wall();
  if (t->until > 0 && events > t->from && (t->serial || !contended))
    t->cost[t->serial] = (now - t->began) / (double)(events - t->from);
  const bool faster = t->cost[1] < FASTER * t->cost[0];
  if (contended)
    t->serial = true;
  else if (t->cost[1] == 0 || t->cost[0] == 0)
    t->serial = t->cost[0] > 0;
  else
    t->serial = ++t->number % TRIALS == 0 ? !faster : faster;
  t->from = events;
  t->until = events + (t->serial == faster ? p->engine->n / 2 : smaller(p->engine->n / 2, TRIAL_EVENTS));
  t->began = now;
}

static bool is_serial(gg_md_parallel *p)
{
  if (p->adapts) {
    const bool over = p->engine->k.events >= p->trial.until;
    if (over || !p->trial.serial) {
      const bool contended = gg_base_thread_pool_is_contended(p->pool);
      if (over || contended) begin_trial(p, contended);
    }
  }
  return p->trial.serial || p->engine->k.events < p->serial_until;
}

static bool is_over(const gg_md_parallel *p)
{
  return gg_stop_asked(p->engine->model.stop) || (p->adapts && gg_base_thread_pool_is_contended(p->pool));
}

bool gg_md_run_windows(gg_md *e)
{
  gg_md_parallel *p = e->parallel;
  if (e->callback || e->plain || e->k.next_kick < INFINITY || is_serial(p) || !choose_window(p)) return false;
  begin(p);
  int k = 0;
  do {
    if (!gg_md_run_window(p)) {
      p->serial_until = e->k.events + SERIAL_EVENTS;
      return false;
    }
  } while (++k % WINDOWS_PER_POLL || !is_over(p) ? choose_window(p) : false);
  return true;
}
