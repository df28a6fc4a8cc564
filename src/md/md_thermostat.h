/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gaussian thermostat, the clock outside of it, and the motion of the centre of mass.
 *
 * The Gaussian thermostat, a force m zeta C/2 on centres, is exactly a freely cooling gas (inside) with velocities
 * scaled by a growing factor and a slowing clock (outside). So the gas inside runs unchanged, and only the scale
 * follows the energy (resolve.h); at the end of every epoch the scale is folded into the velocities. The force has no
 * torque: spins are stored as they are outside. White noise, baths and a given rate of heating are kicks (kicks.h). */
#ifndef GG_MD_THERMOSTAT_H
#define GG_MD_THERMOSTAT_H

#include "md/md_state.h"

/* Set scale and energy at a start. */
void gg_md_thermostat_begin(gg_md *e);
/* Fold the scale into velocities and times at the end of an epoch, all grains at time 0. */
void gg_md_thermostat_fold(gg_md *e);

/* Remove the velocity of the centre of mass, relative to the imposed shear; all grains at the same time. Returns the
 * temperature. */
double gg_md_follow_centre_of_mass(gg_md *e);
/* True if that velocity is larger than rounding. */
bool gg_md_has_drift(const gg_md *e);

/* Outside time since the present advance began. */
double gg_md_outer_time(const gg_md *e);
/* Present outside time since the engine was created. */
double gg_md_time(const gg_md *e);

#endif
