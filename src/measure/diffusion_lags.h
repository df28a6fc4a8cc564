/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lags at which diffusion correlates a grain with its past, and the sums at each lag. Level l has lags up to REACH
 * 4^l snapshots in steps of 4^l, from a quarter of it on: shorter lags belong to the level before. */
#ifndef GG_DIFFUSION_LAGS_H
#define GG_DIFFUSION_LAGS_H

#include <math.h>

#include "measure/long_time_tail.h"

enum {
  GG_LAG_SNAPSHOTS = 4, /* per sampling interval (two collisions a grain) */
  GG_LAG_LEVELS = 4,
  GG_LAG_REACH = 16,
  GG_LAG_OWN = GG_LAG_REACH * 3 / 4,
  GG_LAGS = GG_LAG_REACH + (GG_LAG_LEVELS - 1) * GG_LAG_OWN,
  GG_LAG_ORIGINS = 2 + 8 + 8 + 8 /* of all levels */
};
static const int gg_lag_origins[GG_LAG_LEVELS] = {2, 8, 8, 8};

/* Components of the tensor: x, y, z, and C_x(t) with C_y(0), C_y(t) with C_x(0), which shear alone correlates. */
enum { GG_LAG_XY = 3, GG_LAG_YX, GG_LAG_COMPONENTS };

/* Sums over grains and origins at one lag: number, time, C(0)C(t), C r and r r by component, r the displacement; r_x
 * r_y stands for both mixed components. */
enum {
  GG_LAG_COUNT,
  GG_LAG_TIME,
  GG_LAG_CC,
  GG_LAG_CC_XY = GG_LAG_CC + GG_LAG_XY,
  GG_LAG_CR = GG_LAG_CC + GG_LAG_COMPONENTS,
  GG_LAG_RR = GG_LAG_CR + GG_LAG_COMPONENTS,
  GG_LAG_WIDTH = GG_LAG_RR + GG_LAG_YX
};

/* Index among all lags of the lag of so many steps of a level; -1: at another level. */
static inline int gg_lag_index(int level, int steps)
{
  if (level == 0) return steps;
  return steps < GG_LAG_REACH / 4 ? -1 : GG_LAG_REACH + (level - 1) * GG_LAG_OWN + steps - GG_LAG_REACH / 4;
}

/* Number of snapshots between both ends of the lag. */
static inline double gg_lag_steps(int lag)
{
  if (lag < GG_LAG_REACH) return lag;
  int level = 1 + (lag - GG_LAG_REACH) / GG_LAG_OWN;
  return ldexp(GG_LAG_REACH / 4 + (lag - GG_LAG_REACH) % GG_LAG_OWN, 2 * level);
}

static inline double gg_lag_mean(const double *bin, int lag, int channel)
{
  const double *at = bin + lag * GG_LAG_WIDTH;
  return at[GG_LAG_COUNT] > 0 ? at[channel] / at[GG_LAG_COUNT] : NAN;
}

/* D of one species and component, from its means over samples. NaN if the samples do not cover long enough lags. The
 * Einstein coefficient of a mixed component is the mean of both. */
typedef struct gg_diffusion_coefficients {
  gg_coefficient green_kubo, einstein;
} gg_diffusion_coefficients;
gg_diffusion_coefficients gg_measure_diffusion_read(const gg_model *model, int species, int component,
                                                    const double *bin, double samples);

#endif
