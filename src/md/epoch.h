/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The end of an epoch, and what follows the state of the gas from epoch to epoch. */
#ifndef GG_MD_EPOCH_H
#define GG_MD_EPOCH_H

#include "md/md_state.h"

/* epoch.c: start the next epoch: bring every grain to the end of the epoch, re-zero all times and tune the event queue.
 * False: no event will ever come. */
bool gg_md_next_epoch(gg_md *e);
/* Surface velocity that the torque of a species has added since the start of the epoch: spins are stored without it. */
GG_INLINE double gg_md_turned(const gg_md *e, int species)
{
  return e->model.torque[species] * e->k.now;
}
/* Spin of a grain at the present time. */
GG_INLINE gg_vec gg_md_spin(const gg_md *e, uint32_t i)
{
  gg_vec s = e->spin[i];
  if (e->model.turns) s.z += gg_md_turned(e, gg_md_species_of(&e->grain[i]));
  return s;
}
/* Add it to the stored spins, when times are re-zeroed after this span. */
void gg_md_turn_spins(gg_md *e, double span);

/* contact_time.c: temperature about the mean velocity, relative to the imposed shear; all grains at the same time. */
double gg_md_temperature(const gg_md *e);
/* Temperature by which rates at a start are estimated: at least that to which shear or a bath soon heats the gas. */
double gg_md_early_temperature(const gg_md *e, double T);
/* Set the contact time of a start at temperature T. */
void gg_md_begin_contact_time(gg_md *e, double T);
/* Set the contact time at the start of an epoch; all grains at the same time. */
void gg_md_follow_contact_time(gg_md *e);

#endif
