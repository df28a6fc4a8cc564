/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moments of the velocities of all grains, from an engine or a frame. */
#ifndef GG_MEASURE_MOMENTS_H
#define GG_MEASURE_MOMENTS_H

#include "common/engine.h"

/* Initialise with the model, all sums zero. */
typedef struct gg_moments {
  const gg_model *model;
  double cc[3][3], energy[GG_MAX_SPECIES];               /* sums of m C C and, by species, of m C.C */
  double spin[GG_MAX_SPECIES][3], spin2[GG_MAX_SPECIES]; /* sums of surface velocities s and of s.s */
} gg_moments;

void gg_measure_moments_add(void *moments, const gg_chunk *chunk);
/* Temperatures, in the units of the velocities. */
double gg_measure_moments_temperature(const gg_moments *m);
double gg_measure_moments_rotational_temperature(const gg_moments *m);
/* Sum over the grains of a species of I Omega^2 = K m s^2, with surface velocities s about the mean of the species. */
double gg_measure_moments_rotation(const gg_moments *m, int species);

#endif
