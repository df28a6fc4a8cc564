/* The operations of lanes.h on floats: all eight in one register, or four. */
#ifndef GG_DSMC_LANES_SINGLE_H
#define GG_DSMC_LANES_SINGLE_H

#include "dsmc/kernel/lane_rng.h"

#if defined(GG_HAS_AVX512) || defined(GG_HAS_AVX2)
enum { GG_WIDTH = 8 };
#else
enum { GG_WIDTH = 4 };
#endif
enum { GG_PARTS = GG_DSMC_LANES / GG_WIDTH, GG_REAL_BITS = 32, GG_SPARE_BIT = 0 };
typedef float gg_real;
typedef uint32_t gg_word; /* as wide as a number */
#define GG_TINY 1e-37f    /* added to what may be 0/0 */

typedef gg_dsmc_block_single gg_dsmc_real_block;
typedef gg_real gg_vd __attribute__((vector_size(4 * GG_WIDTH)));
typedef int32_t gg_vi __attribute__((vector_size(4 * GG_WIDTH)));
typedef gg_word gg_vu __attribute__((vector_size(4 * GG_WIDTH)));
typedef gg_real gg_v2 __attribute__((vector_size(16))); /* two of four */

#ifdef GG_HAS_AVX512
typedef __mmask8 gg_mask;
typedef __m256i gg_order;
GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  return _mm256_sqrt_ps(x);
}
GG_INLINE gg_mask gg_less(gg_vd a, gg_vd b)
{
  return _mm256_cmp_ps_mask(a, b, _CMP_LT_OQ);
}
GG_INLINE gg_mask gg_below_word(gg_vu a, gg_vu b)
{
  return _mm256_cmplt_epu32_mask((__m256i)a, (__m256i)b);
}
GG_INLINE gg_mask gg_same_word(gg_vu a, gg_vu b)
{
  return _mm256_cmpeq_epu32_mask((__m256i)a, (__m256i)b);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return _mm256_movepi32_mask((__m256i)(r << 31));
}
GG_INLINE gg_mask gg_and(gg_mask a, gg_mask b)
{
  return a & b;
}
GG_INLINE gg_mask gg_and_not(gg_mask a, gg_mask b)
{
  return (gg_mask)(a & ~b);
}
GG_INLINE gg_mask gg_or(gg_mask a, gg_mask b)
{
  return a | b;
}
GG_INLINE unsigned gg_bits(gg_mask m)
{
  return m;
}
GG_INLINE gg_vd gg_select(gg_mask m, gg_vd yes, gg_vd no)
{
  return _mm256_mask_blend_ps(m, no, yes);
}
/* Stores where others would blend: ports that do arithmetic are the scarce ones. */
GG_INLINE void gg_store_either(gg_real *p, gg_mask m, gg_vd yes, gg_vd no)
{
  *(gg_vd *)p = no;
  _mm256_mask_store_ps(p, m, yes);
}
GG_INLINE gg_vd gg_where(gg_mask m, gg_vd x)
{
  return _mm256_maskz_mov_ps(m, x);
}
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  return _mm256_maskz_expand_ps(m, _mm256_loadu_ps(list));
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  _mm256_storeu_ps(list, _mm256_maskz_compress_ps(m, v));
}
GG_INLINE gg_vd gg_roots_at(const float *table, gg_vu at)
{
  return _mm256_sqrt_ps(_mm256_i32gather_ps(table, (__m256i)at, 4));
}
#elif defined(GG_HAS_AVX2)
typedef gg_vi gg_mask;
typedef __m256i gg_order;
GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  return _mm256_sqrt_ps(x);
}
GG_INLINE gg_mask gg_less(gg_vd a, gg_vd b)
{
  return (gg_mask)(a < b);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return (gg_mask)(r << 31);
} /* only the sign is looked at */
GG_INLINE gg_mask gg_and(gg_mask a, gg_mask b)
{
  return a & b;
}
GG_INLINE gg_mask gg_and_not(gg_mask a, gg_mask b)
{
  return a & ~b;
}
GG_INLINE gg_mask gg_or(gg_mask a, gg_mask b)
{
  return a | b;
}
GG_INLINE unsigned gg_bits(gg_mask m)
{
  return (unsigned)_mm256_movemask_ps((gg_vd)m);
}
GG_INLINE gg_vd gg_select(gg_mask m, gg_vd yes, gg_vd no)
{
  return _mm256_blendv_ps(no, yes, (gg_vd)m);
}
GG_INLINE gg_vd gg_where(gg_mask m, gg_vd x)
{
  return (gg_vd)(m & (gg_mask)x);
}
/* Four lanes at a time: one row of four for each of sixteen masks. */
static const int gg_spread_order[16][4] __attribute__((aligned(16))) = {
#define ROW(m)                                                                                                         \
  {                                                                                                                    \
    0, (m)&1, ((m)&1) + ((m) >> 1 & 1), ((m)&1) + ((m) >> 1 & 1) + ((m) >> 2 & 1)                                      \
  }
    ROW(0), ROW(1),  ROW(2),  ROW(3),  ROW(4),  ROW(5),  ROW(6), ROW(7), ROW(8),
    ROW(9), ROW(10), ROW(11), ROW(12), ROW(13), ROW(14), ROW(15)
#undef ROW
};
static const int gg_pack_order[16][4] __attribute__((aligned(16))) = {
    {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {2, 0, 0, 0}, {0, 2, 0, 0}, {1, 2, 0, 0}, {0, 1, 2, 0},
    {3, 0, 0, 0}, {0, 3, 0, 0}, {1, 3, 0, 0}, {0, 1, 3, 0}, {2, 3, 0, 0}, {0, 2, 3, 0}, {1, 2, 3, 0}, {0, 1, 2, 3}};
GG_INLINE __m128 gg_four(__m128 v, const int order[4])
{
  return _mm_permutevar_ps(v, *(const __m128i *)order);
}
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  const unsigned bits = gg_bits(m), low = bits & 15;
  __m128 first = gg_four(_mm_loadu_ps(list), gg_spread_order[low]);
  __m128 second = gg_four(_mm_loadu_ps(list + __builtin_popcount(low)), gg_spread_order[bits >> 4]);
  return _mm256_set_m128(second, first);
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  const unsigned bits = gg_bits(m), low = bits & 15;
  _mm_storeu_ps(list, gg_four(_mm256_castps256_ps128(v), gg_pack_order[low]));
  _mm_storeu_ps(list + __builtin_popcount(low), gg_four(_mm256_extractf128_ps(v, 1), gg_pack_order[bits >> 4]));
}
GG_INLINE gg_vd gg_roots_at(const float *table, gg_vu at)
{
  return _mm256_sqrt_ps(_mm256_setr_ps(table[at[0]], table[at[1]], table[at[2]], table[at[3]], table[at[4]],
                                       table[at[5]], table[at[6]], table[at[7]]));
}
#else
typedef gg_vi gg_mask;
typedef struct gg_order {
  gg_mask pairs, halves; /* that change places */
} gg_order;
GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  return (gg_vd){__builtin_sqrtf(x[0]), __builtin_sqrtf(x[1]), __builtin_sqrtf(x[2]), __builtin_sqrtf(x[3])};
}
GG_INLINE gg_mask gg_less(gg_vd a, gg_vd b)
{
  return (gg_mask)(a < b);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return -(gg_mask)(r & 1);
}
GG_INLINE gg_mask gg_and(gg_mask a, gg_mask b)
{
  return a & b;
}
GG_INLINE gg_mask gg_and_not(gg_mask a, gg_mask b)
{
  return a & ~b;
}
GG_INLINE gg_mask gg_or(gg_mask a, gg_mask b)
{
  return a | b;
}
GG_INLINE unsigned gg_bits(gg_mask m)
{
  return (unsigned)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
}
GG_INLINE gg_vd gg_select(gg_mask m, gg_vd yes, gg_vd no)
{
  return (gg_vd)(((gg_mask)yes & m) | ((gg_mask)no & ~m));
}
GG_INLINE gg_vd gg_where(gg_mask m, gg_vd x)
{
  return (gg_vd)(m & (gg_mask)x);
}
GG_INLINE gg_order gg_order_of(gg_word r)
{
  const int pairs = (int)(r & 1), halves = (int)(r >> 1 & 1);
  return (gg_order){-(gg_mask){pairs, pairs, pairs, pairs}, -(gg_mask){halves, halves, halves, halves}};
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  v = gg_select(o.pairs, (gg_vd){v[1], v[0], v[3], v[2]}, v);
  return gg_select(o.halves, (gg_vd){v[2], v[3], v[0], v[1]}, v);
}
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  const int first = -m[0], second = first - m[1], third = second - m[2];
  return (gg_vd){list[0], list[first], list[second], list[third]};
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  for (int l = 0, at = 0; l < GG_WIDTH; l++) {
    list[at] = v[l];
    at -= m[l];
  }
}
GG_INLINE gg_vd gg_larger(gg_vd a, gg_vd b)
{
  return gg_select(gg_less(b, a), a, b);
}
GG_INLINE gg_vd gg_smaller(gg_vd a, gg_vd b)
{
  return gg_select(gg_less(a, b), a, b);
}
GG_INLINE gg_vd gg_roots_at(const float *table, gg_vu at)
{
  return gg_sqrt((gg_vd){table[at[0]], table[at[1]], table[at[2]], table[at[3]]});
}
GG_INLINE gg_v2 gg_peaks(gg_vd a, gg_vd b)
{
  gg_vd pairs = gg_larger((gg_vd){a[0], b[0], a[1], b[1]}, (gg_vd){a[2], b[2], a[3], b[3]});
  return gg_larger(pairs, (gg_vd){pairs[2], pairs[3], pairs[0], pairs[1]});
}
/* High halves of the products. */
GG_INLINE gg_vu gg_below(gg_vu r, gg_vu n)
{
  gg_vu high;
  for (int l = 0; l < GG_WIDTH; l++) high[l] = (uint32_t)((uint64_t)r[l] * n[l] >> 32);
  return high;
}
#endif

#if defined(GG_HAS_AVX512) || defined(GG_HAS_AVX2)
GG_INLINE gg_order gg_order_of(gg_word r)
{
  return _mm256_xor_si256(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32((int)r));
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return _mm256_permutevar8x32_ps(v, o);
}
GG_INLINE gg_vd gg_larger(gg_vd a, gg_vd b)
{
  return _mm256_max_ps(a, b);
}
GG_INLINE gg_vd gg_smaller(gg_vd a, gg_vd b)
{
  return _mm256_min_ps(a, b);
}
GG_INLINE gg_v2 gg_peaks(gg_vd a, gg_vd b)
{
  __m256 pairs = _mm256_max_ps(_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b)); /* of lanes 0 2, 1 3 */
  __m128 fours = _mm_max_ps(_mm256_castps256_ps128(pairs), _mm256_extractf128_ps(pairs, 1));
  return _mm_max_ps(fours, _mm_movehl_ps(fours, fours));
}
/* High halves of the products. */
GG_INLINE gg_vu gg_below(gg_vu r, gg_vu n)
{
  const __m256i factor = (__m256i)n; /* the same in all lanes */
  __m256i even = _mm256_mul_epu32((__m256i)r, factor),
          odd = _mm256_mul_epu32(_mm256_srli_epi64((__m256i)r, 32), factor);
  return (gg_vu)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
}
#endif

GG_INLINE void gg_peaks_store(gg_v2 peaks, float *one, float *two)
{
  *one = peaks[0];
  *two = peaks[1];
}

/* Two random words a lane: of the first four numbers, and the other four. */
GG_INLINE void gg_dsmc_lane_two(gg_dsmc_lane_rng *r, int part, gg_vu *a, gg_vu *b)
{
  *a = (gg_vu)gg_dsmc_lane_next(r, part);
  *b = (gg_vu)gg_dsmc_lane_next(r, part + GG_PARTS);
}

/* Uniform in [1, 2), 23 bits: the low 9 are left for other uses. */
GG_INLINE gg_vd gg_dsmc_lane_one_to_two(gg_vu r)
{
  return (gg_vd)((r >> 9) | 0x3f800000u);
}

/* Uniform in [2, 4), likewise. */
GG_INLINE gg_vd gg_dsmc_lane_two_to_four(gg_vu r)
{
  return (gg_vd)((r >> 9) | 0x40000000u);
}

/* Whole numbers below m and below n. */
GG_INLINE void gg_dsmc_lane_two_below(gg_dsmc_lane_rng *r, int part, gg_vu m, gg_vu n, gg_vu *a, gg_vu *b)
{
  gg_dsmc_lane_two(r, part, a, b);
  *a = gg_below(*a, m);
  *b = gg_below(*b, n);
}

#endif
