/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random words of the streams of the lanes, and random numbers from them. */
#ifndef GG_DSMC_LANE_RANDOM_H
#define GG_DSMC_LANE_RANDOM_H

#include "dsmc/kernel/kernel_lanes.h"
#include "dsmc/kernel/lane_rng.h"

/* gg_dsmc_lane_two draws two random words a lane. From their high bits gg_dsmc_lane_one_to_two makes a number uniform
 * in [1, 2), gg_dsmc_lane_two_to_four in [2, 4). Bit GG_SPARE_BIT has hardly any effect on these numbers. */
#ifdef GG_SINGLE_LANES
enum { GG_SPARE_BIT = 0 };

/* A word of the streams of the first four lanes, and a word of those of the other four. */
GG_INLINE void gg_dsmc_lane_two(gg_dsmc_lane_rng *rng, int part, gg_vu *a, gg_vu *b)
{
  *a = (gg_vu)gg_dsmc_lane_next(rng, part);
  *b = (gg_vu)gg_dsmc_lane_next(rng, part + GG_PARTS);
}
/* Uses the high 23 bits; the low 9 bits are free for other uses. */
GG_INLINE gg_vd gg_dsmc_lane_one_to_two(gg_vu word)
{
  return (gg_vd)((word >> 9) | 0x3f800000u);
}
GG_INLINE gg_vd gg_dsmc_lane_two_to_four(gg_vu word)
{
  return (gg_vd)((word >> 9) | 0x40000000u);
}

/* Whole numbers below n: high halves of products. n is the same in all lanes. */
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

/* Two words with at least 32 random bits each; the second is the low half of the first. */
GG_INLINE void gg_dsmc_lane_two(gg_dsmc_lane_rng *rng, int part, gg_vu *a, gg_vu *b)
{
  *a = gg_dsmc_lane_next(rng, part);
  *b = *a << 32;
}
/* Uses the high 52 bits; the low 12 bits are free for other uses. */
GG_INLINE gg_vd gg_dsmc_lane_one_to_two(gg_vu word)
{
  return (gg_vd)((word >> 12) | 0x3ff0000000000000u);
}
GG_INLINE gg_vd gg_dsmc_lane_two_to_four(gg_vu word)
{
  return (gg_vd)((word >> 12) | 0x4000000000000000u);
}

/* Whole numbers below n: high halves of products of low halves. */
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

/* Draw whole numbers below m and below n; both < 2^32. */
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
