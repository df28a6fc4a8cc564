/* What maps a flow between walls onto itself: the walls being alike, a flow along them has a mirror image. */
#ifndef GG_WALL_SYMMETRY_H
#define GG_WALL_SYMMETRY_H

#include "common/model.h"

typedef enum gg_wall_symmetry {
  GG_NO_SYMMETRY,
  GG_MIRRORED, /* y -> -y about the middle of the gap: walls at rest, no gravity across */
  GG_TURNED /* x -> -x and y -> -y, half a turn about z: walls that move against each other, no gravity but along z */
} gg_wall_symmetry;

static inline gg_wall_symmetry gg_wall_symmetry_of(const gg_model *m)
{
  bool still = true;
  if (!m->walled || m->gravity[1] != 0) return GG_NO_SYMMETRY;
  for (int w = 0; w < m->n_surfaces; w++) {
    if (gg_surface_image(m, w) < 0) return GG_NO_SYMMETRY;
    still &= m->surface[w].velocity.x == 0;
  }
  if (still) return GG_MIRRORED;
  return m->gravity[0] == 0 ? GG_TURNED : GG_NO_SYMMETRY;
}

#endif
