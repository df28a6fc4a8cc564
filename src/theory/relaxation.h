/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Temperatures in time of a homogeneous gas: cooling, heated, in a bath, sheared; mixtures. */
#ifndef GG_THEORY_RELAXATION_H
#define GG_THEORY_RELAXATION_H

#include "theory/gaussian_moments.h"

typedef struct gg_relaxing {
  double T, theta, a2;            /* theta for rough grains, a2 for smooth ones; else 0 */
  gg_gaussian of[GG_MAX_SPECIES]; /* moments of sheared gases and mixtures */
  gg_tensor P;                    /* stress of sheared gases */
  double collisions;              /* per grain, so far */
  double work;                    /* remaining seconds of processor time, about; at 0 all values become NaN */
  double stride;       /* step of the moments, over the fastest rate; 0: 0.5. Coarse steps are stable up to 2 */
  const gg_stop *stop; /* interrupts the integration; NULL: never */
} gg_relaxing;

/* "first Sonine", "two Maxwellians", "Maxwellians" of mixtures, "Gaussian closure"; NULL: not of this model. */
const char *gg_theory_relaxation_name(const gg_model *model);
/* The initial state, from the temperatures of the model. */
gg_relaxing gg_theory_relaxation_start(const gg_model *model);
/* The state without an answer: all values NaN. */
gg_relaxing gg_theory_relaxation_lost(void);
/* Value of a quantity; NaN: this theory has none. */
double gg_theory_relaxation_value(const gg_model *model, const gg_relaxing *state, gg_quantity quantity);
/* Set the stress of a sheared gas, at the present rate of the model. */
void gg_theory_relaxation_stress(const gg_model *model, gg_relaxing *state);
/* The state after a time; NaN if that takes more than the remaining work. */
void gg_theory_relax(const gg_model *model, double time, gg_relaxing *state);
/* gaussian_relaxation.c: moments alone. */
void gg_theory_gaussian_relax(const gg_model *model, double time, gg_relaxing *state);

#endif
