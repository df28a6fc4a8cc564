/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals over an interval of free cooling from T0 to T1, T^(-1/2) taken as linear in time (Haff's law). */
#ifndef GG_COOLING_INTERVAL_H
#define GG_COOLING_INTERVAL_H

#include <math.h>

typedef struct gg_cooling_interval {
  double root, first, growth; /* int sqrt(T) dt, int T dt, d T^(-1/2)/dt */
} gg_cooling_interval;

static inline gg_cooling_interval gg_cooling_interval_of(double T0, double T1, double dt)
{
  const double a0 = 1 / sqrt(T0), a1 = 1 / sqrt(T1), b = (a1 - a0) / dt;
  if (fabs(a1 - a0) < 1e-9 * a0) return (gg_cooling_interval){dt * sqrt(T0), dt * T0, b};
  return (gg_cooling_interval){log(a1 / a0) / b, (1 / a0 - 1 / a1) / b, b};
}

#endif
