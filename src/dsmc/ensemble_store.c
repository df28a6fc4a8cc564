/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ensemble in a checkpoint. */
#include <math.h>
#include <stdio.h>

#include "dsmc/ensemble.h"

/* Name of a checkpoint item of a species: "dsmc/velocity_1". */
typedef struct item {
  char name[32];
} item;
static item item_of(const char *what, int species)
{
  item i;
  snprintf(i.name, sizeof i.name, "dsmc/%s_%d", what, species + 1);
  return i;
}
static const char bound_scale_item[] = "dsmc/bound_scale";

static gg_status put_blocks(const gg_dsmc_population *p, const char *name, const void *blocks, gg_archive *a,
                            gg_error *err)
{
  return gg_base_archive_put(a, name, p->single ? GG_ITEM_F32 : GG_ITEM_F64, blocks, p->n_blocks * GG_DSMC_COMPONENTS,
                             err);
}

static gg_status get_blocks(const gg_dsmc_population *p, const char *name, void *blocks, const gg_archive *a,
                            gg_error *err)
{
  return gg_base_archive_get(a, name, p->single ? GG_ITEM_F32 : GG_ITEM_F64, blocks, p->n_blocks * GG_DSMC_COMPONENTS,
                             err);
}

gg_status gg_dsmc_ensemble_save(const gg_dsmc_ensemble *e, gg_archive *archive, gg_error *err)
{
  for (int i = 0; i < e->n_species; i++) {
    const gg_dsmc_population *p = &e->of[i];
    GG_TRY(put_blocks(p, item_of("velocity", i).name, p->c, archive, err));
    if (p->s) GG_TRY(put_blocks(p, item_of("spin", i).name, p->s, archive, err));
    GG_TRY(gg_base_archive_put(archive, item_of("speed_bound", i).name, GG_ITEM_U8, p->speed_bound,
                               p->n_blocks * sizeof *p->speed_bound, err));
  }
  double bounds[] = {e->bound_scale, e->bound_strain, e->bound_width};
  return gg_base_archive_put(archive, bound_scale_item, GG_ITEM_F64, bounds, 3, err);
}

static bool are_finite(const gg_dsmc_population *p, const void *blocks)
{
  for (size_t i = 0; i < p->n_blocks * GG_DSMC_COMPONENTS; i++)
    if (!isfinite(p->single ? (double)((const float *)blocks)[i] : ((const double *)blocks)[i])) return false;
  return true;
}

/* Validate the restored ensemble: velocities and speed bounds are finite. */
static bool is_ensemble(const gg_dsmc_ensemble *e)
{
  for (int i = 0; i < e->n_species; i++) {
    const gg_dsmc_population *p = &e->of[i];
    if (!are_finite(p, p->c) || (p->s && !are_finite(p, p->s))) return false;
    for (size_t k = 0; k < p->n_blocks; k++)
      if (!(p->speed_bound[k] >= 0)) return false;
  }
  return e->bound_scale > 0 && isfinite(e->bound_scale) && isfinite(e->bound_strain) && e->bound_width >= 0 &&
         isfinite(e->bound_width);
}

gg_status gg_dsmc_ensemble_restore(gg_dsmc_ensemble *e, const gg_archive *archive, gg_error *err)
{
  for (int i = 0; i < e->n_species; i++) {
    gg_dsmc_population *p = &e->of[i];
    GG_TRY(get_blocks(p, item_of("velocity", i).name, p->c, archive, err));
    if (p->s) GG_TRY(get_blocks(p, item_of("spin", i).name, p->s, archive, err));
    GG_TRY(gg_base_archive_get(archive, item_of("speed_bound", i).name, GG_ITEM_U8, p->speed_bound,
                               p->n_blocks * sizeof *p->speed_bound, err));
  }
  double bounds[3];
  GG_TRY(gg_base_archive_get(archive, bound_scale_item, GG_ITEM_F64, bounds, 3, err));
  e->bound_scale = bounds[0];
  e->bound_strain = bounds[1];
  e->bound_width = bounds[2];
  return is_ensemble(e) ? GG_OK : gg_base_fail(err, GG_BAD_FILE, "the checkpoint of dsmc is damaged: its velocities");
}
