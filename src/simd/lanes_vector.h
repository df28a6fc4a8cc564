/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The operations of lanes.h on plain vectors, whose masks are as wide as numbers: with intrinsics for AVX2, and for any
 * processor. */
#ifndef GG_SIMD_LANES_VECTOR_H
#define GG_SIMD_LANES_VECTOR_H

typedef gg_vi gg_mask;

GG_INLINE gg_mask gg_less(gg_vd a, gg_vd b)
{
  return (gg_mask)(a < b);
}
GG_INLINE gg_mask gg_not_above(gg_vd a, gg_vd b)
{
  return (gg_mask)(a <= b);
}
GG_INLINE gg_mask gg_below_word(gg_vu a, gg_vu b)
{
  return (gg_mask)(a < b);
}
GG_INLINE gg_mask gg_same_word(gg_vu a, gg_vu b)
{
  return (gg_mask)(a == b);
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
/* x in true lanes, 0 in others. */
GG_INLINE gg_vd gg_where(gg_mask m, gg_vd x)
{
  return (gg_vd)(m & (gg_mask)x);
}

#ifdef GG_HAS_AVX2
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
/* Only the sign bits of a mask count. */
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return (gg_mask)(r << (GG_REAL_BITS - 1));
}
/* Bit l for lane l. */
GG_INLINE unsigned gg_bits(gg_mask m)
{
  return (unsigned)GG_MM(movemask)((gg_vd)m);
}
GG_INLINE gg_vd gg_select(gg_mask m, gg_vd yes, gg_vd no)
{
  return GG_MM(blendv)(no, yes, (gg_vd)m);
}

/* Permutations of four lanes for each of sixteen masks. NUMBER: place of number i, in units of 32 bits. */
#ifdef GG_SINGLE_LANES
#define NUMBER(i) i
enum { GG_ORDER_WORDS = 4 };
#else
#define NUMBER(i) 2 * (i), 2 * (i) + 1
enum { GG_ORDER_WORDS = 8 };
#endif
#define ROW(a, b, c, d)                                                                                                \
  {                                                                                                                    \
    NUMBER(a), NUMBER(b), NUMBER(c), NUMBER(d)                                                                         \
  }
static const int gg_spread_order[16][GG_ORDER_WORDS] __attribute__((aligned(4 * GG_ORDER_WORDS))) = {
    ROW(0, 0, 0, 0), ROW(0, 1, 1, 1), ROW(0, 0, 1, 1), ROW(0, 1, 2, 2), ROW(0, 0, 0, 1), ROW(0, 1, 1, 2),
    ROW(0, 0, 1, 2), ROW(0, 1, 2, 3), ROW(0, 0, 0, 0), ROW(0, 1, 1, 1), ROW(0, 0, 1, 1), ROW(0, 1, 2, 2),
    ROW(0, 0, 0, 1), ROW(0, 1, 1, 2), ROW(0, 0, 1, 2), ROW(0, 1, 2, 3)};
static const int gg_pack_order[16][GG_ORDER_WORDS] __attribute__((aligned(4 * GG_ORDER_WORDS))) = {
    ROW(0, 0, 0, 0), ROW(0, 0, 0, 0), ROW(1, 0, 0, 0), ROW(0, 1, 0, 0), ROW(2, 0, 0, 0), ROW(0, 2, 0, 0),
    ROW(1, 2, 0, 0), ROW(0, 1, 2, 0), ROW(3, 0, 0, 0), ROW(0, 3, 0, 0), ROW(1, 3, 0, 0), ROW(0, 1, 3, 0),
    ROW(2, 3, 0, 0), ROW(0, 2, 3, 0), ROW(1, 2, 3, 0), ROW(0, 1, 2, 3)};
#undef ROW
#undef NUMBER

/* gg_permute: lane l gets lane l ^ r. gg_spread loads the next numbers of a list, one for each true lane. gg_pack
 * stores the true lanes at the front of a list; up to GG_WIDTH numbers are written. */
typedef __m256i gg_order;
#ifdef GG_SINGLE_LANES
GG_INLINE gg_order gg_order_of(gg_word r)
{
  return _mm256_xor_si256(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32((int)r));
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return _mm256_permutevar8x32_ps(v, o);
}
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
#else
GG_INLINE gg_order gg_order_of(gg_word r)
{
  return _mm256_xor_si256(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32((int)(2 * (r % GG_WIDTH))));
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
  return (gg_vd)_mm256_permutevar8x32_epi32((__m256i)v, o);
}
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  return gg_permute(_mm256_loadu_pd(list), *(const __m256i *)gg_spread_order[gg_bits(m)]);
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  _mm256_storeu_pd(list, gg_permute(v, *(const __m256i *)gg_pack_order[gg_bits(m)]));
}
#endif

#else /* any processor */
GG_INLINE gg_vd gg_sqrt(gg_vd x)
{
  gg_vd root = {0};
#ifdef GG_SINGLE_LANES
  for (int l = 0; l < GG_WIDTH; l++) root[l] = __builtin_sqrtf(x[l]);
#else
  for (int l = 0; l < GG_WIDTH; l++) root[l] = __builtin_sqrt(x[l]);
#endif
  return root;
}
GG_INLINE gg_vd gg_select(gg_mask m, gg_vd yes, gg_vd no)
{
  return (gg_vd)(((gg_mask)yes & m) | ((gg_mask)no & ~m));
}
GG_INLINE gg_vd gg_larger(gg_vd a, gg_vd b)
{
  return gg_select(gg_less(b, a), a, b);
}
GG_INLINE gg_vd gg_smaller(gg_vd a, gg_vd b)
{
  return gg_select(gg_less(a, b), a, b);
}
GG_INLINE gg_mask gg_low_bit(gg_vu r)
{
  return -(gg_mask)(r & 1);
}
/* Bit l for lane l. */
GG_INLINE unsigned gg_bits(gg_mask m)
{
  unsigned bits = 0;
  for (int l = 0; l < GG_WIDTH; l++) bits |= (unsigned)m[l] & 1u << l;
  return bits;
}

/* Permutation: lane l gets lane l ^ r. One bit of r exchanges neighbours, another one exchanges halves. */
typedef struct gg_order {
  gg_mask neighbours, halves;
} gg_order;
GG_INLINE gg_order gg_order_of(gg_word r)
{
  const gg_vu bits = r - (gg_vu){0};
  return (gg_order){gg_low_bit(bits), gg_low_bit(bits >> 1)};
}
GG_INLINE gg_vd gg_permute(gg_vd v, gg_order o)
{
#ifdef GG_SINGLE_LANES
  v = gg_select(o.neighbours, (gg_vd){v[1], v[0], v[3], v[2]}, v);
  return gg_select(o.halves, (gg_vd){v[2], v[3], v[0], v[1]}, v);
#else
  return gg_select(o.neighbours, (gg_vd){v[1], v[0]}, v);
#endif
}

/* gg_spread loads the next numbers of a list, one for each true lane. gg_pack stores the true lanes at the front of a
 * list; up to GG_WIDTH numbers are written. */
GG_INLINE gg_vd gg_spread(gg_mask m, const gg_real *list)
{
  gg_vd v = {0};
  for (int l = 0, at = 0; l < GG_WIDTH; l++) {
    v[l] = list[at];
    at -= (int)m[l];
  }
  return v;
}
GG_INLINE void gg_pack(gg_real *list, gg_mask m, gg_vd v)
{
  for (int l = 0, at = 0; l < GG_WIDTH; l++) {
    list[at] = v[l];
    at -= (int)m[l];
  }
}
#endif

/* Look up entries of a table. */
GG_INLINE gg_vd gg_look_up(const gg_real *table, gg_vu at)
{
  gg_vd x = {0};
  for (int l = 0; l < GG_WIDTH; l++) x[l] = table[at[l]];
  return x;
}

GG_INLINE void gg_store_either(gg_real *p, gg_mask m, gg_vd yes, gg_vd no)
{
  *(gg_vd *)p = gg_select(m, yes, no);
}

#endif
