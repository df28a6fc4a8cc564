/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For how many collisions per grain a gas remembers its start. */
#ifndef GG_COMMON_RELAXATION_TIMES_H
#define GG_COMMON_RELAXATION_TIMES_H

#include "common/model.h"

/* Collisions per grain that the slowest of T, theta, mean spin needs to relax by a factor 1/e, estimated from two-
 * Maxwellian kinetics (Huthmann & Zippelius 1997): 3/(4A), 3/(4C); and, where T is scaled or conserved and so does not
 * relax, the temperatures of the species. At least 1. */
double gg_common_model_relaxation(const gg_model *model);
/* The same of a gas that cools: the larger of 3/(4A) and 3/(4C), be T scaled or not. */
double gg_common_model_cooling(const gg_model *model);
/* The same of the temperatures of elastic species, if nothing else went on; 0 of one species. */
double gg_common_model_sharing(const gg_model *model);

/* Collisions per grain that momentum needs to diffuse across the gap between walls, the slowest wave of it by a factor
 * 1/e: (H/pi)^2/nu, nu the kinematic viscosity of elastic Enskog theory (Chapman & Cowling 1970, 16.41). A dense core
 * takes up to some times as long to form. 0 without walls. */
double gg_common_model_gap_relaxation(const gg_model *model);

#endif
