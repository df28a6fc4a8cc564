/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random words of the lanes' streams, and the numbers that they are made into. */
#ifndef GG_DSMC_LANE_RANDOM_H
#define GG_DSMC_LANE_RANDOM_H

#include "dsmc/kernel/kernel_lanes.h"
#include "dsmc/kernel/lane_rng.h"

/* gg_dsmc_lane_two: two random words a lane, from whose high bits gg_dsmc_lane_one_to_two makes a number uniform in
 * [1, 2), gg_dsmc_lane_two_to_four one in [2, 4); GG_SPARE_BIT hardly matters to it. */
#ifdef GG_SINGLE_LANES
enum { GG_SPARE_BIT = 0 };

/* One word of the first four numbers, and one of the other four. */
GG_INLINE void gg_dsmc_lane_two(gg_dsmc_lane_rng *rng, int part, gg_vu *a, gg_vu *b)
{
  *a = (gg_vu)gg_dsmc_lane_next(rng, part);
  *b = (gg_vu)gg_dsmc_lane_next(rng, part + GG_PARTS);
}
/* 23 bits: the low 9 are left for other uses. */
GG_INLINE gg_vd gg_dsmc_lane_one_to_two(gg_vu word)
{
  return (gg_vd)((word >> 9) | 0x3f800000u);
}
GG_INLINE gg_vd gg_dsmc_lane_two_to_four(gg_vu word)
{
  return (gg_vd)((word >> 9) | 0x40000000u);
}

/* High halves of the products; n is the same in all lanes. */
GG_INLINE gg_vu gg_dsmc_lane_below(gg_vu word, gg_vu n)
{
#if defined(GG_HAS_AVX512) || defined(GG_HAS_AVX2)
  const __m256i factor = (__m256i)n;
  __m256i even = _mm256_mul_epu32((__m256i)word, factor),
          odd = _mm256_mul_epu32(_mm256_srli_epi64((__m256i)word, 32), factor);
  return (gg_vu)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
#else
  gg_vu high;
  for (int l = 0; l < GG_WIDTH; l++) high[l] = (uint32_t)((uint64_t)word[l] * n[l] >> 32);
  return high;
#endif
}
#else
enum { GG_SPARE_BIT = 32 };

/* Good for 32 bits at least; the low half of the first is the second. */
GG_INLINE void gg_dsmc_lane_two(gg_dsmc_lane_rng *rng, int part, gg_vu *a, gg_vu *b)
{
  *a = gg_dsmc_lane_next(rng, part);
  *b = *a << 32;
}
/* 52 bits: the low 12 are left for other uses. */
GG_INLINE gg_vd gg_dsmc_lane_one_to_two(gg_vu word)
{
  return (gg_vd)((word >> 12) | 0x3ff0000000000000u);
}
GG_INLINE gg_vd gg_dsmc_lane_two_to_four(gg_vu word)
{
  return (gg_vd)((word >> 12) | 0x4000000000000000u);
}

/* High half of the product of low halves. */
GG_INLINE gg_vu gg_dsmc_lane_below(gg_vu word, gg_vu n)
{
#if defined(GG_HAS_AVX512)
  return (gg_vu)_mm512_mul_epu32((__m512i)word, (__m512i)n) >> 32;
#elif defined(GG_HAS_AVX2)
  return (gg_vu)_mm256_mul_epu32((__m256i)word, (__m256i)n) >> 32;
#else
  return (word & UINT32_MAX) * (n & UINT32_MAX) >> 32;
#endif
}
#endif

/* Whole numbers below m and below n < 2^32. */
GG_INLINE void gg_dsmc_lane_two_below(gg_dsmc_lane_rng *rng, int part, gg_vu m, gg_vu n, gg_vu *a, gg_vu *b)
{
#ifdef GG_SINGLE_LANES
  gg_dsmc_lane_two(rng, part, a, b);
  *a = gg_dsmc_lane_below(*a, m);
  *b = gg_dsmc_lane_below(*b, n);
#else
  gg_vu bits = gg_dsmc_lane_next(rng, part);
  *a = gg_dsmc_lane_below(bits >> 32, m);
  *b = gg_dsmc_lane_below(bits, n);
#endif
}

#endif
