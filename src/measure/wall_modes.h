/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The long waves across the gap between walls: slow fluctuations that no mean over all grains shows. A run stores
 * them as a series, from which it determines how long it has to average (measure/slow_modes.c). They come from the
 * slabs of the local frame, which every sample computes anyway. */
#ifndef GG_WALL_MODES_H
#define GG_WALL_MODES_H

#include "common/model.h"
#include "measure/local_frame.h"

enum { GG_WALL_CENTRE, GG_MOST_WALL_MODES = 9 }; /* the first: the centre of mass */

/* Number of modes of this model; 0 without walls. */
int gg_measure_wall_modes(const gg_model *model);
/* Present values of the modes. */
void gg_measure_wall_modes_take(const gg_model *model, const gg_slabs *slabs, double *row);
/* "the centre of mass across the gap" */
const char *gg_measure_wall_mode_name(int mode);
/* True if it changes its sign under the symmetry of the flow, so that its true mean is 0. */
bool gg_measure_wall_mode_is_odd(const gg_model *model, int mode);

/* The symmetry of a flow between walls: if the walls are alike, a flow along them has a mirror image. */
typedef enum gg_wall_symmetry {
  GG_NO_SYMMETRY,
  GG_MIRRORED, /* y -> -y about the middle of the gap: walls at rest and alike, no gravity across, no torque about z */
  GG_TURNED /* x -> -x and y -> -y, half a turn about z: walls that move against each other, no gravity but along z */
} gg_wall_symmetry;

static inline gg_wall_symmetry gg_wall_symmetry_of(const gg_model *m)
{
  bool still = true;
  if (!m->walled || m->gravity[1] != 0) return GG_NO_SYMMETRY;
  for (int w = 0; w < m->n_surfaces; w++) {
    const int image = gg_surface_image(m, w);
    if (image < 0 || m->surface[image].temperature != m->surface[w].temperature) return GG_NO_SYMMETRY;
    still &= m->surface[w].velocity.x == 0;
  }
  if (still && gg_common_model_is_turned(m)) return m->gravity[0] == 0 ? GG_TURNED : GG_NO_SYMMETRY;
  if (still) return GG_MIRRORED;
  return m->gravity[0] == 0 ? GG_TURNED : GG_NO_SYMMETRY;
}

#endif
