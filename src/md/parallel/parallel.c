/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which runs share their events among threads, and whole windows of them. */
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

/* Buckets of a window for each slab: so few that its log stays in the cache. Windows of an epoch at least: in shorter
 * ones fewer events depend on one that was put off. Buckets at least; layers of cells that a slab has at least; windows
 * between looks at whether to stop; events after a cancelled window without any; spans of events of which one goes the
 * slower way, to see whether it still is, for so many events at most. */
enum {
  BUCKETS_OF_A_SLAB = 96,
  FEWEST_WINDOWS = 128,
  FEWEST_BUCKETS = 32,
  FEWEST_LAYERS = 6,
  WINDOWS_BETWEEN_LOOKS = 16,
  SERIAL_EVENTS = 1 << 15,
  TRIALS = 16,
  TRIAL_EVENTS = 1 << 17
};

#define FASTER 0.95

const char *gg_md_serial_because(const gg_model *m)
{
  double radius;
  int32_t n[3];
  const gg_md_search_kind kind = gg_md_search_select(m, &radius, n);
  if (m->walled) return "walls";
  if (gg_common_thermostat_of(m) != GG_NO_THERMOSTAT) return "a thermostat: it couples all grains";
  if (m->law.e) return "a law of restitution of your own";
  if (n[0] < 4 || n[1] < 4 || n[2] < 2 * FEWEST_LAYERS || (kind == GG_MD_PLAIN_CELLS && m->shear_rate != 0))
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
  gg_md_growing *lists[] = {&s->due, &s->fresh, &s->late, &s->put_off, &s->back, &s->overflow};
  for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) free(lists[k]->item);
  for (int k = 0; k < GG_MD_MOST_SLABS; k++) free(s->mail[k].item);
  for (int phase = 0; phase < GG_MD_PHASES; phase++) {
    gg_md_log *log = &s->log[phase];
    for (int k = 0; k < GG_MD_LOG_PARTS; k++) free(((gg_md_growing *)log)[k].item);
    for (int k = 0; k < GG_MD_MOST_SLABS; k++) free(s->moves[phase][k].item);
  }
  gg_md_view_free(s->view);
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

/* Slabs of equal height, those of the second phase half a slab higher; in the last there is one. */
static void cut_slabs(const gg_md_parallel *p, int32_t n)
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
  s->view = gg_md_view_new();
  return s->view != NULL;
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
  cut_slabs(p, n[2]);
  p->pool = gg_base_thread_pool_new(threads);
  return p->pool != NULL;
}

void gg_md_share(gg_md *e, int threads, bool adapts)
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

static void note_layers(void *context, int self)
{
  const gg_md_parallel *p = context;
  const gg_md *e = p->engine;
  const uint64_t n = e->n, from = n * (uint64_t)self / (uint64_t)p->n_slabs,
                 to = n * (uint64_t)(self + 1) / (uint64_t)p->n_slabs;
  for (uint64_t i = from; i < to; i++) gg_md_note_layer(p, e, (uint32_t)i);
}

static void renew_view(gg_md_slab *s)
{
  gg_md_view_renew(s->view, s->all->engine);
  s->view->queue.due = s->pair;
  s->view->look_at = 1;
  s->view->k.collisions_left = UINT64_MAX / 2;
  s->view->k.stop = INFINITY;
}

static void begin(gg_md_parallel *p)
{
  gg_base_thread_pool_for(p->pool, p->n_slabs, note_layers, p);
  for (int k = 0; k < p->n_slabs; k++) renew_view(&p->slab[k]);
}

/* The buckets of the next window; false: there is no room for one. */
static bool plan(gg_md_parallel *p)
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

/* The next span of events goes the faster way; once in a while the other way, to compare. */
static void begin_trial(gg_md_parallel *p)
{
  gg_md_trial *t = &p->trial;
  const uint64_t events = p->engine->k.events;
  const double now = gg_base_clock_wall();
  if (t->until > 0 && events > t->from) t->cost[t->serial] = (now - t->began) / (double)(events - t->from);
  const bool faster = t->cost[1] < FASTER * t->cost[0];
  if (t->cost[1] == 0 || t->cost[0] == 0)
    t->serial = t->cost[0] > 0;
  else
    t->serial = ++t->number % TRIALS == 0 ? !faster : faster;
  t->from = events;
  t->until = events + (t->serial == faster ? p->engine->n / 2 : smaller(p->engine->n / 2, TRIAL_EVENTS));
  t->began = now;
}

static bool goes_serial(gg_md_parallel *p)
{
  if (p->adapts && p->engine->k.events >= p->trial.until) begin_trial(p);
  return p->trial.serial || p->engine->k.events < p->serial_until;
}

bool gg_md_run_windows(gg_md *e)
{
  gg_md_parallel *p = e->parallel;
  if (e->callback || e->plain || e->k.next_kick < INFINITY || goes_serial(p) || !plan(p)) return false;
  begin(p);
  int k = 0;
  do {
    if (!gg_md_run_window(p)) {
      p->serial_until = e->k.events + SERIAL_EVENTS;
      return false;
    }
  } while (++k % WINDOWS_BETWEEN_LOOKS || !gg_stop_asked(e->model.stop) ? plan(p) : false);
  return true;
}
