/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quadrature over contact velocities g of one direction, for friction.h. g = rho v on rays v of an angle psi from k and
 * an azimuth alpha: a ray slides or sticks as a whole, its impulse is proportional to rho, and the Gaussian in rho is
 * exp(-(A rho^2 - 2 B rho + C)/2), which has a Gauss rule of its own. */
#ifndef GG_ROUGH_FRICTION_POINTS_H
#define GG_ROUGH_FRICTION_POINTS_H

#include "theory/rough/rough_collision.h"

/* Coordinates y = Y z, orthonormal, det Y = 1. */
typedef struct gg_rough_frame {
  double axis[3][3]; /* k, t1, t2 */
  double Y[GG_ROUGH_AXES][GG_ROUGH_AXES];
  double R[3][3], m[3];       /* g = R y + m */
  double D[GG_ROUGH_AXES][3]; /* y' = y + D J */
  double eta1, eta2, mu;
} gg_rough_frame;

gg_rough_frame gg_rough_frame_of(const gg_rough_gas *gas, const gg_rough_weight *weight, const double k[3]);

typedef struct gg_rough_point {
  double weight; /* of an average of g_n x function over the Gaussian, g_n > 0 */
  double y[3];   /* y1, y2, y3 before the collision */
  double normal; /* g_n */
} gg_rough_point;

/* Contacts that slide, at one azimuth: their impulse is g_n times a constant vector. */
typedef struct gg_rough_slide {
  double J[3]; /* that vector, along k, t1, t2 */
  int n;
  const gg_rough_point *point;
} gg_rough_slide;

/* Contacts that stick have J = (eta1 g_n, eta2 g_t). */
typedef struct gg_rough_points {
  int sticks, azimuths;
  const gg_rough_point *stick;
  const gg_rough_slide *slide; /* by azimuth */
} gg_rough_points;

typedef struct gg_rough_rays gg_rough_rays; /* rules and memory */
gg_status gg_rough_rays_make(gg_rough_rays **rays, int degree, gg_error *err);
void gg_rough_rays_free(gg_rough_rays *rays);

/* All points of a direction; borrowed until the next call. No azimuths where the flow across the contact is so fast
 * beside thermal velocities that they are too few. */
gg_rough_points gg_rough_rays_points(gg_rough_rays *rays, const gg_rough_frame *frame);

#endif
