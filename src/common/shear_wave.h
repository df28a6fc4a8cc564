/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A transverse wave u_x = a sin(k y), k = 2 pi/L_y, in a box that is periodic along y, with which a gas may start
 * (gg_model.wave). Its amplitude is that of the momentum density, a = (2/M) sum m C_x sin(k y), M the mass of all
 * grains. It decays by the shear viscosity, da/dt = -(eta/rho) k^2 a. */
#ifndef GG_SHEAR_WAVE_H
#define GG_SHEAR_WAVE_H

#include <math.h>

#include "common/model.h"
#include "common/portable_math.h"

static inline double gg_wave_number(const gg_model *m)
{
  return 2 * M_PI / m->box[1];
}

static inline double gg_wave_profile(const gg_model *m, double y)
{
  return gg_agreed(sin(gg_wave_number(m) * y), GG_AGREED_FUNCTION);
}

/* Sums of mass, of mass x profile and x its square, and of m C_x x profile. */
typedef struct gg_wave_sums {
  double mass, profile, square, momentum;
} gg_wave_sums;

static inline void gg_wave_add(gg_wave_sums *sums, double mass, double profile, double cx)
{
  sums->mass += mass;
  sums->profile += mass * profile;
  sums->square += mass * profile * profile;
  sums->momentum += mass * profile * cx;
}

static inline double gg_wave_amplitude(const gg_wave_sums *sums)
{
  return 2 * sums->momentum / sums->mass;
}

/* The velocity to add to C_x at this profile, so that the amplitude is that of the model and the total momentum stays;
 * `sums` of all grains before. */
static inline double gg_wave_start(const gg_model *m, const gg_wave_sums *sums, double profile)
{
  const double mean = sums->profile / sums->mass, wanted = m->wave * sqrt(2 * m->temperature0 / m->mass[0]);
  return (wanted - gg_wave_amplitude(sums)) * sums->mass / 2 / (sums->square - sums->profile * mean) * (profile - mean);
}

#endif
