/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The longest waves of a periodic box, which distinguish a homogeneous gas from one with clusters or vortices. Along
 * each axis of length L these are the modes k = 2 pi/L and 4 pi/L (bands of a sheared gas come in pairs), which are
 * compatible with moving images (Lees & Edwards 1972), too. Grains are counted in slabs across each axis, and the
 * modes are sums over slabs: no function of the grains' positions costs time. */
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
  double matter_squares, squares[3];   /* sums of the grains' own squares: the expected values for random positions */
} gg_long_waves;

/* True if this model has them: a periodic box with positions along each axis, no walls. */
static inline bool gg_measure_has_long_waves(const gg_model *m)
{
  return !m->ensemble && !m->walled;
}

/* Add grains with positions; initially all sums are 0. */
void gg_measure_long_waves_add(gg_long_waves *waves, const gg_model *model, const gg_chunk *chunk);

/* Means over axes and modes of |sum d^3 exp(ikr)|^2/(sum d^6 S), S = S(0) of elastic spheres at this solid fraction,
 * and of |sum m C_t exp(ikr)|^2/(sum m^2 C_t^2), C_t across k. Both are 1 in a large homogeneous elastic gas. */
void gg_measure_long_waves_finish(const gg_long_waves *waves, const gg_model *model, double *density, double *momentum);

#endif
