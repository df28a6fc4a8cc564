/* The replicas in an archive: everything needed to go on bit for bit. */
#include <stdio.h>
#include <string.h>

#include "run/clock.h"
#include "run/fingerprint.h"
#include "run/replicas.h"

static const char extension_item[] = "campaign/extension";
enum { SIGNATURE = 2048 };

/* Callbacks cannot be kept: what a run was extended by has to be registered again before it goes on. */
static gg_status same_extension(const gg_replicas *all, const gg_archive *a, gg_error *err)
{
  char here[SIGNATURE], there[SIGNATURE];
  gg_extension_signature(all->scene.extension, here, sizeof here);
  GG_TRY(gg_archive_get(a, extension_item, GG_ITEM_U8, there, sizeof there, err));
  there[SIGNATURE - 1] = 0;
  if (strcmp(here, there) == 0) return GG_OK;
  return gg_fail(err, GG_BAD_INPUT,
                 "the run was extended by a program (%s), and this scene has %s: register the same law and observables "
                 "with the scene before it is resumed",
                 *there ? there : "nothing of its own", *here ? here : "nothing of its own");
}

gg_status gg_replicas_save(const gg_replicas *all, gg_archive *a, gg_error *err)
{
  struct gg_replicas_state state = all->state;
  state.wall += gg_wall_now() - all->started;
  GG_TRY(gg_fingerprint_put(&all->scene, a, err));
  char signature[SIGNATURE] = "";
  gg_extension_signature(all->scene.extension, signature, sizeof signature);
  GG_TRY(gg_archive_put(a, extension_item, GG_ITEM_U8, signature, sizeof signature, err));
  GG_TRY(gg_archive_put(a, "campaign/state", GG_ITEM_U8, &state, sizeof state, err));
  for (int i = 0; i < all->n; i++) {
    gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    gg_status status = gg_replica_save(&all->replica[i], &one, err);
    if (status == GG_OK) status = gg_archive_nest(a, prefix, &one, err);
    gg_archive_clear(&one);
    if (status != GG_OK) return status;
  }
  return GG_OK;
}

gg_status gg_replicas_restore(gg_replicas *all, const gg_archive *a, gg_error *err)
{
  GG_TRY(same_extension(all, a, err));
  GG_TRY(gg_fingerprint_check(&all->scene, a, err));
  GG_TRY(gg_archive_get(a, "campaign/state", GG_ITEM_U8, &all->state, sizeof all->state, err));
  for (int i = 0; i < all->n; i++) {
    gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    gg_status status = gg_archive_unnest(&one, prefix, a, err);
    if (status == GG_OK) status = gg_replica_restore(&all->replica[i], &one, &all->scene, &all->model, i, err);
    gg_archive_clear(&one);
    if (status != GG_OK) return status;
  }
  return GG_OK;
}
