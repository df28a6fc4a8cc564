/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocity moments of grains, by species, summed over chunks. */
#ifndef GG_VELOCITY_MOMENTS_H
#define GG_VELOCITY_MOMENTS_H

#include "common/engine.h"
#include "simd/dispatch.h"

/* Number of lanes of the sums: eight, independent of the processor's registers, so that every processor has the same
 * bits. */
enum { GG_VELOCITY_MOMENT_LANES = 8 };
typedef double gg_velocity_moment_lanes[GG_VELOCITY_MOMENT_LANES];
typedef struct gg_velocity_moment_sums {
  gg_velocity_moment_lanes cc[3], cxcy, c4[3], cccc, speed;
  gg_velocity_moment_lanes w[3], ww[3], w3[3], w4[3], cos2, ccww, cwcw, ccw[3], cwc[3], cxcz, cycz;
} gg_velocity_moment_sums;

/* Sums over grains of one species; spins about `mean_spin`. After gg_measure_velocity_moments_centre: */
typedef struct gg_velocity_moments {
  double n;
  double cc[3], cxcy;         /* C_a^2, C_x C_y */
  double c4[3];               /* C_a^4 */
  double cccc;                /* (C.C)^2 */
  double speed;               /* |C| */
  double mean_spin[3];        /* the mean about which spins are taken: a guess before centring, <s_a> after it */
  double ww[3], w3[3], w4[3]; /* sums of powers of Omega_a = s_a - mean_spin, surface velocities */
  double cos2;                /* (C.Omega)^2/(C^2 Omega^2), with the guess */
  double ccww, cwcw;          /* C^2 Omega^2, (C.Omega)^2 */
  gg_velocity_moment_sums sums;
} gg_velocity_moments;

/* n grains in groups of eight: group g is at c[a] + g x stride and the seven places that follow. Stored are C_x +
 * strain C_y, C_y, C_z. s[0] NULL: without spins. */
typedef struct gg_velocity_moment_view {
  size_t n, stride;
  double strain;
  const double *c[3], *s[3];
} gg_velocity_moment_view;

/* Add grains; spins are taken about m->mean_spin, any guess of their mean. `quick`: each |C| is rounded to single
 * precision, whose range C.C must be in; otherwise roots would cost as much as all other sums together. */
void gg_measure_velocity_moments_add(gg_velocity_moments *m, bool quick, const gg_velocity_moment_view *v);
/* The same with the registers of a set of instructions that this processor has. All sets leave the same bits. */
void gg_measure_velocity_moments_add_in(gg_instructions set, gg_velocity_moments *m, bool quick,
                                        const gg_velocity_moment_view *v);
/* After the last grain: mean_spin becomes the mean of the spins, and the powers of Omega are about it. */
void gg_measure_velocity_moments_centre(gg_velocity_moments *m);

#endif
