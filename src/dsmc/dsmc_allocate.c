/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of the engine, and the choice of its kernels. */
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "dsmc/dsmc.h"

gg_dsmc_path gg_dsmc_path_of(const gg_dsmc *d, int i, int j)
{
  return d->model.law.e ? GG_DSMC_PLAIN : gg_dsmc_choose_path(&d->ensemble.of[i], &d->ensemble.of[j]);
}

void gg_dsmc_take_paths(gg_dsmc *d)
{
  for (int i = 0; i < d->model.n_species; i++)
    for (int j = i; j < d->model.n_species; j++) d->path[gg_pair(i, j)] = gg_dsmc_path_of(d, i, j);
}

gg_status gg_dsmc_allocate(const gg_model *model, gg_dsmc **d, gg_error *err)
{
  GG_TRY(gg_simd_instructions_check(err));
  gg_dsmc *made = gg_base_array_new(1, sizeof *made, err);
  if (!made) return GG_FAILED;
  made->model = *model;
  made->heat = gg_common_heat_of(model);
  made->noise = gg_common_thermostat_kicks(model);
  gg_status status = gg_dsmc_ensemble_new(model, &made->ensemble, err);
  if (status == GG_OK && made->ensemble.segments > 1) {
    made->schedule = gg_base_array_new(1, gg_dsmc_schedule_size(model->n_species), err);
    made->rounds = gg_dsmc_rounds_room_new(model->n_species, made->ensemble.segments, err);
    if (!made->schedule || !made->rounds) status = GG_FAILED;
  }
  if (status == GG_OK) status = gg_common_coefficient_tables_new(model, &made->tables, err);
  if (status != GG_OK) {
    gg_dsmc_destroy(&made->base);
    return status;
  }
  gg_dsmc_take_paths(made);
  *d = made;
  return GG_OK;
}

void gg_dsmc_destroy(gg_engine *engine)
{
  gg_dsmc *d = (gg_dsmc *)engine;
  if (!d) return;
  gg_dsmc_ensemble_free(&d->ensemble);
  gg_common_coefficient_tables_free(d->tables);
  free(d->schedule);
  gg_dsmc_rounds_room_free(d->rounds);
  for (int i = 0; i < GG_MAX_SPECIES; i++) free(d->callback.last[i]);
  free(d);
}

/* Estimate of the memory: that of the blocks. */
double gg_dsmc_bytes(const gg_model *m)
{
  const double block = m->single ? sizeof(gg_dsmc_block_single) : sizeof(gg_dsmc_block);
  const double vectors = m->rule != GG_SMOOTH ? 2 : 1;
  return (double)m->n / GG_DSMC_LANES * (vectors * block + sizeof(float));
}
