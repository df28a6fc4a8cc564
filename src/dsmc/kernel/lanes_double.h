/* The operations of lanes.h on doubles, 8, 4 or 2 a register. */
#ifndef GG_DSMC_LANES_DOUBLE_H
#define GG_DSMC_LANES_DOUBLE_H

#include "dsmc/kernel/lane_rng.h"

enum { GG_WIDTH = GG_QUADS, GG_PARTS = GG_DSMC_LANES / GG_WIDTH, GG_REAL_BITS = 64, GG_SPARE_BIT = 32 };
typedef double gg_real;
typedef uint64_t gg_word; /* as wide as a number */
#define GG_TINY 1e-300    /* added to what may be 0/0 */

typedef gg_dsmc_block gg_dsmc_real_block;
typedef gg_real gg_vd __attribute__((vector_size(8 * GG_WIDTH)));
typedef int64_t gg_vi __attribute__((vector_size(8 * GG_WIDTH)));
typedef gg_word gg_vu __attribute__((vector_size(8 * GG_WIDTH)));
typedef gg_real gg_v2 __attribute__((vector_size(16)));

#ifdef GG_HAS_AVX512
typedef __mmask8 gg_mask;
typedef __m512i gg_order;
GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  return _mm512_sqrt_pd(x);
}
GG_INLINE gg_mask gg_less(gg_vd a, gg_vd b)
{
  return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}
GG_INLINE gg_mask gg_below_word(gg_vu a, gg_vu b)
{
  return _mm512_cmplt_epu64_mask((__m512i)a, (__m512i)b);
}
GG_INLINE gg_mask gg_same_word(gg_vu a, gg_vu b)
{
  return _mm512_cmpeq_epu64_mask((__m512i)a, (__m512i)b);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return _mm512_movepi64_mask((__m512i)(r << 63));
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
  return _mm512_mask_blend_pd(m, no, yes);
}
/* Stores where others would blend: ports that do arithmetic are the scarce ones. */
GG_INLINE void gg_store_either(gg_real *p, gg_mask m, gg_vd yes, gg_vd no)
{
  *(gg_vd *)p = no;
  _mm512_mask_store_pd(p, m, yes);
}
GG_INLINE gg_vd gg_where(gg_mask m, gg_vd x)
{
  return _mm512_maskz_mov_pd(m, x);
}
GG_INLINE gg_order gg_order_of(gg_word r)
{
  return _mm512_xor_epi64(_mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0), _mm512_set1_epi64((long long)r));
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return _mm512_permutexvar_pd(o, v);
}
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  return _mm512_maskz_expand_pd(m, _mm512_loadu_pd(list));
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  _mm512_storeu_pd(list, _mm512_maskz_compress_pd(m, v));
}
GG_INLINE gg_vd gg_larger(gg_vd a, gg_vd b)
{
  return _mm512_max_pd(a, b);
}
GG_INLINE gg_vd gg_smaller(gg_vd a, gg_vd b)
{
  return _mm512_min_pd(a, b);
}
GG_INLINE gg_vu gg_mul32(gg_vu a, gg_vu b)
{
  return (gg_vu)_mm512_mul_epu32((__m512i)a, (__m512i)b);
}
GG_INLINE gg_vd gg_roots_at(const float *table, gg_vu at)
{
  return _mm512_cvtps_pd(_mm256_sqrt_ps(_mm512_i64gather_ps((__m512i)at, table, 4)));
}
GG_INLINE gg_v2 gg_peaks(gg_vd a, gg_vd b)
{
  __m512d pairs = _mm512_max_pd(_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
  __m256d half = _mm256_max_pd(_mm512_castpd512_pd256(pairs), _mm512_extractf64x4_pd(pairs, 1));
  return _mm_max_pd(_mm256_castpd256_pd128(half), _mm256_extractf128_pd(half, 1));
}
#elif defined(GG_HAS_AVX2)
typedef gg_vi gg_mask;
typedef __m256i gg_order;
GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  return _mm256_sqrt_pd(x);
}
GG_INLINE gg_mask gg_less(gg_vd a, gg_vd b)
{
  return (gg_mask)(a < b);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return (gg_mask)(r << 63);
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
  return (unsigned)_mm256_movemask_pd((gg_vd)m);
}
GG_INLINE gg_vd gg_select(gg_mask m, gg_vd yes, gg_vd no)
{
  return _mm256_blendv_pd(no, yes, (gg_vd)m);
}
GG_INLINE gg_vd gg_where(gg_mask m, gg_vd x)
{
  return (gg_vd)(m & (gg_mask)x);
}
GG_INLINE gg_order gg_order_of(gg_word r)
{
  return _mm256_xor_si256(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32((int)(2 * (r % GG_WIDTH))));
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return (gg_vd)_mm256_permutevar8x32_epi32((__m256i)v, o);
}
static const int gg_spread_order[16][8] __attribute__((aligned(32))) = {
#define R(i) 2 * (i), 2 * (i) + 1
#define ROW(m)                                                                                                         \
  {                                                                                                                    \
    R(0), R((m)&1), R(((m)&1) + ((m) >> 1 & 1)), R(((m)&1) + ((m) >> 1 & 1) + ((m) >> 2 & 1))                          \
  }
    ROW(0), ROW(1),  ROW(2),  ROW(3),  ROW(4),  ROW(5),  ROW(6), ROW(7), ROW(8),
    ROW(9), ROW(10), ROW(11), ROW(12), ROW(13), ROW(14), ROW(15)
#undef ROW
#undef R
};
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  return gg_permute(_mm256_loadu_pd(list), *(const __m256i *)gg_spread_order[gg_bits(m)]);
}
static const int gg_pack_order[16][8] __attribute__((aligned(32))) = {
#define R(i) 2 * (i), 2 * (i) + 1
#define ROW(a, b, c, d)                                                                                                \
  {                                                                                                                    \
    R(a), R(b), R(c), R(d)                                                                                             \
  }
    ROW(0, 0, 0, 0), ROW(0, 0, 0, 0), ROW(1, 0, 0, 0), ROW(0, 1, 0, 0), ROW(2, 0, 0, 0), ROW(0, 2, 0, 0),
    ROW(1, 2, 0, 0), ROW(0, 1, 2, 0), ROW(3, 0, 0, 0), ROW(0, 3, 0, 0), ROW(1, 3, 0, 0), ROW(0, 1, 3, 0),
    ROW(2, 3, 0, 0), ROW(0, 2, 3, 0), ROW(1, 2, 3, 0), ROW(0, 1, 2, 3),
#undef ROW
#undef R
};
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  _mm256_storeu_pd(list, gg_permute(v, *(const __m256i *)gg_pack_order[gg_bits(m)]));
}
GG_INLINE gg_vd gg_larger(gg_vd a, gg_vd b)
{
  return _mm256_max_pd(a, b);
}
GG_INLINE gg_vd gg_smaller(gg_vd a, gg_vd b)
{
  return _mm256_min_pd(a, b);
}
GG_INLINE gg_vu gg_mul32(gg_vu a, gg_vu b)
{
  return (gg_vu)_mm256_mul_epu32((__m256i)a, (__m256i)b);
}
GG_INLINE gg_vd gg_roots_at(const float *table, gg_vu at)
{
  return _mm256_cvtps_pd(_mm_sqrt_ps(_mm_setr_ps(table[at[0]], table[at[1]], table[at[2]], table[at[3]])));
}
GG_INLINE gg_v2 gg_peaks(gg_vd a, gg_vd b)
{
  __m256d pairs = _mm256_max_pd(_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
  return _mm_max_pd(_mm256_castpd256_pd128(pairs), _mm256_extractf128_pd(pairs, 1));
}
#else
typedef gg_vi gg_mask;
typedef gg_vi gg_order;
GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  return (gg_vd){__builtin_sqrt(x[0]), __builtin_sqrt(x[1])};
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
  return (unsigned)((m[0] & 1) | (m[1] & 2));
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
  return -(gg_order){(int64_t)(r & 1), (int64_t)(r & 1)};
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return gg_select(o, (gg_vd){v[1], v[0]}, v);
}
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  return (gg_vd){list[0], list[m[0] & 1]};
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  list[0] = m[0] ? v[0] : v[1];
  list[1] = v[1];
}
GG_INLINE gg_vd gg_larger(gg_vd a, gg_vd b)
{
  return gg_select(gg_less(b, a), a, b);
}
GG_INLINE gg_vd gg_smaller(gg_vd a, gg_vd b)
{
  return gg_select(gg_less(a, b), a, b);
}
GG_INLINE gg_vu gg_mul32(gg_vu a, gg_vu b)
{
  return (a & UINT32_MAX) * (b & UINT32_MAX);
}
GG_INLINE gg_vd gg_roots_at(const float *table, gg_vu at)
{
  return (gg_vd){sqrtf(table[at[0]]), sqrtf(table[at[1]])};
}
GG_INLINE gg_v2 gg_peaks(gg_vd a, gg_vd b)
{
  return gg_larger((gg_v2){a[0], b[0]}, (gg_v2){a[1], b[1]});
}
#endif

/* Both peaks, in single precision. */
GG_INLINE void gg_peaks_store(gg_v2 peaks, float *one, float *two)
{
  typedef float gg_f2 __attribute__((vector_size(8)));
  gg_f2 rounded = __builtin_convertvector(peaks, gg_f2);
  *one = rounded[0];
  *two = rounded[1];
}

/* Two random words a lane, good for 32 bits at least; the low half of the first is the second. */
GG_INLINE void gg_dsmc_lane_two(gg_dsmc_lane_rng *r, int part, gg_vu *a, gg_vu *b)
{
  *a = gg_dsmc_lane_next(r, part);
  *b = *a << 32;
}

/* Uniform in [1, 2), 52 bits: the low 12 are left for other uses. */
GG_INLINE gg_vd gg_dsmc_lane_one_to_two(gg_vu r)
{
  return (gg_vd)((r >> 12) | 0x3ff0000000000000u);
}

/* Uniform in [2, 4), likewise. */
GG_INLINE gg_vd gg_dsmc_lane_two_to_four(gg_vu r)
{
  return (gg_vd)((r >> 12) | 0x4000000000000000u);
}

/* Whole numbers below m and below n < 2^32. */
GG_INLINE void gg_dsmc_lane_two_below(gg_dsmc_lane_rng *r, int part, gg_vu m, gg_vu n, gg_vu *a, gg_vu *b)
{
  gg_vu bits = gg_dsmc_lane_next(r, part);
  *a = gg_mul32(bits >> 32, m) >> 32;
  *b = gg_mul32(bits, n) >> 32;
}

/* Numbers kept in single precision: read, and rounded; what is there then. */
typedef float gg_vf __attribute__((vector_size(4 * GG_WIDTH), aligned(4 * GG_WIDTH)));
GG_INLINE gg_vd gg_load_single(const float *p)
{
  return __builtin_convertvector(*(const gg_vf *)p, gg_vd);
}
GG_INLINE gg_vd gg_store_single(float *p, gg_vd v)
{
  gg_vf rounded = __builtin_convertvector(v, gg_vf);
  *(gg_vf *)p = rounded;
  return __builtin_convertvector(rounded, gg_vd);
}

#endif
