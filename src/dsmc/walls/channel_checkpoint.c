/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoint of a channel: everything that a run needs to continue bit for bit. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "dsmc/walls/channel.h"

#define DAMAGED "the checkpoint of dsmc is damaged: %s"

/* Direction of a transfer: into an archive, or out of one. */
typedef struct direction {
  gg_archive *to;
  const gg_archive *from;
} direction;

static gg_status transfer(direction w, const char *name, gg_item_type type, void *data, size_t count, gg_error *err)
{
  return w.to ? gg_base_archive_put(w.to, name, type, data, count, err)
              : gg_base_archive_get(w.from, name, type, data, count, err);
}

/* Transfer all items. */
static gg_status transfer_all(gg_dsmc_channel *d, direction w, gg_error *err)
{
  const gg_dsmc_channel_grains *g = &d->grains;
  const gg_dsmc_channel_cells *c = &d->cells;
  const size_t n = (size_t)d->model.n, species = (size_t)d->model.n_species, cells = (size_t)c->n;
  GG_TRY(transfer(w, "dsmc/gap", GG_ITEM_U8, &d->now, sizeof d->now, err));
  if (d->heated && gg_common_keeps_energy(&d->model)) {
    GG_TRY(transfer(w, "dsmc/kept", GG_ITEM_F64, &d->kept, 1, err));
    GG_TRY(transfer(w, "dsmc/loss_rate", GG_ITEM_F64, &d->loss_rate, 1, err));
  }
  GG_TRY(transfer(w, "dsmc/height_velocity", GG_ITEM_F64, g->at, 4 * n, err));
  if (g->s) GG_TRY(transfer(w, "dsmc/spin", GG_ITEM_F64, g->s, 3 * n, err));
  if (g->last) GG_TRY(transfer(w, "dsmc/last", GG_ITEM_F64, g->last, n, err));
  GG_TRY(transfer(w, "dsmc/id", GG_ITEM_U8, g->id, n * sizeof *g->id, err));
  GG_TRY(transfer(w, "dsmc/species", GG_ITEM_U8, g->species, n, err));
  GG_TRY(transfer(w, "dsmc/counted", GG_ITEM_F64, c->counted, cells * species, err));
  GG_TRY(transfer(w, "dsmc/mean", GG_ITEM_F64, c->mean, cells * species, err));
  GG_TRY(transfer(w, "dsmc/hits", GG_ITEM_F64, c->hits, cells, err));
  return transfer(w, "dsmc/majorant", GG_ITEM_U8, c->majorant, cells * species * species * sizeof *c->majorant, err);
}

gg_status gg_dsmc_channel_save(const gg_engine *engine, gg_archive *archive, gg_error *err)
{
  gg_dsmc_channel copy = *(const gg_dsmc_channel *)engine; /* put reads only */
  return transfer_all(&copy, (direction){.to = archive}, err);
}

static bool are_between(const double *x, size_t n, double least, double most)
{
  for (size_t i = 0; x && i < n; i++)
    if (!gg_dsmc_is_between(x[i], least, most)) return false;
  return true;
}

/* Validate the restored state: a step can be computed with these numbers. Temperature and step are those of the last
 * measurement, which may have shortened the step at once, as between walls of very unlike temperatures. No run goes
 * beyond these bounds. */
static bool is_state(const gg_dsmc_channel *d)
{
  const gg_dsmc_channel_state *s = &d->now;
  const double crossing = d->model.box[1] / sqrt(s->temperature);
  return gg_dsmc_is_between(s->temperature, 1e-300, 1e300) && gg_dsmc_is_between(s->step, 1e-300, crossing) &&
         gg_dsmc_is_between(s->pending, 0, 1e5 * crossing) && gg_dsmc_is_between(s->rate, 0, 1e300) &&
         gg_dsmc_is_between(s->all_rate, 0, 1e300) && gg_dsmc_is_between(s->time, -1e300, 1e300) &&
         gg_dsmc_is_between(s->unmeasured, 0, 1e300) && gg_dsmc_is_between(s->overfilled, 0, 1) &&
         gg_dsmc_is_between(s->advance.gone, 0, 1e300) && s->advance.asked >= 0 &&
         (!d->heated || !gg_common_keeps_energy(&d->model) ||
          (gg_dsmc_is_between(d->kept, 1e-300, 1e300) && gg_dsmc_is_between(d->loss_rate, 0, 1e300)));
}

/* Validate the grains: heights between the walls, energy of about the temperature, each grain once. */
static bool are_grains(const gg_dsmc_channel *d)
{
  const gg_dsmc_channel_grains *g = &d->grains;
  const size_t n = (size_t)d->model.n;
  int64_t of[GG_MAX_SPECIES] = {0};
  double energy = 0;
  for (size_t i = 0; i < n; i++) d->place[i] = 0;
  for (size_t i = 0; i < n; i++) {
    if (g->species[i] >= d->model.n_species || g->id[i] >= n || d->place[g->id[i]]++) return false;
    const int s = g->species[i];
    of[s]++;
    if (!gg_dsmc_is_between(g->at[i].y, d->low[s], fmin(d->high[s], 1e300))) return false;
    const gg_vec c = g->at[i].c;
    energy += d->model.mass[s] * gg_dot(c, c);
  }
  for (int s = 0; s < d->model.n_species; s++)
    if (of[s] != d->model.n_of[s]) return false;
  if (g->s && !are_between((const double *)g->s, 3 * n, -1e150, 1e150)) return false;
  for (size_t i = 0; g->last && i < n; i++)
    if (!(g->last[i] <= d->now.time)) return false;
  return gg_dsmc_is_between(energy / (3 * (double)n * d->now.temperature), 1e-12, 1e12);
}

static bool are_cells(const gg_dsmc_channel *d)
{
  const gg_dsmc_channel_cells *c = &d->cells;
  const size_t n = (size_t)c->n, species = (size_t)d->model.n_species;
  const double grains = (double)d->model.n;
  if (!are_between(c->counted, n * species, 0, 1e300) || !are_between(c->mean, n * species, 0, grains * (1 + 1e-9)) ||
      !are_between(c->hits, n, 0, 1e300))
    return false;
  /* Largest chi N g_n (by blocks, g_n) over the thermal speed, if one grain has all energy; with a larger one a step
   * would take hours. */
  const double most = (c->block > 0 ? 10 : 1e4 * grains) * sqrt(grains);
  for (size_t k = 0; k < n * species * species; k++)
    if (!gg_dsmc_is_between(c->majorant[k].now, 0, most) || !gg_dsmc_is_between(c->majorant[k].before, 0, most))
      return false;
  return true;
}

gg_status gg_dsmc_channel_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  gg_dsmc_channel *d;
  GG_TRY(gg_dsmc_channel_accepts(model, err));
  GG_TRY(gg_dsmc_channel_allocate(model, &d, err));
  gg_status status = gg_base_archive_find(archive, "dsmc/last") ? gg_dsmc_channel_allocate_last(d, err) : GG_OK;
  if (status == GG_OK) status = transfer_all(d, (direction){.from = archive}, err);
  if (status == GG_OK && !is_state(d)) status = gg_base_fail(err, GG_BAD_FILE, DAMAGED, "its state");
  if (status == GG_OK && !are_grains(d)) status = gg_base_fail(err, GG_BAD_FILE, DAMAGED, "its grains");
  if (status == GG_OK && !are_cells(d)) status = gg_base_fail(err, GG_BAD_FILE, DAMAGED, "its cells");
  if (status != GG_OK) {
    gg_dsmc_channel_destroy(&d->base);
    return status;
  }
  gg_dsmc_channel_set_chi(d);
  *engine = &d->base;
  return GG_OK;
}
