/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What keeps a heated gas warm.
 *
 * Gaussian (the force m zeta C/2 on centres): exactly a gas that cools freely, seen through a growing scale of velocity
 * and a slowing clock. So the gas inside runs untouched, and only the outside's scale follows the energy (resolve.h);
 * at every epoch's end it is folded into the velocities. No torque goes with the force: spins are kept as they are
 * outside. White noise, baths and a given rate of heating: kicks (kicks.h). */
#ifndef GG_MD_THERMOSTAT_H
#define GG_MD_THERMOSTAT_H

#include "md/md_state.h"

/* At a start: what the thermostat keeps. */
void gg_md_thermostat_begin(gg_md *e);
/* At an epoch's end, all grains at time 0: fold the scale into velocities and times. */
void gg_md_thermostat_fold(gg_md *e);

/* Remove the velocity of the centre of mass, relative to the imposed shear; all grains at the same time. Returns the
 * temperature. */
double gg_md_follow_centre_of_mass(gg_md *e);
/* Is that velocity larger than rounding? */
bool gg_md_has_drift(const gg_md *e);

/* Outside time since the present advance began. */
double gg_md_outer_time(const gg_md *e);
/* Present outside time since the engine was created. */
double gg_md_time(const gg_md *e);

#endif
