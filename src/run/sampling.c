/* How a replica is sampled. For rows: chunk by chunk, or block by block, at the end of every sampling interval. For
 * curves: whole snapshots, where an observable is due. */
#include "measure/wall_modes.h"
#include "run/replica.h"

static void add_chunk(void *context, const gg_chunk *chunk)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->width) r->observable[k]->add_chunk(r->self[k], chunk);
}

static void add_blocks(void *context, const gg_block_run *run)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->width) r->observable[k]->add_blocks(r->self[k], run);
}

/* The engine has blocks, and every observable with rows can read them. */
static bool reads_blocks(const gg_replica *r)
{
  bool all = r->engine->ops->blocks != NULL;
  for (int k = 0; k < r->n_observables; k++) all &= !r->observable[k]->width || r->observable[k]->add_blocks;
  return all;
}

/* Where rows are made of positions, too, and the engine has any. */
static bool reads_positions(const gg_replica *r)
{
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->width && r->observable[k]->positions) return !r->model.homogeneous;
  return false;
}

/* Between walls: velocities about the flow of all samples of the window, this one included. */
static void add_grains_between_walls(gg_replica *r)
{
  gg_slabs now;
  gg_measure_slabs_take(&now, &r->model, r->engine);
  if (r->clock.averaging) gg_measure_slabs_add(&r->flow->window, &now);
  gg_measure_local_frame_make(&r->flow->frame, r->clock.averaging ? &r->flow->window : &now);
  gg_measure_local_frame_snapshot(&r->flow->frame, r->engine, add_chunk, r);
  gg_measure_wall_modes_take(&r->model, &now, r->row + r->wall_modes_at);
}

static void add_grains(gg_replica *r)
{
  if (r->flow) {
    add_grains_between_walls(r);
  } else if (reads_blocks(r)) {
    r->engine->ops->blocks(r->engine, add_blocks, r);
  } else {
    r->engine->ops->snapshot(r->engine, reads_positions(r), add_chunk, r);
  }
}

void gg_run_replica_sample_row(gg_replica *r, double elapsed)
{
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->width) r->observable[k]->begin(r->self[k]);
  add_grains(r);
  gg_collision_sums transfer;
  r->engine->ops->take_sums(r->engine, &transfer);
  gg_interval in = {&r->model, &transfer, elapsed, r->clock.velocity_factor};
  for (int k = 0; k < r->n_observables; k++) {
    const gg_observable *o = r->observable[k];
    if (o->width) o->finish(r->self[k], &in, r->row + r->offset[k]);
    if (o->add_interval && r->clock.averaging) o->add_interval(r->self[k], &in);
  }
  r->clock.velocity_factor = 1;
}

/* Observables of several parts take a snapshot after each of them; the others at the end of every so-many-th interval.
 */
static bool is_due(const gg_replica *r, int k, int part)
{
  const gg_observable *o = r->observable[k];
  if (!o->bins || (gg_measure_observable_wants_collisions(o, &r->model) && r->shown != GG_OBSERVED)) return false;
  return o->parts > 1 || (part == r->parts && r->clock.window_samples % (uint64_t)r->every[k] == 0);
}

static void take_snapshot(gg_replica *r, int part, double part_elapsed)
{
  gg_snapshot *s = &r->snapshot;
  gg_measure_snapshot_take(s, r->engine);
  s->elapsed = part_elapsed;
  s->velocity_factor = part == 1 ? r->clock.velocity_factor : 1;
  if (!r->flow || !s->r[0]) return;
  s->frame = &r->flow->frame;
  if (!gg_measure_slabs_are_empty(&r->flow->window)) return;
  gg_slabs now; /* before the first row of the window */
  gg_measure_slabs_of_snapshot(&now, s);
  gg_measure_local_frame_make(&r->flow->frame, &now);
}

void gg_run_replica_sample_curves(gg_replica *r, int part, double part_elapsed)
{
  bool any = false, last = part == r->parts;
  for (int k = 0; k < r->n_observables; k++) any |= is_due(r, k, part);
  if (any) take_snapshot(r, part, part_elapsed);
  for (int k = 0; k < r->n_observables; k++) {
    if (!is_due(r, k, part)) continue;
    r->observable[k]->add_snapshot(r->self[k], &r->snapshot, gg_statistics_bins_sample(&r->bins[k]));
    if (last && !gg_run_replica_in_burst(r, k)) gg_statistics_bins_commit(&r->bins[k]);
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
  }
}
