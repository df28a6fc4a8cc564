/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Temperatures in time of a homogeneous gas of one species without shear, cooling, heated or in a bath. */
#ifndef GG_THEORY_RELAXATION_H
#define GG_THEORY_RELAXATION_H

#include "common/model.h"

typedef struct gg_relaxing {
  double T, theta, a2; /* theta of rough grains, a2 of smooth ones; else 0 */
} gg_relaxing;

/* "first Sonine", "two Maxwellians"; NULL: not of this model. */
const char *gg_theory_relaxation_name(const gg_model *model);
/* The state after a time. */
void gg_theory_relax(const gg_model *model, double time, gg_relaxing *state);

#endif
