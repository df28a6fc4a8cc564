/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collision callback. Collisions then use the plain path, whose grains keep their places in the ensemble, so that the
 * time of the last collision of each is known. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "dsmc/dsmc.h"

static gg_status allocate(gg_dsmc *d, gg_error *err)
{
  for (int i = 0; i < d->model.n_species; i++) {
    d->callback.first[i] = i ? d->callback.first[i - 1] + d->ensemble.of[i - 1].n : 0;
    if (d->callback.last[i]) continue;
    size_t n = (size_t)d->ensemble.of[i].n;
    double *last = d->callback.last[i] = gg_base_array_new(n, sizeof *last, err);
    if (!last) return GG_FAILED;
    for (size_t k = 0; k < n; k++) last[k] = -INFINITY;
  }
  return GG_OK;
}

/* Switch to the plain path. The majorants of the block kernels are valid there, too: they bound an integral over
 * directions that is not less than the largest rate. */
static void use_plain_path(gg_dsmc *d)
{
  for (int p = 0; p < GG_PAIRS; p++) d->path[p] = GG_DSMC_PLAIN;
}

/* Return to the path of the model. Majorants of the plain path are not valid there. */
static void leave_plain_path(gg_dsmc *d)
{
  for (int i = 0; i < d->model.n_species; i++) {
    free(d->callback.last[i]);
    d->callback.last[i] = NULL;
  }
  if (!gg_dsmc_callback_slows(&d->base)) return;
  gg_dsmc_take_paths(d);
  gg_dsmc_synchronise(d);
  gg_dsmc_start_majorants(d);
}

bool gg_dsmc_callback_slows(const gg_engine *engine)
{
  const gg_dsmc *d = (const gg_dsmc *)engine;
  for (int i = 0; i < d->model.n_species; i++)
    for (int j = i; j < d->model.n_species; j++)
      if (gg_dsmc_path_of(d, i, j) != GG_DSMC_PLAIN) return true;
  return false;
}

gg_status gg_dsmc_set_callback(gg_engine *engine, gg_collision_callback *callback, void *context, gg_error *err)
{
  gg_dsmc *d = (gg_dsmc *)engine;
  if (callback) GG_TRY(allocate(d, err));
  d->callback.call = callback;
  d->callback.context = context;
  if (callback) use_plain_path(d);
  if (!callback && d->callback.last[0]) leave_plain_path(d);
  return GG_OK;
}

static const char *name_of(int species, char name[32])
{
  snprintf(name, 32, "dsmc/last_%d", species + 1);
  return name;
}

gg_status gg_dsmc_save_callback(const gg_dsmc *d, gg_archive *a, gg_error *err)
{
  char name[32];
  for (int i = 0; i < d->model.n_species; i++)
    if (d->callback.last[i])
      GG_TRY(
          gg_base_archive_put(a, name_of(i, name), GG_ITEM_F64, d->callback.last[i], (size_t)d->ensemble.of[i].n, err));
  return GG_OK;
}

gg_status gg_dsmc_restore_callback(gg_dsmc *d, const gg_archive *a, gg_error *err)
{
  char name[32];
  if (!gg_base_archive_find(a, name_of(0, name))) return GG_OK;
  GG_TRY(allocate(d, err));
  use_plain_path(d);
  for (int i = 0; i < d->model.n_species; i++)
    GG_TRY(
        gg_base_archive_get(a, name_of(i, name), GG_ITEM_F64, d->callback.last[i], (size_t)d->ensemble.of[i].n, err));
  return GG_OK;
}

void gg_dsmc_rescale_callback(gg_dsmc *d, double factor, double origin)
{
  for (int i = 0; i < d->model.n_species; i++) {
    double *last = d->callback.last[i];
    for (size_t k = 0; last && k < (size_t)d->ensemble.of[i].n; k++) last[k] = origin + (last[k] - origin) / factor;
  }
}
