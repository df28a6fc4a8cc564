/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The longest waves of a periodic box: what tells a homogeneous gas from one that has clustered or swirls. Of each axis
 * of length L the modes k = 2 pi/L and 4 pi/L (bands of a sheared gas come in twos), which also moving images (Lees &
 * Edwards 1972) leave alone. Grains are counted in slabs across each axis, of which the modes are sums: no function of
 * the grains' places costs time. */
#ifndef GG_LONG_WAVES_H
#define GG_LONG_WAVES_H

#include "common/engine.h"
#include "common/model.h"

enum { GG_WAVE_SLABS = 16, GG_LONG_WAVES = 2 };
typedef struct gg_wave_slab {
  double matter, momentum[3];
} gg_wave_slab;
typedef struct gg_long_waves {
  gg_wave_slab slab[3][GG_WAVE_SLABS]; /* by axis */
  double matter_squares, squares[3];   /* sums of the grains' own squares: what they would give at random */
} gg_long_waves;

/* Does this model have them? A periodic box, no walls. */
static inline bool gg_measure_has_long_waves(const gg_model *m)
{
  return !m->homogeneous && !m->walled;
}

/* Grains with positions; all sums are 0 at first. */
void gg_measure_long_waves_add(gg_long_waves *waves, const gg_model *model, const gg_chunk *chunk);

/* Means over axes and modes of |sum d^3 exp(ikr)|^2/(sum d^6 S), S = S(0) of elastic spheres at this solid fraction,
 * and of |sum m C_t exp(ikr)|^2/(sum m^2 C_t^2), C_t across k. Both are 1 in a large homogeneous elastic gas. */
void gg_measure_long_waves_finish(const gg_long_waves *waves, const gg_model *model, double *density, double *momentum);

#endif
