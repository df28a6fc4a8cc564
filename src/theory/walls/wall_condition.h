/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Momentum and energy that a flat wall takes from arriving smooth grains, per area and time: the engines' rule
 * (common/surface/collide.h), averaged over half a distribution. Grains arrive with Grad's distribution; nearly half of
 * its shear stress and of its heat flux are theirs (J.C. Maxwell, Phil. Trans. 170 (1879) 231). */
#ifndef GG_WALL_CONDITION_H
#define GG_WALL_CONDITION_H

#include "common/surface/surface.h"
#include "theory/walls/gap.h"

/* The gas at a wall, seen from it: s tau and s q flow into it (s = 1 at the upper wall, -1 at the lower one). */
typedef struct gg_arrival {
  const gg_gap_local *gas;
  double P, T;
  double slip;        /* velocity of the gas minus that of the wall */
  double shear, heat; /* s tau, s q */
  double along;       /* carried heat flux along x */
} gg_arrival;

typedef struct gg_wall_takes {
  double momentum, energy;     /* along x; energy of the gas continued to the wall, in the frame of the wall */
  double grains, warmth, loss; /* of layers at the wall, per area, beyond the gas continued to it: number, sum of
                                  temperatures, energy lost by collisions */
} gg_wall_takes;

gg_wall_takes gg_theory_wall_takes(const gg_surface *wall, const gg_arrival *arrival);

/* Grains per area that layers at a flat wall hold beyond the gas continued to it: D. Henderson & M. Plischke, Proc. R.
 * Soc. A 410 (1987) 409. */
double gg_theory_wall_layer(double phi);

/* Share of the shear stress or of the heat flux that arriving grains carry: half is Maxwell's. `less` gives a diffuse
 * wall, in a dilute gas, the slip 1.2540 or the jump 2.4001 sqrt(pi)/2 mean free paths of Boltzmann's equation. */
double gg_theory_wall_share(const gg_surface *wall, double phi, double less);

/* Can this wall, or one of both walls, take momentum along x? Else the velocity of the gas is set to 0 at the upper
 * one. */
bool gg_theory_wall_grips(const gg_surface *wall);
bool gg_theory_walls_grip(const gg_model *model);

#endif
