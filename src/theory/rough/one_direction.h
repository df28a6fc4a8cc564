/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions along one direction, k = z towards the partner, about an isotropic weight:
 *   4 pi < g_n [psi_r(1') - psi_r(1)] Ho_p(1) Ho_q(2) >,   g_n > 0,
 * for tests psi_r of one grain, with decay or without. The weight, the tests and the rule of collision are products
 * over the coordinates: c_z by itself, c_x with s_y, c_y with s_x, and s_z, which stays. */
#ifndef GG_ROUGH_ONE_DIRECTION_H
#define GG_ROUGH_ONE_DIRECTION_H

#include "theory/rough/rough_pairs.h"

typedef struct gg_rough_direction {
  int tests, trials; /* degrees */
  double *normal[2]; /* of c_z, after and before: [test][one][two] */
  double *along[2];  /* of c_x and s_y: [test][one][two] and [test][two][one], pairs numbered by gg_rough_two */
  double *kept[2];   /* < psi_m Ho_p > of a velocity, of a spin: [test][one] */
} gg_rough_direction;

gg_status gg_rough_direction_make(gg_rough_direction *d, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                  const gg_rough_choice *decays, int tests, int trials, gg_error *err);
void gg_rough_direction_clear(gg_rough_direction *d);

/* Number of two indices, by their sum. */
static inline int gg_rough_two(int s, int t)
{
  return (s + t) * (s + t + 1) / 2 + t;
}

/* Parities of the indices of the two coupled pairs of coordinates: for collision integrals that are not 0 they are
 * the same for the test and both grains together. */
static inline int gg_rough_parity(const int *r)
{
  return (r[0] + r[4]) % 2 + 2 * ((r[1] + r[3]) % 2);
}

/* A function of one grain: its Hermite functions, with coefficients. */
typedef struct gg_rough_term {
  double value;
  int r[GG_ROUGH_AXES], x, y; /* x, y: numbers of both pairs */
} gg_rough_term;

static inline gg_rough_term gg_rough_term_of(const int *r, double value)
{
  return (gg_rough_term){
      value, {r[0], r[1], r[2], r[3], r[4], r[5]}, gg_rough_two(r[0], r[4]), gg_rough_two(r[1], r[3])};
}

/* Sum over terms of grain 2, with grain 1 in Ho_fixed; swapped: over terms of grain 1, with grain 2 in Ho_fixed. */
double gg_rough_direction_sum(const gg_rough_direction *d, const int *test, const int *fixed, bool swapped,
                              const gg_rough_term *terms, int n);

/* < psi_test Ho_one >, without collisions. */
double gg_rough_direction_kept(const gg_rough_direction *d, const int *test, const int *one);

#endif
