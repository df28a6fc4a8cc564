/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoint of the engine: everything that a run needs to continue bit for bit. */
#include <math.h>
#include <stdlib.h>

#include "dsmc/dsmc.h"

static const char schedule_item[] = "dsmc/schedule";
#define DAMAGED "the checkpoint of dsmc is damaged: %s"

gg_status gg_dsmc_save(const gg_engine *engine, gg_archive *archive, gg_error *err)
{
  const gg_dsmc *d = (const gg_dsmc *)engine;
  GG_TRY(gg_base_archive_put(archive, "dsmc/state", GG_ITEM_U8, &d->now, sizeof d->now, err));
  GG_TRY(gg_dsmc_ensemble_save(&d->ensemble, archive, err));
  if (d->schedule)
    GG_TRY(gg_base_archive_put(archive, schedule_item, GG_ITEM_U8, d->schedule,
                               gg_dsmc_schedule_size(d->model.n_species), err));
  return gg_dsmc_save_callback(d, archive, err);
}

/* Validate the restored temperature and largest speed, from which numbers of candidates are computed: they are those of
 * the ensemble, but for streaming and collisions since the last synchronisation. */
static bool is_of_ensemble(const gg_dsmc *d)
{
  double energy = 0, fastest2 = 0, n = 0;
  for (int i = 0; i < d->model.n_species; i++) {
    const gg_dsmc_population *p = &d->ensemble.of[i];
    for (uint32_t k = 0; k < (uint32_t)p->n; k++) {
      gg_vec c = gg_dsmc_block_get(p, p->c, k);
      c.x -= d->now.strain * c.y;
      const double c2 = gg_dot(c, c);
      energy += p->mass * c2;
      fastest2 = fmax(fastest2, c2);
    }
    n += (double)p->n;
  }
  return gg_dsmc_is_between(d->now.temperature / (energy / (3 * n)), 1e-8, 1e8) &&
         gg_dsmc_is_between(d->now.fastest / sqrt(fastest2), 1e-4, 1e4);
}

static bool is_step(const gg_dsmc *d, const gg_dsmc_time_step *s)
{
  const double most = 10 * gg_dsmc_time_step_choose(&d->model, d->now.temperature).length;
  return gg_dsmc_is_between(s->length, 1e-12 * most, most) && gg_dsmc_is_between(s->splitting, 1e-18 * most, most) &&
         s->synchronise > 0 && !isnan(s->bias);
}

/* Lowest temperature of the run: majorants are relative to the thermal speed at which they were learned, and a gas that
 * warms learned them at the start. */
static double coldest(const gg_dsmc *d)
{
  return fmin(d->now.temperature, ldexp(d->model.temperature0, 2 * (int)d->now.power));
}

/* Validate a majorant. `most`: a hundred times the relative speed of two of the fastest grains, over the thermal speed.
 */
static bool is_majorant(const gg_dsmc_majorant *m, double remainder, double most)
{
  return gg_dsmc_is_between(m->now, 0, most) && gg_dsmc_is_between(m->before, 0, most) &&
         gg_dsmc_is_between(remainder, 0, 1);
}

/* Validate the restored state: a step can be computed with these numbers. The bounds are far beyond any run's, and keep
 * numbers of candidates representable. */
static bool is_state(const gg_dsmc *d)
{
  const gg_dsmc_state *s = &d->now;
  const double plain[] = {s->time,     s->unsynchronised, s->centre.x,     s->centre.y,
                          s->centre.z, s->lost,           s->advance.gone, s->kept};
  bool good = gg_dsmc_is_between(s->temperature, 1e-200, 1e200) && gg_dsmc_is_between(s->fastest, 0, 1e200) &&
              fabs(s->strain) <= 1e3 && gg_dsmc_is_between(s->power, -1e9, 1e9) && is_step(d, &s->step) &&
              s->advance.asked >= 0; /* infinity is valid */
  for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) good = good && isfinite(plain[i]);
  for (int p = 0; p < gg_pairs_of(d->model.n_species); p++) {
    const double relative = 2 * s->fastest + fabs(d->model.sigma[p] * d->model.shear_rate);
    good = good && is_majorant(&s->majorant[p], s->remainder[p], 100 * relative / sqrt(coldest(d)));
  }
  return good;
}

/* Validate the schedule: its rounds are numbers below the number of segments. */
static bool is_schedule(const gg_dsmc *d)
{
  const gg_dsmc_schedule *s = d->schedule;
  bool good = !s || s->next <= (uint64_t)d->ensemble.segments;
  for (int k = 0; good && s && k < d->ensemble.segments; k++) good = s->order[k] < d->ensemble.segments;
  return good;
}

gg_status gg_dsmc_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  GG_TRY(gg_dsmc_accepts(model, err));
  gg_dsmc *d;
  GG_TRY(gg_dsmc_allocate(model, &d, err));
  gg_status status = gg_base_archive_get(archive, "dsmc/state", GG_ITEM_U8, &d->now, sizeof d->now, err);
  if (status == GG_OK && !is_state(d)) status = gg_base_fail(err, GG_BAD_FILE, DAMAGED, "its state");
  if (status == GG_OK) status = gg_dsmc_ensemble_restore(&d->ensemble, archive, err);
  if (status == GG_OK && d->schedule)
    status = gg_base_archive_get(archive, schedule_item, GG_ITEM_U8, d->schedule,
                                 gg_dsmc_schedule_size(d->model.n_species), err);
  if (status == GG_OK && !is_of_ensemble(d)) status = gg_base_fail(err, GG_BAD_FILE, DAMAGED, "its temperature");
  if (status == GG_OK && !is_schedule(d)) status = gg_base_fail(err, GG_BAD_FILE, DAMAGED, "its schedule");
  if (status == GG_OK) status = gg_dsmc_restore_callback(d, archive, err);
  if (status != GG_OK) {
    gg_dsmc_destroy(&d->base);
    return status;
  }
  *engine = &d->base;
  return GG_OK;
}
