/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Momentum, spin and energies that a flat wall takes from arriving rough grains, per area and time. As
 * wall_condition.h, with spins whose mean is s, whose variance is theta/K about it, and nearly half of whose couple
 * stress and heat flux arrive. With S the velocity of a grain's surface at the contact by its spin, s_z side along x, a
 * wall of e_w, beta_w gives the impulse alpha g to it, alpha = (1+beta_w) K/(1+K), where g = v - S:
 *   translation loses (1-e_w^2) v_n^2/2 + alpha v.g - alpha^2 g^2/2,   rotation -alpha S.g - alpha^2 g^2/2K,
 * and the grain takes half a diameter times the impulse as spin. A thermal wall takes all, and gives spins of its
 * temperature without mean. */
#ifndef GG_ROUGH_WALL_H
#define GG_ROUGH_WALL_H

#include "theory/walls/rough_fluid.h"
#include "theory/walls/wall_condition.h"

typedef struct gg_rough_arrival {
  gg_arrival centres;
  double K, theta, omega;
  double couple, heat; /* flux into the wall of the angular momentum I omega and of rotational heat */
} gg_rough_arrival;

typedef struct gg_rough_takes {
  double momentum, couple;      /* along x; about z */
  double translation, rotation; /* energy in the frame of the wall; with mean motion */
} gg_rough_takes;

gg_rough_takes gg_theory_rough_wall_takes(const gg_surface *wall, const gg_rough_arrival *arrival);

#endif
