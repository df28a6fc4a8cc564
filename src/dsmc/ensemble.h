/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ensemble: velocities (and spins) that represent the distribution function, in blocks of eight grains (block.h).
 *
 * Grains of a sheared gas stream as dC_x/dt = -rate C_y, the same linear map for all grains. So it is not applied grain
 * by grain: the stored value is x = C_x + strain C_y, constant while streaming, with strain = rate x (time since the
 * last synchronisation). Kernels convert it for grains that collide; gg_dsmc_ensemble_synchronise applies the map to
 * all grains. */
#ifndef GG_DSMC_ENSEMBLE_H
#define GG_DSMC_ENSEMBLE_H

#include "base/archive.h"
#include "common/model.h"
#include "common/rng.h"
#include "dsmc/block.h"

typedef struct gg_dsmc_ensemble {
  int n_species;
  gg_dsmc_population of[GG_MAX_SPECIES];
  double bound_scale, bound_strain, bound_width; /* bound_scale holds at strains from bound_strain over bound_width */
  int segments;                          /* partition of each species (parallel/schedule.h), by size alone; 1: small */
  int grouping;                          /* quarter that was last paired with the first one: both may be in a cache */
  struct gg_thread_pool *pool;           /* NULL: one thread */
  const struct gg_dsmc_kernels *kernels; /* for the instructions of this processor */
} gg_dsmc_ensemble;

typedef struct gg_dsmc_moments {
  double temperature; /* sum m C^2/(3N): a velocity squared for one species of mass 1 */
  double fastest;     /* largest |C| */
  gg_vec centre;      /* velocity of the centre of mass */
} gg_dsmc_moments;

gg_status gg_dsmc_ensemble_new(const gg_model *model, gg_dsmc_ensemble *e, gg_error *err);
void gg_dsmc_ensemble_free(gg_dsmc_ensemble *e);

/* Poll model->stop in a start, at grain i: every few milliseconds. Also used between walls. */
static inline bool gg_dsmc_start_is_stopped(const gg_model *model, size_t i)
{
  enum { GRAINS_PER_POLL = 1 << 15 };
  return i % GRAINS_PER_POLL == GRAINS_PER_POLL - 1 && gg_stop_asked(model->stop);
}

/* ensemble_start.c: draw Maxwellian velocities and spins at the model's temperature0 and ratio0; the mean spin of a
 * sheared dense gas is -rate/2. False: model->stop ended it. */
bool gg_dsmc_ensemble_start(const gg_model *model, gg_dsmc_ensemble *e, gg_rng *rng);

/* Synchronise: C_x -= strain C_y for every grain, all times `scale`, minus the velocity `centre`. Rounding feeds the
 * motion of the centre of mass, which in a cooling or heated gas would grow relative to the thermal speed without
 * bound. Returns the moments after it. `bound_scale` (a velocity squared of the order of the temperature) becomes the
 * scale of the speed bounds. */
gg_dsmc_moments gg_dsmc_ensemble_synchronise(gg_dsmc_ensemble *e, double strain, double scale, gg_vec centre,
                                             double bound_scale);
/* Extend the speed bounds to strains from `strain` to `strain + width`. */
void gg_dsmc_ensemble_strain_bounds(gg_dsmc_ensemble *e, double strain, double width);
/* Multiply every velocity by a factor. */
void gg_dsmc_ensemble_heat(gg_dsmc_ensemble *e, double factor);
/* Apply the torque of each species, an acceleration of surface velocities, over a time. */
void gg_dsmc_ensemble_turn(gg_dsmc_ensemble *e, const double acceleration[], double dt);
/* Multiply every velocity and spin by a factor. */
void gg_dsmc_ensemble_scale(gg_dsmc_ensemble *e, double factor);
/* ensemble_store.c: save to a checkpoint, and restore from one with validation. */
gg_status gg_dsmc_ensemble_save(const gg_dsmc_ensemble *e, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_ensemble_restore(gg_dsmc_ensemble *e, const gg_archive *archive, gg_error *err);

#endif
