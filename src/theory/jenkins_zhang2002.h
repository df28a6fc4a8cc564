/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effective restitution of frictional grains, for the theories that use it. */
#ifndef GG_JENKINS_ZHANG2002_H
#define GG_JENKINS_ZHANG2002_H

#include "theory/answer.h"

/* Restitution of smooth grains that lose as much translational energy, and theta/T in the steady state. */
typedef struct gg_effective_restitution {
  double e, ratio;
} gg_effective_restitution;
gg_effective_restitution gg_theory_jenkins_zhang(gg_grain grain, double mu);

/* The same for the grains of a scene; e itself, without theta/T, if smooth. */
gg_effective_restitution gg_theory_jenkins_zhang_of(const gg_model *model);

/* Why friction and restitution are outside the range of the effective restitution; NULL within. */
const char *gg_theory_beyond_little_friction(const gg_model *model);

#endif
