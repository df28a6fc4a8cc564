/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sampling of a replica. Rows are made of chunks or blocks of grains at the end of every sampling interval. Curves are
 * made of whole snapshots when an observable is due. */
#include <math.h>

#include "measure/bursts.h"
#include "measure/wall_modes.h"
#include "run/replica.h"

static void add_collision(void *context, const gg_collision_record *collision)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->collisions && (!collision->wall || r->observable[k]->collisions->of_walls_too))
      r->observable[k]->collisions->add(r->self[k], collision);
}

/* True if an observable needs collisions. *in_bursts: callbacks slow the engine down, and no observable needs all
 * collisions. */
static bool need_collisions(const gg_replica *r, bool *in_bursts)
{
  bool any = false;
  *in_bursts = r->engine->ops->callback_slows && r->engine->ops->callback_slows(r->engine);
  for (int k = 0; k < r->n_observables; k++) {
    if (!gg_measure_observable_wants_collisions(r->observable[k], &r->model)) continue;
    any = true;
    if (!r->observable[k]->collisions->begin_burst) *in_bursts = false;
  }
  return any;
}

static bool has_bursts(const gg_observable *o)
{
  return o->collisions && o->collisions->begin_burst;
}

static void begin_burst(gg_replica *r)
{
  for (int k = 0; k < r->n_observables; k++)
    if (has_bursts(r->observable[k])) r->observable[k]->collisions->begin_burst(r->self[k]);
}

gg_status gg_run_replica_observe_collisions(gg_replica *r, gg_error *err)
{
  bool in_bursts;
  if (!need_collisions(r, &in_bursts)) return GG_OK;
  const gg_bursts bursts = gg_measure_bursts_of(&r->model);
  const uint64_t at = gg_measure_since_burst(&bursts, r->clock.window_samples);
  const enum gg_observed wanted = !in_bursts || at < bursts.length ? GG_OBSERVED : GG_NOT_OBSERVED;
  const bool begins = in_bursts && at == 0 && !r->clock.part; /* part: the burst of a resumed interval has begun */
  if (begins) begin_burst(r);
  if (wanted == r->shown) return GG_OK;
  r->shown = wanted;
  return r->engine->ops->set_callback(r->engine, wanted == GG_OBSERVED ? add_collision : NULL, r, err);
}

/* True if the present sample of observable k is in a burst and not its last. All samples of a burst are one sample of
 * its bins, because only bursts are independent enough for errors. */
static bool in_burst(const gg_replica *r, int k)
{
  bool in_bursts;
  const gg_bursts bursts = gg_measure_bursts_of(&r->model);
  return has_bursts(r->observable[k]) && need_collisions(r, &in_bursts) && in_bursts &&
         gg_measure_since_burst(&bursts, r->clock.window_samples) < bursts.length - 1;
}

static void add_chunk(void *context, const gg_chunk *chunk)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->rows && r->observable[k]->rows->add_chunk)
      r->observable[k]->rows->add_chunk(r->self[k], chunk);
}

static void add_blocks(void *context, const gg_block_run *run)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->rows && r->observable[k]->rows->add_blocks)
      r->observable[k]->rows->add_blocks(r->self[k], run);
}

/* True if the engine has blocks, and every observable that reads grains for its row can read blocks. */
static bool reads_blocks(const gg_replica *r)
{
  bool all = r->engine->ops->blocks != NULL;
  for (int k = 0; k < r->n_observables; k++) {
    const gg_observable_rows *rows = r->observable[k]->rows;
    all &= !rows || !rows->add_chunk || rows->add_blocks;
  }
  return all;
}

/* True if rows need positions and the engine has them. */
static bool reads_positions(const gg_replica *r)
{
  for (int k = 0; k < r->n_observables; k++) {
    const gg_observable *o = r->observable[k];
    if (o->rows && (o->positions || (o->rows->wants_positions && o->rows->wants_positions(r->self[k]))))
      return !r->model.homogeneous;
  }
  return false;
}

/* Between walls: velocities about the flow of all samples of the window, this one included. */
static void add_grains_between_walls(gg_replica *r)
{
  gg_slabs now;
  gg_measure_slabs_take(&now, &r->model, r->engine);
  if (r->clock.averaging) gg_measure_slabs_add(&r->flow->window, &now);
  gg_measure_local_frame_of_flow(&r->flow->frame, &r->model, r->clock.averaging ? &r->flow->window : &now);
  gg_measure_local_frame_snapshot(&r->flow->frame, r->engine, add_chunk, r);
  gg_measure_wall_modes_take(&r->model, &now, r->row + r->wall_modes_at);
}

static void add_grains(gg_replica *r)
{
  if (r->flow) {
    add_grains_between_walls(r);
  } else if (r->framed) {
    gg_measure_snapshot_take(&r->snapshot, r->engine);
    gg_measure_framed_take(r->framed, &r->snapshot);
    gg_measure_framed_visit(r->framed, add_chunk, r);
  } else if (reads_blocks(r)) {
    r->engine->ops->blocks(r->engine, add_blocks, r);
  } else {
    r->engine->ops->snapshot(r->engine, reads_positions(r), add_chunk, r);
  }
}

void gg_run_replica_sample_row(gg_replica *r, double elapsed)
{
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->rows && r->observable[k]->rows->begin) r->observable[k]->rows->begin(r->self[k]);
  add_grains(r);
  gg_collision_sums transfer;
  r->engine->ops->take_sums(r->engine, &transfer);
  gg_interval in = {&r->model, &transfer, elapsed, r->clock.velocity_factor};
  for (int k = 0; k < r->n_observables; k++) {
    const gg_observable *o = r->observable[k];
    if (o->rows) o->rows->finish(r->self[k], &in, r->row + r->offset[k]);
    if (o->curves && o->curves->add_interval && r->clock.averaging) o->curves->add_interval(r->self[k], &in);
  }
  r->clock.velocity_factor = 1;
}

/* Observables of several parts take a snapshot after each of them; the others at the end of every so-many-th interval.
 */
static bool is_due(const gg_replica *r, int k, bool last)
{
  const gg_observable *o = r->observable[k];
  if (!o->curves || !gg_measure_observable_applies(o, &r->model)) return false;
  if (gg_measure_observable_wants_collisions(o, &r->model) && r->shown != GG_OBSERVED) return false;
  return o->curves->parts > 1 || (last && r->clock.window_samples % (uint64_t)r->every[k] == 0);
}

static void take_snapshot(gg_replica *r, int part, double part_elapsed)
{
  gg_snapshot *s = &r->snapshot;
  gg_measure_snapshot_take(s, r->engine);
  s->elapsed = part_elapsed;
  s->velocity_factor = part == 1 ? r->clock.velocity_factor : 1;
  if (r->framed) gg_measure_framed_take(r->framed, s);
  if (!r->flow || !s->r[0]) return;
  s->frame = &r->flow->frame;
  if (!gg_measure_slabs_are_empty(&r->flow->window)) return;
  gg_slabs now; /* before the first row of the window */
  gg_measure_slabs_of_snapshot(&now, s);
  gg_measure_local_frame_of_flow(&r->flow->frame, &r->model, &now);
}

void gg_run_replica_sample_curves(gg_replica *r, int part, int parts, double part_elapsed)
{
  bool any = false, last = part == parts;
  for (int k = 0; k < r->n_observables; k++) any |= is_due(r, k, last);
  if (any) take_snapshot(r, part, part_elapsed);
  for (int k = 0; k < r->n_observables; k++) {
    if (!is_due(r, k, last)) continue;
    const gg_snapshot *s = r->framed && r->observable[k]->curves->framed ? &r->framed->snapshot : &r->snapshot;
    r->observable[k]->curves->add_snapshot(r->self[k], s, gg_statistics_bins_sample(&r->bins[k]));
    if (last && !in_burst(r, k)) gg_statistics_bins_commit(&r->bins[k]);
  }
  if (last) r->clock.window_samples++;
}

void gg_run_replica_restart_curves(gg_replica *r)
{
  r->clock.averaging = 1;
  r->clock.window_samples = 0;
  if (r->flow) gg_measure_slabs_init(&r->flow->window, &r->model);
  for (int k = 0; k < r->n_observables; k++) {
    gg_statistics_bins_restart(&r->bins[k]);
    if (r->observable[k]->restart) r->observable[k]->restart(r->self[k]);
    if (!r->bins[k].whole) continue;
    take_snapshot(r, 0, 0); /* the beginning of the transient */
    r->observable[k]->curves->add_snapshot(r->self[k], &r->snapshot, gg_statistics_bins_sample(&r->bins[k]));
  }
}

void gg_run_replica_change_curves(gg_replica *r)
{
  r->shown = GG_OBSERVED_UNSET;
  if (!r->clock.averaging) return;
  gg_run_replica_restart_curves(r);
  begin_burst(r);
}
