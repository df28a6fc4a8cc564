/* Storage of the engine: everything that a run needs to go on bit for bit. */
#include "dsmc/dsmc.h"

static const char schedule_item[] = "dsmc/schedule";

gg_status gg_dsmc_save(const gg_engine *engine, gg_archive *archive, gg_error *err)
{
  const gg_dsmc *d = (const gg_dsmc *)engine;
  GG_TRY(gg_archive_put(archive, "dsmc/state", GG_ITEM_U8, &d->now, sizeof d->now, err));
  GG_TRY(gg_dsmc_ensemble_save(&d->ensemble, archive, err));
  if (d->schedule)
    GG_TRY(gg_archive_put(archive, schedule_item, GG_ITEM_U8, d->schedule, gg_dsmc_schedule_size(d->model.n_species),
                          err));
  return gg_dsmc_save_callback(d, archive, err);
}

gg_status gg_dsmc_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  GG_TRY(gg_dsmc_accepts(model, err));
  gg_dsmc *d;
  GG_TRY(gg_dsmc_allocate(model, &d, err));
  gg_status status = gg_archive_get(archive, "dsmc/state", GG_ITEM_U8, &d->now, sizeof d->now, err);
  if (status == GG_OK) status = gg_dsmc_ensemble_restore(&d->ensemble, archive, err);
  if (status == GG_OK && d->schedule)
    status =
        gg_archive_get(archive, schedule_item, GG_ITEM_U8, d->schedule, gg_dsmc_schedule_size(d->model.n_species), err);
  if (status == GG_OK) status = gg_dsmc_restore_callback(d, archive, err);
  if (status != GG_OK) {
    gg_dsmc_destroy(&d->base);
    return status;
  }
  *engine = &d->base;
  return GG_OK;
}
