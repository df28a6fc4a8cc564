/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eight directions of collision at a time, one in each SIMD lane: their contributions to the operator W
 * (relative.h). Tests are processed along a path of at most N + 1 of them, so that data that are needed again soon
 * stay in the cache. */
#ifndef GG_ROUGH_EIGHT_DIRECTIONS_H
#define GG_ROUGH_EIGHT_DIRECTIONS_H

#include "theory/rough/rough_collision.h"

enum { GG_ROUGH_LANES = 8 };
typedef double gg_rough_lanes __attribute__((vector_size(GG_ROUGH_LANES * sizeof(double))));

/* A function with those of one degree less: Ho_T z_j has sqrt(r_j) of each, with r its index along j. */
typedef struct gg_rough_below {
  int n, from[GG_ROUGH_AXES], root[GG_ROUGH_AXES];
} gg_rough_below;

typedef struct gg_rough_eight {
  const gg_rough_functions *f;
  int *path;             /* tests in an order in which each one soon follows the test from which it is made */
  gg_rough_below *below; /* by function */
  gg_rough_lanes b[GG_ROUGH_AXES];
  gg_rough_lanes *root; /* sqrt(r) M, by row of M, column, and r up to N + 1 */
  gg_rough_lanes *row;  /* by degree: Ho_R(M z + b) = sum_T E_RT Ho_T(z) of the present path's test R */
  gg_rough_lanes *flux; /* < g_n Ho_t(d) Ho_s(d) > times the solid angle, by class of s, t, and s in that class */
  int *sorted, sorted_n[4];
} gg_rough_eight;

gg_status gg_rough_eight_make(gg_rough_eight *x, const gg_rough_functions *f, gg_error *err);
void gg_rough_eight_clear(gg_rough_eight *x);
/* A lane's direction, with its flux (n3 x n3) and solid angle. */
void gg_rough_eight_set(gg_rough_eight *x, int lane, const gg_rough_collision *c, const double *flux,
                        double solid_angle);
/* All lanes, added to W (n x n). */
void gg_rough_eight_add(const gg_rough_eight *x, double *W);

#endif
