/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear response to uniform shear: the viscosity of cooling and heated gases, which have no steady shear flow of their
 * own (Montanero's review, section 3: under a thermostat that compensates the cooling, viscous heating makes the
 * reduced shear rate a* = rate/nu_0 fall for ever, and eta* is the long-time limit of -nu_0 P_xy/(n T rate)).
 *
 * A heated gas (Gaussian thermostat, or elastic grains) starts at a* = high and heats itself down to `low`; one that
 * cools starts hot, below `low`, forgets that start, and is counted from `low` to `high`. Then the velocities are
 * multiplied by 2^power and the next sweep of a* begins, so that averaging can continue for as long as the requested
 * error needs; eta* is extrapolated to a* = 0 (src/measure/green_kubo_viscosity.c). */
#ifndef GG_LINEAR_RESPONSE_H
#define GG_LINEAR_RESPONSE_H

#include "common/model.h"

typedef struct gg_linear_response {
  double start, low, high; /* of a*: where a run starts; what is averaged over */
  int power;               /* at the end of a sweep velocities are multiplied by 2^power */
  bool cools;              /* no thermostat: a* grows; else it falls */
} gg_linear_response;

gg_linear_response gg_common_linear_response_of(const gg_model *model);

/* a* = rate/nu_0(T). */
double gg_common_reduced_shear_rate(const gg_model *model, double T);

/* Collisions per grain of one sweep of the reduced shear rate: cooling by 2^(2 power), or viscous heating by as much,
 * in which 1/a*^2 grows by (2/3) eta* a time 1/nu_0, five quarters of a collision; eta* taken as 1. */
double gg_common_linear_response_length(const gg_model *model);

/* True if a sweep is at its end at this temperature. */
bool gg_common_linear_response_ends(const gg_model *model, double T);

#endif
