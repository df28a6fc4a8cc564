/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distribution, weight x sum_q a_q Ho_q, and its streaming between collisions. */
#ifndef GG_ROUGH_STATE_H
#define GG_ROUGH_STATE_H

#include "theory/rough/rough_pairs.h"

/* Streaming between collisions, dC/dt = -A C, d(spin)/dt = -B (spin - rolling): linear in the coefficients; diffusion,
 * of velocities and spins: noise. */
typedef struct gg_rough_stream {
  double velocity[3][3], spin, rolling, diffusion, spin_diffusion;
} gg_rough_stream;

void gg_rough_stream_add(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *weight,
                         const gg_rough_stream *stream, const double *a, double *R, double *jacobian);

/* <Ho_k> of a component of velocity or spin in units of its spread under the weight, k up to GG_ROUGH_MOST_DEGREE. */
void gg_rough_marginal(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *weight,
                       const double *a, bool spin, int axis, double *h);

/* Moments <(n.x)^j>, j = 1 .. 4, of velocity (spin: false) or spin along a coordinate axis; spins from the weight's
 * mean. moment[0] = 1. */
void gg_rough_moments(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *weight,
                      const double *a, bool spin, int axis, double moment[5]);

/* Covariance of velocity or spin, and the mean spin about z. */
void gg_rough_covariance(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *weight,
                         const double *a, bool spin, double M[3][3]);
double gg_rough_mean_spin(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *weight,
                          const double *a);

/* a11 = <C^2 W^2>/(<C^2><W^2>) - 1 and b = <(C.W)^2>/(<C^2><W^2>) - 1/3, W the spin about its mean. */
typedef struct gg_rough_correlation {
  double a11, b;
} gg_rough_correlation;
gg_rough_correlation gg_rough_correlations(const gg_rough_form *form, const gg_rough_functions *f,
                                           const gg_rough_weight *weight, const double *a);

/* <|C|> */
double gg_rough_mean_speed(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *weight,
                           const double *a);

#endif
