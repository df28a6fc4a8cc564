/* How a replica is looked at: chunk by chunk, or block by block, for rows at every sample; as whole snapshots for
 * curves, when one is due.
 */
#include "measure/local_frame.h"
#include "run/replica.h"

static void show_chunk(void *context, const gg_chunk *chunk)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->width) r->observable[k]->visit(r->self[k], chunk);
}

static void show_blocks(void *context, const gg_block_run *run)
{
  gg_replica *r = context;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->width) r->observable[k]->visit_blocks(r->self[k], run);
}

/* The engine has blocks, and all who look can read them. */
static bool sees_blocks(const gg_replica *r)
{
  bool all = r->engine->ops->blocks != NULL;
  for (int k = 0; k < r->n_observables; k++) all &= !r->observable[k]->width || r->observable[k]->visit_blocks;
  return all;
}

void gg_replica_look(gg_replica *r, double elapsed)
{
  gg_local_frame frame;
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->width) r->observable[k]->begin(r->self[k]);
  if (r->model.walled) {
    gg_local_frame_take(&frame, &r->model, r->engine);
    gg_local_frame_snapshot(&frame, r->engine, show_chunk, r);
  } else if (sees_blocks(r)) {
    r->engine->ops->blocks(r->engine, show_blocks, r);
  } else {
    r->engine->ops->snapshot(r->engine, false, show_chunk, r);
  }
  gg_transfer transfer;
  r->engine->ops->read_tap(r->engine, &transfer);
  gg_interval in = {&r->model, &transfer, elapsed, r->clock.velocity_factor};
  for (int k = 0; k < r->n_observables; k++) {
    const gg_observable *o = r->observable[k];
    if (o->width) o->finish(r->self[k], &in, r->row + r->offset[k]);
    if (o->hear && r->clock.averaging) o->hear(r->self[k], &in);
  }
  r->clock.velocity_factor = 1;
}

/* Those that look between samples look at every part; the others at the last part of every so-many-th sample. */
static bool is_due(const gg_replica *r, int k, int part)
{
  const gg_observable *o = r->observable[k];
  if (!o->bins) return false;
  return o->looks > 1 || (part == r->parts && r->clock.window_samples % (uint64_t)o->every == 0);
}

void gg_replica_look_for_curves(gg_replica *r, int part, double part_elapsed)
{
  bool any = false, last = part == r->parts;
  for (int k = 0; k < r->n_observables; k++) any |= is_due(r, k, part);
  if (any) {
    gg_snapshot_take(&r->snapshot, r->engine);
    r->snapshot.elapsed = part_elapsed;
    r->snapshot.velocity_factor = part == 1 ? r->clock.velocity_factor : 1;
  }
  for (int k = 0; k < r->n_observables; k++) {
    if (!is_due(r, k, part)) continue;
    r->observable[k]->look(r->self[k], &r->snapshot, gg_bins_sample(&r->bins[k]));
    if (last) gg_bins_commit(&r->bins[k]);
  }
  if (last) r->clock.window_samples++;
}

gg_status gg_replica_watch(gg_replica *r, gg_error *err)
{
  for (int k = 0; k < r->n_observables; k++)
    if (r->observable[k]->watch) GG_TRY(r->engine->ops->watch(r->engine, r->observable[k]->watch, r->self[k], err));
  return GG_OK;
}

void gg_replica_restart_curves(gg_replica *r)
{
  r->clock.averaging = 1;
  r->clock.window_samples = 0;
  for (int k = 0; k < r->n_observables; k++) {
    gg_bins_restart(&r->bins[k]);
    if (r->observable[k]->restart) r->observable[k]->restart(r->self[k]);
  }
}
