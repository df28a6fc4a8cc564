/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slabs across the gap between walls, in which profiles are measured; and their images under the symmetry of the
 * gap. */
#ifndef GG_GAP_SLABS_H
#define GG_GAP_SLABS_H

#include <math.h>

#include "measure/curve.h"
#include "measure/wall_modes.h"

enum { GG_LEAST_GAP_SLABS = 8, GG_MOST_GAP_SLABS = 80 };
#define GG_GAP_THICKNESS 0.5

/* An even number: no slab is its own mirror image. */
static inline int gg_measure_gap_slabs(const gg_model *m)
{
  double pairs = round(m->box[1] / (2 * GG_GAP_THICKNESS));
  return 2 * (int)fmin(fmax(pairs, GG_LEAST_GAP_SLABS / 2), GG_MOST_GAP_SLABS / 2);
}

/* Factor of a vector's component a under the symmetry; spins are axial: a mirror reverses the components along it,
 * and keeps the one across. */
static inline double gg_wall_image(gg_wall_symmetry symmetry, bool axial, int a)
{
  if (symmetry == GG_TURNED) return a == 2 ? 1 : -1;
  return (a == 1) == axial ? 1 : -1; /* mirrored */
}

/* Number `middle` of a profile: its mean over the slabs whose middle is within 0.12 of the gap's width from its middle.
 * Between walls that move, the velocity has `slope_middle` instead, by least squares over them. */
static inline void gg_measure_gap_middle(const gg_model *m, gg_curve *c, bool velocity)
{
  const double middle = 0.5 * m->box[1];
  double n = 0, sum = 0, hh = 0, hv = 0;
  bool moves = false;
  for (int w = 0; w < m->n_surfaces; w++) moves |= m->surface[w].velocity.x != 0;
  for (size_t i = 0; i < c->n; i++) {
    const double h = c->x[i] - middle;
    if (fabs(h) < 0.12 * m->box[1]) n++, sum += c->value[i], hh += h * h, hv += h * c->value[i];
  }
  if (velocity && moves)
    gg_measure_curve_put_number(c, "slope_middle", hv / hh, gg_measure_curve_unit(m, "spin"));
  else
    gg_measure_curve_put_number(c, "middle", sum / n, c->unit);
}

#endif
