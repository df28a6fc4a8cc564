/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Thermostat of a model and its strength, so that both engines heat alike. */
#ifndef GG_THERMOSTAT_H
#define GG_THERMOSTAT_H

#include "common/model.h"

/* The thermostat in force: that of the scene, or the flow's default where it needs one. */
gg_thermostat gg_common_thermostat_of(const gg_model *model);

/* The temperature at which a bath, shear that alone would keep `sheared` (0: none) and the collisions of Maxwellians at
 * ratio0 are in balance: the loss goes as T^(3/2), the work of shear as T^(1/2). */
double gg_common_thermostat_balance(const gg_model *model, double sheared);

/* Exact effect of a bath in a time dt: velocities shrink by `decay` and get kicks of variance `spread` x noise. Kicks
 * arrive at a steady rate and decay afterwards; weighted by what is left of them they arrived at the time `mean` on
 * average, with the variance `width`.
 * */
typedef struct gg_relaxation {
  double decay, spread, mean, width;
} gg_relaxation;
gg_relaxation gg_common_relaxation(double drag, double dt);

/* xi^2 at which white noise balances the collisions of Maxwellians at temperature0 and ratio0. */
double gg_common_thermostat_noise(const gg_model *model);

#endif
