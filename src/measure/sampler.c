/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/sampler.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/wall_modes.h"

/* Add an observable; its channels are the next of a row. */
static gg_status attach(gg_sampler *s, const gg_observable *o, gg_error *err)
{
  int k = s->n_observables;
  s->self[k] = o->create(s->model, err);
  if (!s->self[k]) return GG_FAILED;
  s->observable[k] = o;
  s->n_observables++;
  s->offset[k] = s->width;
  if (o->rows) s->width += o->rows->width(s->model);
  const gg_observable_curves *c = o->curves;
  if (!c) return GG_OK;
  if (c->parts > s->parts) s->parts = c->parts;
  s->every[k] = c->every_of ? c->every_of(s->self[k]) : c->every;
  return gg_statistics_bins_init(&s->bins[k], c->bins(s->self[k]), err);
}

gg_status gg_measure_sampler_init(gg_sampler *s, const gg_model *model, unsigned flags, gg_error *err)
{
  bool curves = false, positions = false;
  const bool framed = model->frame != GG_FRAME_IMPOSED;
  const gg_observable *own = gg_measure_user_observables(model);
  s->model = model;
  s->parts = 1;
  for (int i = 0; gg_measure_observables[i]; i++)
    if (flags & gg_measure_observables[i]->flag) GG_TRY(attach(s, gg_measure_observables[i], err));
  for (int k = 0; k < s->n_observables; k++) {
    if (s->observable[k]->curves) curves = true;
    if (s->observable[k]->positions && !model->homogeneous) positions = true;
  }
  if (own) GG_TRY(attach(s, own, err));
  s->wall_modes_at = s->width;
  s->width += (size_t)gg_measure_wall_modes(model);
  s->row = gg_base_array_new(s->width, sizeof *s->row, err);
  if (!s->row) return GG_FAILED;
  if (curves || framed) GG_TRY(gg_measure_snapshot_init(&s->snapshot, model, positions || framed, err));
  if (framed && !(s->framed = gg_base_array_new(1, sizeof *s->framed, err))) return GG_FAILED;
  if (framed) GG_TRY(gg_measure_framed_init(s->framed, model, err));
  if (model->walled && !(s->flow = gg_base_array_new(1, sizeof *s->flow, err))) return GG_FAILED;
  if (s->flow) gg_measure_slabs_init(&s->flow->window, model);
  return GG_OK;
}

void gg_measure_sampler_clear(gg_sampler *s)
{
  for (int k = 0; k < s->n_observables; k++) {
    s->observable[k]->destroy(s->self[k]);
    gg_statistics_bins_clear(&s->bins[k]);
  }
  gg_measure_snapshot_clear(&s->snapshot);
  if (s->framed) gg_measure_framed_clear(s->framed);
  free(s->framed);
  free(s->flow);
  free(s->row);
  *s = (gg_sampler){0};
}

/* The sums of the flow between walls, of every slab. */
static size_t flow_bytes(const gg_sampler *s)
{
  return (size_t)s->flow->window.n * sizeof *s->flow->window.slab;
}

gg_status gg_measure_sampler_save(const gg_sampler *s, gg_archive *a, gg_error *err)
{
  for (int k = 0; k < s->n_observables; k++) {
    const gg_observable *o = s->observable[k];
    if (o->curves) GG_TRY(gg_statistics_bins_save(&s->bins[k], o->name, a, err));
    if (!o->memory) continue;
    size_t bytes;
    const void *memory = o->memory(s->self[k], &bytes);
    char name[64];
    snprintf(name, sizeof name, "observable/%s", o->name);
    GG_TRY(gg_base_archive_put(a, name, GG_ITEM_U8, memory, bytes, err));
  }
  if (!s->flow) return GG_OK;
  return gg_base_archive_put(a, "replica/flow", GG_ITEM_U8, s->flow->window.slab, flow_bytes(s), err);
}

gg_status gg_measure_sampler_restore(gg_sampler *s, const gg_archive *a, gg_error *err)
{
  for (int k = 0; k < s->n_observables; k++) {
    const gg_observable *o = s->observable[k];
    if (o->curves) GG_TRY(gg_statistics_bins_restore(&s->bins[k], o->name, a, err));
    if (!o->memory) continue;
    size_t bytes;
    void *memory = o->memory(s->self[k], &bytes);
    char name[64];
    snprintf(name, sizeof name, "observable/%s", o->name);
    GG_TRY(gg_base_archive_get(a, name, GG_ITEM_U8, memory, bytes, err));
    if (o->is_memory && !o->is_memory(s->self[k]))
      return gg_base_fail(err, GG_BAD_FILE, "the checkpoint is damaged: what '%s' remembers", o->name);
  }
  if (!s->flow) return GG_OK;
  GG_TRY(gg_base_archive_get(a, "replica/flow", GG_ITEM_U8, s->flow->window.slab, flow_bytes(s), err));
  gg_measure_local_frame_of_flow(&s->flow->frame, s->model, &s->flow->window);
  return GG_OK;
}

int gg_measure_sampler_find(const gg_sampler *s, gg_quantity q, gg_function *f)
{
  if (gg_common_quantity_missing(s->model, q)) return -1;
  for (int k = 0; k < s->n_observables; k++)
    if (s->observable[k]->rows && gg_measure_derived_find(s->observable[k]->rows->derived, q, f)) return k;
  return -1;
}

bool gg_measure_sampler_find_history(const gg_sampler *s, gg_quantity q, gg_function *f)
{
  const gg_observable *o = s->n_observables ? s->observable[0] : NULL;
  if (!o || !o->rows->history) return false;
  const bool decays = gg_measure_derived_find(o->rows->history, q, f);
  const unsigned lasting = GG_NEEDS_SCALE_SHOWN | (decays ? GG_NEEDS_SCALE : 0);
  if (gg_common_model_missing(s->model, gg_common_quantity_mask(q) & ~lasting)) return false;
  return decays || gg_measure_derived_find(o->rows->derived, q, f);
}

/* Engines report collisions always, or in bursts: dsmc is some thirty times slower meanwhile, so that bursts of one
 * sample in a hundred add a third to the time. Errors need sixteen bursts however short the run is. So bursts are close
 * together at first, then further and further apart. Their samples depend on the window alone: a resumed run has the
 * same bursts. */

static void add_collision(void *context, const gg_collision_record *collision)
{
  gg_sampler *s = context;
  for (int k = 0; k < s->n_observables; k++)
    if (s->observable[k]->collisions && (!collision->wall || s->observable[k]->collisions->of_walls_too))
      s->observable[k]->collisions->add(s->self[k], collision);
}

/* True if an observable needs collisions. *in_bursts: callbacks slow the engine down, and no observable needs all
 * collisions. */
static bool need_collisions(const gg_sampler *s, const gg_engine *engine, bool *in_bursts)
{
  bool any = false;
  *in_bursts = engine->ops->callback_slows && engine->ops->callback_slows(engine);
  for (int k = 0; k < s->n_observables; k++) {
    if (!gg_measure_observable_wants_collisions(s->observable[k], s->model)) continue;
    any = true;
    if (!s->observable[k]->collisions->begin_burst) *in_bursts = false;
  }
  return any;
}

/* A burst lasts for 24 collisions of a grain of the slowest species. Only flights that begin and end within the burst
 * are observed whole; with few collisions per burst only short flights would be. A species that collides more than
 * MOST_LONGER times more seldom than the average has no observed flights, instead of short ones only. */
enum { BURST = 12, BURSTS_ALIKE = 16, APART_FIRST = 32, GROWTH = 32, MOST_LONGER = 32 };
gg_bursts gg_measure_bursts_of(const gg_model *m)
{
  double slowest = INFINITY;
  for (int i = 0; i < m->n_species; i++) slowest = fmin(slowest, gg_common_model_species_rate(m, i, 1));
  double longer = fmin(ceil(gg_common_model_collision_rate(m, 1) / slowest * (1 - 1e-9)), MOST_LONGER);
  uint64_t length = BURST * (uint64_t)fmax(longer, 1), first = 2 * length > APART_FIRST ? 2 * length : APART_FIRST;
  return (gg_bursts){length, first, GROWTH * first, BURSTS_ALIKE * (GROWTH - 1) * first};
}

/* Samples since the last burst began: sixteen bursts follow each other at the least distance, as many at twice it,
 * and so on up to the largest. */
static uint64_t since_burst(const gg_bursts *e, uint64_t sample)
{
  uint64_t apart = e->first;
  for (; apart < e->apart && sample >= BURSTS_ALIKE * apart; apart *= 2) sample -= BURSTS_ALIKE * apart;
  return sample % apart;
}

static bool has_bursts(const gg_observable *o)
{
  return o->collisions && o->collisions->begin_burst;
}

static void begin_burst(gg_sampler *s)
{
  for (int k = 0; k < s->n_observables; k++)
    if (has_bursts(s->observable[k])) s->observable[k]->collisions->begin_burst(s->self[k]);
}

gg_status gg_measure_sampler_observe(gg_sampler *s, gg_engine *engine, uint64_t samples, bool within, gg_error *err)
{
  bool in_bursts;
  if (!need_collisions(s, engine, &in_bursts)) return GG_OK;
  const gg_bursts bursts = gg_measure_bursts_of(s->model);
  const uint64_t at = since_burst(&bursts, samples);
  const enum gg_observed wanted = !in_bursts || at < bursts.length ? GG_OBSERVED : GG_NOT_OBSERVED;
  const bool begins = in_bursts && at == 0 && !within; /* within: the burst of a resumed interval has begun */
  if (begins) begin_burst(s);
  if (wanted == s->shown) return GG_OK;
  s->shown = wanted;
  return engine->ops->set_callback(engine, wanted == GG_OBSERVED ? add_collision : NULL, s, err);
}

/* True if the present sample of observable k is in a burst and not its last. All samples of a burst are one sample of
 * its bins, because only bursts are independent enough for errors. */
static bool in_burst(const gg_sampler *s, const gg_engine *engine, int k, uint64_t samples)
{
  bool in_bursts;
  const gg_bursts bursts = gg_measure_bursts_of(s->model);
  return has_bursts(s->observable[k]) && need_collisions(s, engine, &in_bursts) && in_bursts &&
         since_burst(&bursts, samples) < bursts.length - 1;
}

static void add_chunk(void *context, const gg_chunk *chunk)
{
  gg_sampler *s = context;
  for (int k = 0; k < s->n_observables; k++)
    if (s->observable[k]->rows && s->observable[k]->rows->add_chunk)
      s->observable[k]->rows->add_chunk(s->self[k], chunk);
}

static void add_blocks(void *context, const gg_block_run *run)
{
  gg_sampler *s = context;
  for (int k = 0; k < s->n_observables; k++)
    if (s->observable[k]->rows && s->observable[k]->rows->add_blocks)
      s->observable[k]->rows->add_blocks(s->self[k], run);
}

/* True if the engine has blocks, and every observable that reads grains for its row can read blocks. */
static bool reads_blocks(const gg_sampler *s, const gg_engine *engine)
{
  bool all = engine->ops->blocks != NULL;
  for (int k = 0; k < s->n_observables; k++) {
    const gg_observable_rows *rows = s->observable[k]->rows;
    all &= !rows || !rows->add_chunk || rows->add_blocks;
  }
  return all;
}

/* True if rows need positions and the engine has them. */
static bool reads_positions(const gg_sampler *s)
{
  for (int k = 0; k < s->n_observables; k++) {
    const gg_observable *o = s->observable[k];
    if (o->rows && (o->positions || (o->rows->wants_positions && o->rows->wants_positions(s->self[k]))))
      return !s->model->homogeneous;
  }
  return false;
}

/* Between walls: velocities about the flow of all samples of the window, this one included. */
static void add_grains_between_walls(gg_sampler *s, gg_engine *engine, bool averaging)
{
  gg_slabs now;
  gg_measure_slabs_take(&now, s->model, engine);
  if (averaging) gg_measure_slabs_add(&s->flow->window, &now);
  gg_measure_local_frame_of_flow(&s->flow->frame, s->model, averaging ? &s->flow->window : &now);
  gg_measure_local_frame_snapshot(&s->flow->frame, engine, add_chunk, s);
  gg_measure_wall_modes_take(s->model, &now, s->row + s->wall_modes_at);
}

static void add_grains(gg_sampler *s, gg_engine *engine, bool averaging)
{
  if (s->flow) {
    add_grains_between_walls(s, engine, averaging);
  } else if (s->framed) {
    gg_measure_snapshot_take(&s->snapshot, engine);
    gg_measure_framed_take(s->framed, &s->snapshot);
    gg_measure_framed_visit(s->framed, add_chunk, s);
  } else if (reads_blocks(s, engine)) {
    engine->ops->blocks(engine, add_blocks, s);
  } else {
    engine->ops->snapshot(engine, reads_positions(s), add_chunk, s);
  }
}

void gg_measure_sampler_row(gg_sampler *s, gg_engine *engine, double elapsed, double velocity_factor, bool averaging)
{
  for (int k = 0; k < s->n_observables; k++)
    if (s->observable[k]->rows && s->observable[k]->rows->begin) s->observable[k]->rows->begin(s->self[k]);
  add_grains(s, engine, averaging);
  gg_collision_sums transfer;
  engine->ops->take_sums(engine, &transfer);
  gg_interval in = {s->model, &transfer, elapsed, velocity_factor};
  for (int k = 0; k < s->n_observables; k++) {
    const gg_observable *o = s->observable[k];
    if (o->rows) o->rows->finish(s->self[k], &in, s->row + s->offset[k]);
    if (o->curves && o->curves->add_interval && averaging) o->curves->add_interval(s->self[k], &in);
  }
}

/* Observables of several parts take a snapshot after each of them; the others at the end of every so-many-th interval.
 */
static bool is_due(const gg_sampler *s, int k, int part, uint64_t samples)
{
  const gg_observable *o = s->observable[k];
  if (!o->curves || !gg_measure_observable_applies(o, s->model)) return false;
  if (gg_measure_observable_wants_collisions(o, s->model) && s->shown != GG_OBSERVED) return false;
  return o->curves->parts > 1 || (part == s->parts && samples % (uint64_t)s->every[k] == 0);
}

static void take_snapshot(gg_sampler *s, gg_engine *engine, double elapsed, double velocity_factor)
{
  gg_snapshot *shot = &s->snapshot;
  gg_measure_snapshot_take(shot, engine);
  shot->elapsed = elapsed;
  shot->velocity_factor = velocity_factor;
  if (s->framed) gg_measure_framed_take(s->framed, shot);
  if (!s->flow || !shot->r[0]) return;
  shot->frame = &s->flow->frame;
  if (!gg_measure_slabs_are_empty(&s->flow->window)) return;
  gg_slabs now; /* before the first row of the window */
  gg_measure_slabs_of_snapshot(&now, shot);
  gg_measure_local_frame_of_flow(&s->flow->frame, s->model, &now);
}

void gg_measure_sampler_curves(gg_sampler *s, gg_engine *engine, int part, double elapsed, double velocity_factor,
                               uint64_t samples)
{
  bool any = false;
  for (int k = 0; k < s->n_observables; k++) any |= is_due(s, k, part, samples);
  if (any) take_snapshot(s, engine, elapsed, part == 1 ? velocity_factor : 1);
  for (int k = 0; k < s->n_observables; k++) {
    if (!is_due(s, k, part, samples)) continue;
    const gg_snapshot *shot = s->framed && s->observable[k]->curves->framed ? &s->framed->snapshot : &s->snapshot;
    s->observable[k]->curves->add_snapshot(s->self[k], shot, gg_statistics_bins_sample(&s->bins[k]));
    if (part == s->parts && !in_burst(s, engine, k, samples)) gg_statistics_bins_commit(&s->bins[k]);
  }
}

void gg_measure_sampler_restart(gg_sampler *s)
{
  if (s->flow) gg_measure_slabs_init(&s->flow->window, s->model);
  for (int k = 0; k < s->n_observables; k++) {
    gg_statistics_bins_restart(&s->bins[k]);
    if (s->observable[k]->restart) s->observable[k]->restart(s->self[k]);
  }
}

void gg_measure_sampler_change(gg_sampler *s, bool averaging)
{
  s->shown = GG_OBSERVED_UNSET;
  if (!averaging) return;
  gg_measure_sampler_restart(s);
  begin_burst(s);
}
