/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The box, its images and, under shear, its moving images (Lees & Edwards, J. Phys. C 5 (1972) 1921).
 *
 * The image above the box moves along x at speed U = shear_rate L_y and has the offset D(t) = D_0 + U t; the image
 * below moves the other way. The image of a grain there has position r + (D, L_y, 0) and velocity v + (U, 0, 0). */
#ifndef GG_MD_BOX_H
#define GG_MD_BOX_H

#include <stdint.h>

#include "common/vec.h"

typedef struct gg_md_box {
  double edge[3], inverse[3];
  double image_velocity; /* U; 0 without shear, and below 0 in reversed shear */
  double offset0;        /* D_0, in [0, L_x): offset at the start of the epoch */
} gg_md_box;

/* Largest integer <= x, without libm; |x| < 2^62. */
GG_INLINE double gg_floor(double x)
{
  double whole = (double)(int64_t)x;
  return whole > x ? whole - 1 : whole;
}

/* Nearest integer, ties to even, in two exact additions; |x| < 2^51. */
GG_INLINE double gg_nearest(double x)
{
  const double shift = 0x1.8p52;
  return (x + shift) - shift;
}

/* Wrap x into [0, edge), but for rounding at the upper end. */
GG_INLINE double gg_wrap(double x, double edge, double inverse)
{
  return x - edge * gg_floor(x * inverse);
}

GG_INLINE double gg_md_offset(const gg_md_box *b, double t)
{
  return gg_wrap(b->offset0 + b->image_velocity * t, b->edge[0], b->inverse[0]);
}

/* Minimum-image convention: replaces the separation dr by that of the nearest images, and dv by their relative
 * velocity. Valid for pairs closer than half the shortest edge. */
GG_INLINE void gg_md_minimum_image(const gg_md_box *b, int sheared, double t, gg_vec *dr, gg_vec *dv)
{
  double layers = gg_nearest(dr->y * b->inverse[1]);
  dr->y -= b->edge[1] * layers;
  if (sheared && layers != 0) { /* seldom */
    dr->x -= layers * gg_md_offset(b, t);
    dv->x -= layers * b->image_velocity;
  }
  dr->x -= b->edge[0] * gg_nearest(dr->x * b->inverse[0]);
  dr->z -= b->edge[2] * gg_nearest(dr->z * b->inverse[2]);
}

#endif
