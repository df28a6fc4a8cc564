/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Oscillatory shear: stress over strain and temperature in a period, and their harmonics. */
#ifndef GG_HARMONICS_H
#define GG_HARMONICS_H

#include "measure/curve.h"

/* Means over periods at the end of each step of a period; of `collisional` over the step. */
typedef struct gg_cycle {
  double *kinetic, *collisional, *T; /* parts of P_xy */
} gg_cycle;

typedef struct gg_oscillation {
  const gg_model *model;
  const char *theory;     /* NULL: none */
  size_t steps, periods;  /* in a period; over which means are taken */
  double period, *strain; /* strain at the end of each step, about its mean */
  size_t n;               /* replicas */
  gg_cycle *of;           /* of each replica, then of the theory, which has all its stress in `kinetic` */
} gg_oscillation;

/* Add two curves, whose numbers are moduli, amplitudes and phases. */
gg_status gg_measure_harmonics(const gg_oscillation *o, gg_curves *list, gg_error *err);

#endif
