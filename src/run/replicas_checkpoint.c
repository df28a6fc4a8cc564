/* The replicas in an archive: everything needed to go on bit for bit. */
#include <stdio.h>

#include "base/clock.h"
#include "run/replicas.h"
#include "scene/fields.h"

gg_status gg_run_replicas_save(const gg_replicas *all, gg_archive *a, gg_error *err)
{
  struct gg_replicas_state state = all->state;
  state.wall += gg_base_clock_wall() - all->started;
  GG_TRY(gg_scene_resumption_put(&all->scene, a, err));
  GG_TRY(gg_base_archive_put(a, "campaign/state", GG_ITEM_U8, &state, sizeof state, err));
  for (int i = 0; i < all->n; i++) {
    gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    gg_status status = gg_run_replica_save(&all->replica[i], &one, err);
    if (status == GG_OK) status = gg_base_archive_nest(a, prefix, &one, err);
    gg_base_archive_clear(&one);
    if (status != GG_OK) return status;
  }
  return GG_OK;
}

static gg_status check_kind(const gg_archive *a, gg_error *err)
{
  if (gg_base_archive_find(a, "md/campaign/state") || gg_base_archive_find(a, "dsmc/campaign/state"))
    return gg_base_fail(err, GG_BAD_INPUT, "the checkpoint is one of a comparison, which alone can go on from it");
  if (gg_base_archive_find(a, "simulation/scene"))
    return gg_base_fail(err, GG_BAD_INPUT, "the checkpoint is a saved simulation, not one of a run");
  return GG_OK;
}

gg_status gg_run_replicas_restore(gg_replicas *all, const gg_archive *a, gg_error *err)
{
  GG_TRY(check_kind(a, err));
  GG_TRY(gg_scene_resumption_check(&all->scene, a, err));
  GG_TRY(gg_base_archive_get(a, "campaign/state", GG_ITEM_U8, &all->state, sizeof all->state, err));
  for (int i = 0; i < all->n; i++) {
    gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    gg_status status = gg_base_archive_unnest(&one, prefix, a, err);
    if (status == GG_OK) status = gg_run_replica_restore(&all->replica[i], &one, &all->scene, &all->model, i, err);
    gg_base_archive_clear(&one);
    if (status != GG_OK) return status;
  }
  return GG_OK;
}

/* Samples that every replica has taken, at most `due`: they are not level where a run was stopped within a stretch. */
static uint64_t least_samples(const gg_archive *a, uint64_t due)
{
  uint64_t least = due;
  for (int i = 0;; i++) {
    char name[48];
    struct gg_replica_clock clock;
    snprintf(name, sizeof name, "replica%d/replica/clock", i);
    if (gg_base_archive_get(a, name, GG_ITEM_U8, &clock, sizeof clock, NULL) != GG_OK) return least;
    if (clock.samples < least) least = clock.samples;
  }
}

gg_status gg_run_how_far(const gg_archive *a, gg_checkpoint_part *part, gg_error *err)
{
  struct gg_replicas_state state;
  GG_TRY(gg_base_archive_get(a, "campaign/state", GG_ITEM_U8, &state, sizeof state, err));
  const uint64_t taken = least_samples(a, state.due);
  double window = state.averaging && taken > state.window_at ? (double)(taken - state.window_at) : 0;
  part->phase = state.averaging ? "averaging" : "warm-up";
  part->collisions_per_grain = (double)taken * GG_SAMPLING_INTERVAL;
  part->averaged = window * GG_SAMPLING_INTERVAL;
  part->seconds = state.wall;
  return GG_OK;
}
