/* What keeps a heated gas warm.
 *
 * Gaussian (the force m zeta C/2 on centres): exactly a gas that cools freely, seen through a growing scale of velocity
 * and a slowing clock. So the gas inside runs untouched, and only the outside's scale follows the energy (resolve.h);
 * at every epoch's end it is folded into the velocities. No torque goes with the force: spins are kept as they are
 * outside. White noise: every grain gets an independent kick of variance xi^2 dt along each axis, the sum of kicks
 * zero, at intervals dt that are short against the mean free time. */
#ifndef GG_MD_THERMOSTAT_H
#define GG_MD_THERMOSTAT_H

#include "md/md_state.h"

/* At a start: what the thermostat keeps, and its first kick. */
void gg_md_thermostat_begin(gg_md *e);
/* At an epoch's end, all grains at time 0: fold the scale into velocities and times. */
void gg_md_thermostat_fold(gg_md *e);
/* Kick every grain at the present time, and set the next kick. */
void gg_md_thermostat_kick(gg_md *e);

#endif
