/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The operations of lanes.h with masks of one bit a lane, eight lanes in either precision. */
#ifndef GG_SIMD_LANES_AVX512_H
#define GG_SIMD_LANES_AVX512_H

typedef __mmask8 gg_mask;

GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  return GG_MM(sqrt)(x);
}
GG_INLINE gg_vd gg_larger(gg_vd a, gg_vd b)
{
  return GG_MM(max)(a, b);
}
GG_INLINE gg_vd gg_smaller(gg_vd a, gg_vd b)
{
  return GG_MM(min)(a, b);
}

GG_INLINE gg_mask gg_less(gg_vd a, gg_vd b)
{
  return GG_MM_MASK(cmp)(a, b, _CMP_LT_OQ);
}
GG_INLINE gg_mask gg_not_above(gg_vd a, gg_vd b)
{
  return GG_MM_MASK(cmp)(a, b, _CMP_LE_OQ);
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
/* Bit l for lane l. */
GG_INLINE unsigned gg_bits(gg_mask m)
{
  return m;
}

GG_INLINE gg_vd gg_select(gg_mask m, gg_vd yes, gg_vd no)
{
  return GG_MM(mask_blend)(m, no, yes);
}
/* x in true lanes, 0 in others. */
GG_INLINE gg_vd gg_where(gg_mask m, gg_vd x)
{
  return GG_MM(maskz_mov)(m, x);
}
/* Select by a second, masked store instead of a blend: arithmetic ports are scarce. */
GG_INLINE void gg_store_either(gg_real *p, gg_mask m, gg_vd yes, gg_vd no)
{
  *(gg_vd *)p = no;
  GG_MM(mask_store)(p, m, yes);
}

/* gg_spread loads the next numbers of a list, one for each true lane. gg_pack stores the true lanes at the front of a
 * list; up to GG_WIDTH numbers are written. */
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  return GG_MM(maskz_expand)(m, GG_MM(loadu)(list));
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  GG_MM(storeu)(list, GG_MM(maskz_compress)(m, v));
}

/* Look up entries of a table. */
GG_INLINE gg_vd gg_look_up(const gg_real *table, gg_vu at)
{
#ifdef GG_SINGLE_LANES
  return _mm256_i32gather_ps(table, (__m256i)at, 4);
#else
  return _mm512_i64gather_pd((__m512i)at, table, 8);
#endif
}

/* Permutation: lane l gets lane l ^ r; only the low bits of r count. */
#ifdef GG_SINGLE_LANES
typedef __m256i gg_order;
GG_INLINE gg_order gg_order_of(gg_word r)
{
  return _mm256_xor_si256(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32((int)r));
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return _mm256_permutevar8x32_ps(v, o);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return _mm256_movepi32_mask((__m256i)(r << 31));
}
GG_INLINE gg_mask gg_below_word(gg_vu a, gg_vu b)
{
  return _mm256_cmplt_epu32_mask((__m256i)a, (__m256i)b);
}
GG_INLINE gg_mask gg_same_word(gg_vu a, gg_vu b)
{
  return _mm256_cmpeq_epu32_mask((__m256i)a, (__m256i)b);
}
#else
typedef __m512i gg_order;
GG_INLINE gg_order gg_order_of(gg_word r)
{
  return _mm512_xor_epi64(_mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0), _mm512_set1_epi64((long long)r));
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return _mm512_permutexvar_pd(o, v);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return _mm512_movepi64_mask((__m512i)(r << 63));
}
GG_INLINE gg_mask gg_below_word(gg_vu a, gg_vu b)
{
  return _mm512_cmplt_epu64_mask((__m512i)a, (__m512i)b);
}
GG_INLINE gg_mask gg_same_word(gg_vu a, gg_vu b)
{
  return _mm512_cmpeq_epu64_mask((__m512i)a, (__m512i)b);
}
#endif

#endif
