/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The eight lanes of a block in GG_PARTS registers of GG_WIDTH lanes (simd/lanes.h), and operations of speed bounds. */
#ifndef GG_DSMC_KERNEL_LANES_H
#define GG_DSMC_KERNEL_LANES_H

#include <math.h>

#include "dsmc/kernel/pass.h"
#include "simd/lanes.h"

enum { GG_PARTS = GG_DSMC_LANES / GG_WIDTH };

/* GG_TINY is added to denominators that may be 0. gg_v2: two numbers. */
#ifdef GG_SINGLE_LANES
#define GG_TINY 1e-37f
typedef gg_dsmc_block_single gg_dsmc_real_block;
typedef gg_real gg_v2 __attribute__((vector_size(16))); /* two of four */
#else
#define GG_TINY 1e-300
typedef gg_dsmc_block gg_dsmc_real_block;
typedef gg_real gg_v2 __attribute__((vector_size(16)));
#endif

/* Square roots of entries of a table, rounded to float. */
GG_INLINE gg_vd gg_dsmc_roots_at(const float *table, gg_vu at)
{
#if defined(GG_HAS_AVX512) && defined(GG_SINGLE_LANES)
  return _mm256_sqrt_ps(_mm256_i32gather_ps(table, (__m256i)at, 4));
#elif defined(GG_HAS_AVX512)
  return _mm512_cvtps_pd(_mm256_sqrt_ps(_mm512_i64gather_ps((__m512i)at, table, 4)));
#elif defined(GG_SINGLE_LANES)
  gg_vd x;
  for (int l = 0; l < GG_WIDTH; l++) x[l] = table[at[l]];
  return gg_sqrt(x);
#elif defined(GG_HAS_AVX2)
  return _mm256_cvtps_pd(_mm_sqrt_ps(_mm_setr_ps(table[at[0]], table[at[1]], table[at[2]], table[at[3]])));
#else
  return (gg_vd){sqrtf(table[at[0]]), sqrtf(table[at[1]])};
#endif
}

/* The largest lane of a, and the largest lane of b. */
GG_INLINE gg_v2 gg_dsmc_peaks(gg_vd a, gg_vd b)
{
#if (defined(GG_HAS_AVX512) || defined(GG_HAS_AVX2)) && defined(GG_SINGLE_LANES)
  __m256 pairs = _mm256_max_ps(_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b)); /* of lanes 0 2, 1 3 */
  __m128 fours = _mm_max_ps(_mm256_castps256_ps128(pairs), _mm256_extractf128_ps(pairs, 1));
  return _mm_max_ps(fours, _mm_movehl_ps(fours, fours));
#elif defined(GG_HAS_AVX512)
  __m512d pairs = _mm512_max_pd(_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
  __m256d half = _mm256_max_pd(_mm512_castpd512_pd256(pairs), _mm512_extractf64x4_pd(pairs, 1));
  return _mm_max_pd(_mm256_castpd256_pd128(half), _mm256_extractf128_pd(half, 1));
#elif defined(GG_HAS_AVX2)
  __m256d pairs = _mm256_max_pd(_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
  return _mm_max_pd(_mm256_castpd256_pd128(pairs), _mm256_extractf128_pd(pairs, 1));
#elif defined(GG_SINGLE_LANES)
  gg_vd pairs = gg_larger((gg_vd){a[0], b[0], a[1], b[1]}, (gg_vd){a[2], b[2], a[3], b[3]});
  return gg_larger(pairs, (gg_vd){pairs[2], pairs[3], pairs[0], pairs[1]});
#else
  return gg_larger((gg_v2){a[0], b[0]}, (gg_v2){a[1], b[1]});
#endif
}

/* Store both peaks in single precision. */
GG_INLINE void gg_dsmc_peaks_store(gg_v2 peaks, float *one, float *two)
{
#ifdef GG_SINGLE_LANES
  *one = peaks[0];
  *two = peaks[1];
#else
  typedef float gg_f2 __attribute__((vector_size(8)));
  gg_f2 rounded = __builtin_convertvector(peaks, gg_f2);
  *one = rounded[0];
  *two = rounded[1];
#endif
}

/* Set the speed bound of a block part by part, by C^2 of the lanes from `at`. */
GG_INLINE void gg_dsmc_set_speed_bound(float *speed_bound, int at, gg_vd c2, gg_real per_scale)
{
  float peak = (float)(gg_dsmc_peaks(c2, c2)[0] * per_scale);
  *speed_bound = at && *speed_bound > peak ? *speed_bound : peak;
}

#ifndef GG_SINGLE_LANES
/* Load and store numbers in single precision. gg_dsmc_store_single returns the rounded values. */
typedef float gg_vf __attribute__((vector_size(4 * GG_WIDTH), aligned(4 * GG_WIDTH)));
GG_INLINE gg_vd gg_dsmc_load_single(const float *from)
{
  return __builtin_convertvector(*(const gg_vf *)from, gg_vd);
}
GG_INLINE gg_vd gg_dsmc_store_single(float *to, gg_vd v)
{
  gg_vf rounded = __builtin_convertvector(v, gg_vf);
  *(gg_vf *)to = rounded;
  return __builtin_convertvector(rounded, gg_vd);
}
#endif

#endif
