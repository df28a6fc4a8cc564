/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Operations on the three axes at once: vectors of four lanes, the fourth unused. They are plain vector types; each
 * lane has the operations of a single axis, so results are the same on every processor. There is no branch on an axis
 * or a side, since the next one is unpredictable. */
#ifndef GG_SIMD_AXES_H
#define GG_SIMD_AXES_H

#include <math.h>
#include <stdint.h>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "common/vec.h"

typedef double gg_axes __attribute__((vector_size(32)));
typedef int64_t gg_axes_mask __attribute__((vector_size(32)));
typedef int32_t gg_indices __attribute__((vector_size(16)));
typedef double gg_axes_there __attribute__((vector_size(32), may_alias, aligned(8)));
typedef int32_t gg_indices_there __attribute__((vector_size(16), may_alias, aligned(4)));

/* Load three numbers; the fourth lane reads whatever is behind them, which must be readable. */
GG_INLINE gg_axes gg_load_axes(const double *x)
{
  return *(const gg_axes_there *)x;
}
GG_INLINE gg_indices gg_load_indices(const int32_t *k)
{
  return *(const gg_indices_there *)k;
}

GG_INLINE gg_axes gg_choose_axes(gg_axes_mask mask, gg_axes yes, gg_axes no)
{
  return (gg_axes)(((gg_axes_mask)yes & mask) | ((gg_axes_mask)no & ~mask));
}

/* Mask as bits, bit a for axis a; and bits as mask. */
GG_INLINE uint32_t gg_axes_bits(gg_axes_mask mask)
{
#if defined(__AVX2__)
  return (uint32_t)_mm256_movemask_pd((__m256d)mask);
#else
  return (uint32_t)((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
GG_INLINE gg_axes_mask gg_axes_of(uint32_t bits)
{
  gg_axes_mask each = {1, 2, 4, 8};
  return ((int64_t)bits & each) != 0;
}
GG_INLINE gg_indices gg_indices_of(uint32_t bits)
{
  gg_indices each = {1, 2, 4, 8};
  return ((int32_t)bits & each) != 0;
}

GG_INLINE gg_axes gg_sqrt_axes(gg_axes x)
{
#if defined(__AVX2__)
  return (gg_axes)_mm256_sqrt_pd((__m256d)x);
#else
  return (gg_axes){sqrt(x[0]), sqrt(x[1]), sqrt(x[2]), sqrt(x[3])};
#endif
}

GG_INLINE gg_axes gg_nearest_axes(gg_axes x)
{
  gg_axes shift = {0x1.8p52, 0x1.8p52, 0x1.8p52, 0x1.8p52};
  return (x + shift) - shift;
}

/* gg_wrap for each axis. */
GG_INLINE gg_axes gg_wrap_axes(gg_axes x, gg_axes edge, gg_axes inverse)
{
  gg_axes scaled = x * inverse, whole = gg_nearest_axes(scaled);
  return x - edge * gg_choose_axes(whole > scaled, whole - 1, whole);
}

/* The smallest lane, in all lanes. */
GG_INLINE gg_axes gg_least_axes(gg_axes x)
{
  gg_axes other = __builtin_shufflevector(x, x, 2, 3, 0, 1);
  x = gg_choose_axes(x < other, x, other);
  other = __builtin_shufflevector(x, x, 1, 0, 3, 2);
  return gg_choose_axes(x < other, x, other);
}

#endif
