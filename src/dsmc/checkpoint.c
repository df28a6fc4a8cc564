/* Life and storage of the engine: everything that a run needs to go on bit for bit. */
#include <stdlib.h>

#include "common/thermostat.h"
#include "dsmc/dsmc.h"
#include "dsmc/thermostat.h"
#include "simd/dispatch.h"

gg_status gg_dsmc_alloc(const gg_model *model, gg_dsmc **d, gg_error *err)
{
  GG_TRY(gg_instructions_check(err));
  gg_dsmc *made = gg_new_array(1, sizeof *made, err);
  if (!made) return GG_FAILED;
  made->base.ops = &gg_dsmc_ops;
  made->model = *model;
  made->thermostat = gg_thermostat_of(model);
  made->noise = gg_thermostat_noise(model);
  gg_status status = gg_ensemble_new(model, &made->ensemble, err);
  if (status == GG_OK && made->ensemble.segments > 1) {
    made->tournament = gg_new_array(1, sizeof *made->tournament, err);
    if (!made->tournament) status = GG_FAILED;
  }
  if (status != GG_OK) {
    gg_dsmc_destroy(&made->base);
    return status;
  }
  for (int i = 0; i < model->n_species; i++)
    for (int j = i; j < model->n_species; j++)
      made->path[gg_pair_index(i, j)] = gg_path_choose(&made->ensemble.of[i], &made->ensemble.of[j]);
  *d = made;
  return GG_OK;
}

void gg_dsmc_destroy(gg_engine *engine)
{
  gg_dsmc *d = (gg_dsmc *)engine;
  if (!d) return;
  gg_ensemble_free(&d->ensemble);
  free(d->tournament);
  for (int i = 0; i < GG_MAX_SPECIES; i++) free(d->watching.last[i]);
  free(d);
}

static const char tournament_item[] = "dsmc/tournament";

gg_status gg_dsmc_save(const gg_engine *engine, gg_archive *archive, gg_error *err)
{
  const gg_dsmc *d = (const gg_dsmc *)engine;
  GG_TRY(gg_archive_put(archive, "dsmc/state", GG_ITEM_U8, &d->now, sizeof d->now, err));
  GG_TRY(gg_ensemble_save(&d->ensemble, archive, err));
  if (d->tournament)
    GG_TRY(gg_archive_put(archive, tournament_item, GG_ITEM_U8, d->tournament, sizeof *d->tournament, err));
  return gg_dsmc_save_watching(d, archive, err);
}

gg_status gg_dsmc_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  GG_TRY(gg_dsmc_accepts(model, err));
  gg_dsmc *d;
  GG_TRY(gg_dsmc_alloc(model, &d, err));
  gg_status status = gg_archive_get(archive, "dsmc/state", GG_ITEM_U8, &d->now, sizeof d->now, err);
  if (status == GG_OK) status = gg_ensemble_restore(&d->ensemble, archive, err);
  if (status == GG_OK && d->tournament)
    status = gg_archive_get(archive, tournament_item, GG_ITEM_U8, d->tournament, sizeof *d->tournament, err);
  if (status == GG_OK) status = gg_dsmc_restore_watching(d, archive, err);
  if (status != GG_OK) {
    gg_dsmc_destroy(&d->base);
    return status;
  }
  *engine = &d->base;
  return GG_OK;
}
