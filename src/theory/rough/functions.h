/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hermite functions of a velocity and a spin, Ho_r = prod_i He_{r_i}/sqrt(r_i!) over six coordinates, orthonormal under
 * the standard Gaussian; all of total degree up to N. Coordinates 0 .. 2 are a velocity, 3 .. 5 a spin. */
#ifndef GG_ROUGH_FUNCTIONS_H
#define GG_ROUGH_FUNCTIONS_H

#include <stdbool.h>

#include "base/error.h"

enum {
  GG_ROUGH_MOST_DEGREE = 14,
  GG_ROUGH_AXES = 6,
  /* functions of three coordinates up to that degree */
  GG_ROUGH_MOST_THREE = (GG_ROUGH_MOST_DEGREE + 1) * (GG_ROUGH_MOST_DEGREE + 2) * (GG_ROUGH_MOST_DEGREE + 3) / 6
};

typedef struct gg_rough_index {
  int r[GG_ROUGH_AXES];
} gg_rough_index;

typedef struct gg_rough_functions {
  int degree, n;
  gg_rough_index *function;
  int *by_degree, upto[GG_ROUGH_MOST_DEGREE + 2]; /* indices in order of degree; number below each degree */
  /* Neighbours: one quantum more or less along an axis; -1: none. */
  int (*up)[GG_ROUGH_AXES], (*down)[GG_ROUGH_AXES];
  /* Functions of the spin alone, by degree; those of one spin index s are at from[s] .. from[s + 1], ordered by
   * their velocity index, which runs over the first of the same list. */
  int n3;
  int (*three)[3];
  int *from;
  int *place3; /* by the three indices */
} gg_rough_functions;

gg_status gg_rough_functions_make(gg_rough_functions *f, int degree, gg_error *err);
void gg_rough_functions_clear(gg_rough_functions *f);

/* Index of a function; -1 if there is none. */
int gg_rough_place(const gg_rough_functions *f, const int r[GG_ROUGH_AXES]);

static inline int gg_rough_degree(gg_rough_index index)
{
  return index.r[0] + index.r[1] + index.r[2] + index.r[3] + index.r[4] + index.r[5];
}

/* Number of functions of three coordinates of degree up to k. */
static inline int gg_rough_count3(int k)
{
  return k < 0 ? 0 : (k + 1) * (k + 2) * (k + 3) / 6;
}

/* Parities that a shear flow keeps: of the velocity, and under reflection of z (the spin is an axial vector). */
static inline int gg_rough_class(gg_rough_index index)
{
  const int *r = index.r;
  return (r[0] + r[1] + r[2]) % 2 + 2 * ((r[2] + r[3] + r[4]) % 2);
}

#endif
