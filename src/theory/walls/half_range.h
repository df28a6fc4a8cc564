/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts with a wall that has Coulomb friction: means over half a Maxwellian that arrives. */
#ifndef GG_HALF_RANGE_H
#define GG_HALF_RANGE_H

#include "common/collision.h"

typedef struct gg_half_range {
  double impulse; /* mean impulse along the drift, over mass and drift */
  double loss;    /* mean energy lost, over mass; in the frame of the wall */
} gg_half_range;

/* Contact of a grain with the wall, variance of the normal velocity and of each tangential one, drift along the wall.
 */
gg_half_range gg_theory_half_range(const gg_contact *contact, double normal, double tangential, double drift);

#endif
