/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Three-vectors of doubles by value; everything inlines. */
#ifndef GG_VEC_H
#define GG_VEC_H

#define GG_INLINE static inline __attribute__((always_inline))

typedef struct gg_vec {
  double x, y, z;
} gg_vec;

#define GG_NUMBER double
#define GG_VECTOR gg_vec
#define GG_OF(name) gg_##name
#include "common/vec_of.h"

/* Component 0, 1 or 2 of a vector. */
GG_INLINE double *gg_component(gg_vec *v, int axis)
{
  return (double *)v + axis;
}
GG_INLINE double gg_along(const gg_vec *v, int axis)
{
  return ((const double *)v)[axis];
}

#endif
