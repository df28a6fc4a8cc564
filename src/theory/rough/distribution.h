/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distribution of velocities and spins of a solution: marginals along the axes, and how spins are oriented to
 * velocities. Peculiar spins are about the mean of the weight, which is that of the solution before. */
#ifndef GG_ROUGH_DISTRIBUTION_H
#define GG_ROUGH_DISTRIBUTION_H

#include "theory/hermite/component.h"
#include "theory/rough/steady.h"

/* A component of velocity or spin, in units of its spread under the weight. */
gg_hermite_component gg_rough_component_of(const gg_rough_steady *state, bool spin, int axis);

/* <(C.W)^2/(C^2 W^2)>, 1/3 without correlation. */
double gg_rough_orientation(const gg_rough_steady *state);

#endif
