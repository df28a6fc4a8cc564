/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An advance of an engine, homogeneous or between walls: its length, its polls of `stop`, and the range of temperatures
 * that it can compute with. */
#ifndef GG_DSMC_ADVANCE_H
#define GG_DSMC_ADVANCE_H

#include "common/model.h"

/* The present advance, which may have been stopped. Part of the states that are saved as bytes. */
typedef struct gg_dsmc_advance {
  double asked, gone;      /* its length, and the time that has passed */
  uint64_t last_collision; /* number of collisions at which it ends */
} gg_dsmc_advance;

/* Begin an advance by `dt` or `max_collisions`, after `collisions` so far. */
void gg_dsmc_advance_begin(gg_dsmc_advance *a, double dt, uint64_t max_collisions, uint64_t collisions);
bool gg_dsmc_advance_is_over(const gg_dsmc_advance *a, uint64_t collisions);
/* Add the work of a step, in candidates and flights, and poll `stop` every few milliseconds. */
bool gg_dsmc_advance_is_stopped(const gg_model *model, uint64_t *work, uint64_t of_step);
/* GG_FAILED if the temperature T is outside of (least, most). */
gg_status gg_dsmc_check_temperature(const gg_model *model, double T, double least, double most, uint64_t collisions,
                                    gg_error *err);

/* Range check of a number that was read from a checkpoint; false for NaN. */
GG_INLINE bool gg_dsmc_is_between(double x, double least, double most)
{
  return x >= least && x <= most;
}

#endif
