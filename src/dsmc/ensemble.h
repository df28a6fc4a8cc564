/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ensemble: the velocities (and spins) that stand for the distribution function, in blocks of eight grains
 * (block.h).
 *
 * Grains of a sheared gas stream as dC_x/dt = -rate C_y. That motion is the same linear map for all grains, so it is
 * not carried out grain by grain: what is stored is x = C_x + strain C_y, constant while streaming, with strain = rate
 * x (time since the map was last applied). The kernels undo it for the two grains that collide;
 * gg_dsmc_ensemble_synchronise applies it to all. */
#ifndef GG_DSMC_ENSEMBLE_H
#define GG_DSMC_ENSEMBLE_H

#include "base/archive.h"
#include "common/model.h"
#include "common/rng.h"
#include "dsmc/block.h"

typedef struct gg_dsmc_ensemble {
  int n_species;
  gg_dsmc_population of[GG_MAX_SPECIES];
  double bound_scale, bound_strain, bound_width; /* it holds at strains from bound_strain on, over bound_width */
  int segments;                /* that each species is divided into (parallel/schedule.h): by size alone, 1 if small */
  int grouping;                /* paired last, and maybe in caches: the quarter that went with the first */
  struct gg_thread_pool *pool; /* threads that share them; NULL: one thread does all */
  const struct gg_dsmc_kernels *kernels; /* for the instructions of this processor */
} gg_dsmc_ensemble;

typedef struct gg_dsmc_moments {
  double temperature; /* sum m C^2/(3N): a velocity squared for one species of mass 1 */
  double fastest;     /* largest |C| */
  gg_vec centre;      /* velocity of the centre of mass */
} gg_dsmc_moments;

gg_status gg_dsmc_ensemble_new(const gg_model *model, gg_dsmc_ensemble *e, gg_error *err);
void gg_dsmc_ensemble_free(gg_dsmc_ensemble *e);

/* Does model->stop end a start at grain i? Also between walls. It is read every few milliseconds. */
static inline bool gg_dsmc_start_is_stopped(const gg_model *model, size_t i)
{
  enum { BETWEEN_LOOKS = 1 << 15 };
  return i % BETWEEN_LOOKS == BETWEEN_LOOKS - 1 && gg_stop_asked(model->stop);
}

/* ensemble_start.c: Maxwellians at the model's temperature0 and ratio0; the mean spin of a sheared dense gas is
 * -rate/2. False: model->stop ended it. */
bool gg_dsmc_ensemble_start(const gg_model *model, gg_dsmc_ensemble *e, gg_rng *rng);

/* C_x -= strain C_y for every grain, all times `scale`, less the velocity `centre`: rounding feeds the motion of the
 * centre of mass, and cooling or a thermostat would let it grow relative to the thermal speed without bound. Returns
 * what is there then. `bound_scale` (a velocity squared of the order of the temperature) becomes that of the speed
 * bounds. */
gg_dsmc_moments gg_dsmc_ensemble_synchronise(gg_dsmc_ensemble *e, double strain, double scale, gg_vec centre,
                                             double bound_scale);
/* Let the speed bounds hold at other strains: from `strain` to `strain + width`. */
void gg_dsmc_ensemble_strain_bounds(gg_dsmc_ensemble *e, double strain, double width);
/* Every velocity times a factor. */
void gg_dsmc_ensemble_heat(gg_dsmc_ensemble *e, double factor);
/* Every velocity and spin times a factor. */
void gg_dsmc_ensemble_scale(gg_dsmc_ensemble *e, double factor);
/* ensemble_store.c: in a checkpoint; what is read may be anybody's. */
gg_status gg_dsmc_ensemble_save(const gg_dsmc_ensemble *e, gg_archive *archive, gg_error *err);
gg_status gg_dsmc_ensemble_restore(gg_dsmc_ensemble *e, const gg_archive *archive, gg_error *err);

#endif
