/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The thermostats there are, a row each, and how one acts on the grains of a model, for both engines and the theories.
 * A new thermostat that acts in one of the ways below is a name in flow.h, its row in thermostat.c, a bit in the rows
 * of the flows that take it (flow.c), its keys (scene/fields.c), and what these set (scene/model_of_scene.c). */
#ifndef GG_THERMOSTAT_H
#define GG_THERMOSTAT_H

#include "common/model.h"

/* How a thermostat acts on grains. */
typedef enum gg_heat {
  GG_UNHEATED,
  GG_HEAT_SCALES, /* multiplies velocities so that their energy is constant; spins are left alone */
  GG_HEAT_KICKS,  /* white noise, equal for all species, that balances the losses at temperature0 */
  GG_HEAT_BATHES  /* drag and noise of gg_model.bath, by species */
} gg_heat;

typedef struct gg_thermostat_row {
  const char *word;  /* in scenes */
  const char *doc;   /* behind the word, on the scene page */
  const char *title; /* behind the title of a flow that goes without a thermostat, too */
  gg_heat heat;      /* without a given rate or strength, with which any thermostat is a bath */
} gg_thermostat_row;

extern const gg_thermostat_row gg_common_thermostats[GG_N_THERMOSTATS];

/* How the thermostat in force acts on the grains of this model. */
gg_heat gg_common_heat_of(const gg_model *model);

/* True if the thermostat, of a given strength or not, is white noise in kicks. */
static inline bool gg_common_is_kicked(const gg_model *model)
{
  return gg_common_thermostats[model->thermostat].heat == GG_HEAT_KICKS;
}

/* True if the thermostat multiplies velocities so that their energy is constant. */
static inline bool gg_common_keeps_energy(const gg_model *model)
{
  return gg_common_heat_of(model) == GG_HEAT_SCALES;
}

/* The temperature at which a bath, shear that alone would keep `sheared` (0: none) and the collisions of Maxwellians at
 * ratio0 are in balance: the loss goes as T^(3/2), the work of shear as T^(1/2). Kicks at contact and torques add their
 * power. */
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
/* The same where GG_HEAT_KICKS acts, else 0. */
double gg_common_thermostat_kicks(const gg_model *model);

#endif
