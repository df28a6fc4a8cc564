/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Temperatures in time of a homogeneous gas: cooling, heated, in a bath, sheared; mixtures. */
#ifndef GG_THEORY_RELAXATION_H
#define GG_THEORY_RELAXATION_H

#include "theory/gaussian_moments.h"

typedef struct gg_relaxing {
  double T, theta, a2;            /* theta of rough grains, a2 of smooth ones; else 0 */
  gg_gaussian of[GG_MAX_SPECIES]; /* moments of sheared gases and mixtures */
  double P_xy;                    /* of sheared gases */
  double collisions;              /* of a grain, so far */
  double work;                    /* seconds of processor time left, about; without any, all is NaN */
  double stride;                  /* of moments, over the fastest rate; 0: 0.5. A coarse way is stable up to 2 */
  const gg_stop *stop;            /* ends a way on its way, in vain; NULL: nothing does */
} gg_relaxing;

/* "first Sonine", "two Maxwellians", "Maxwellians" of mixtures, "Gaussian closure"; NULL: not of this model. */
const char *gg_theory_relaxation_name(const gg_model *model);
/* That of the start, from the temperatures of the model. */
gg_relaxing gg_theory_relaxation_start(const gg_model *model);
/* What theory has nothing for. */
gg_relaxing gg_theory_relaxation_lost(void);
/* The state after a time; lost where that takes more than the work that is left. */
void gg_theory_relax(const gg_model *model, double time, gg_relaxing *state);
/* gaussian_relaxation.c: moments alone. */
void gg_theory_gaussian_relax(const gg_model *model, double time, gg_relaxing *state);

#endif
