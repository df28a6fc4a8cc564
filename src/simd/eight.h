/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Operations on eight doubles: plain vector types of a fixed width, which the compiler maps to the registers of the
 * processor. For the event-driven engine, whose batches have eight grains on every processor; lanes.h, for the Monte
 * Carlo engine, has as many lanes as a register. Each element has the operations of a single number, so that all
 * processors leave the same bits. */
#ifndef GG_SIMD_EIGHT_H
#define GG_SIMD_EIGHT_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "common/vec.h"

typedef double gg_v8 __attribute__((vector_size(64)));
typedef int64_t gg_m8 __attribute__((vector_size(64)));
typedef uint64_t gg_u8 __attribute__((vector_size(64)));
#if defined(__AVX512F__)
typedef __mmask8 gg_k8; /* mask of eight lanes */
#else
typedef gg_m8 gg_k8;
#endif
typedef double gg_line __attribute__((vector_size(64), may_alias));

enum { GG_BATCH = 8, GG_LOOK_UP = 16 };
typedef uint32_t gg_list8 __attribute__((vector_size(32), may_alias, aligned(4)));

GG_INLINE gg_v8 gg_all8(double x)
{
  return (gg_v8){x, x, x, x, x, x, x, x};
}

/* Comparisons, choices and bounds by lane. With intrinsics for registers of 512 bits, whose masks the compiler does not
 * use by itself. */
#if defined(__AVX512F__)
#define GG_COMPARE8(name, predicate)                                                                                   \
  GG_INLINE gg_k8 name(gg_v8 x, gg_v8 y)                                                                               \
  {                                                                                                                    \
    return _mm512_cmp_pd_mask((__m512d)x, (__m512d)y, predicate);                                                      \
  }
GG_COMPARE8(gg_less8, _CMP_LT_OQ)
GG_COMPARE8(gg_not_above8, _CMP_LE_OQ)
GG_INLINE gg_v8 gg_choose8(gg_k8 mask, gg_v8 yes, gg_v8 no)
{
  return (gg_v8)_mm512_mask_mov_pd((__m512d)no, mask, (__m512d)yes);
}
GG_INLINE gg_k8 gg_odd8(gg_v8 bits)
{
  return _mm512_test_epi64_mask((__m512i)bits, _mm512_set1_epi64(1));
}
/* Look up table[lowest four bits]; sixteen numbers must be readable. */
GG_INLINE gg_v8 gg_look_up8(const double *table, gg_v8 bits)
{
  return (gg_v8)_mm512_permutex2var_pd(_mm512_loadu_pd(table), (__m512i)bits, _mm512_loadu_pd(table + 8));
}
GG_INLINE gg_v8 gg_smaller8(gg_v8 x, gg_v8 y)
{
  return (gg_v8)_mm512_min_pd((__m512d)x, (__m512d)y);
}
GG_INLINE gg_v8 gg_larger8(gg_v8 x, gg_v8 y)
{
  return (gg_v8)_mm512_max_pd((__m512d)x, (__m512d)y);
}
GG_INLINE bool gg_any8(gg_k8 mask)
{
  return mask != 0;
}
GG_INLINE uint32_t gg_lanes8(gg_k8 mask)
{
  return mask;
}
GG_INLINE gg_v8 gg_sqrt8(gg_v8 x)
{
  return (gg_v8)_mm512_sqrt_pd((__m512d)x);
}
#else
GG_INLINE gg_k8 gg_less8(gg_v8 x, gg_v8 y)
{
  return x < y;
}
GG_INLINE gg_k8 gg_not_above8(gg_v8 x, gg_v8 y)
{
  return x <= y;
}
GG_INLINE gg_v8 gg_choose8(gg_k8 mask, gg_v8 yes, gg_v8 no)
{
  return (gg_v8)(((gg_m8)yes & mask) | ((gg_m8)no & ~mask));
}
GG_INLINE gg_k8 gg_odd8(gg_v8 bits)
{
  return -((gg_m8)bits & 1);
}
GG_INLINE gg_v8 gg_look_up8(const double *table, gg_v8 bits)
{
  gg_v8 found;
  for (int l = 0; l < GG_BATCH; l++) found[l] = table[((gg_m8)bits)[l] & (GG_LOOK_UP - 1)];
  return found;
}
GG_INLINE gg_v8 gg_smaller8(gg_v8 x, gg_v8 y)
{
  return gg_choose8(x < y, x, y);
}
GG_INLINE gg_v8 gg_larger8(gg_v8 x, gg_v8 y)
{
  return gg_choose8(x > y, x, y);
}
GG_INLINE bool gg_any8(gg_k8 mask)
{
  gg_m8 or = mask | __builtin_shufflevector(mask, mask, 4, 5, 6, 7, 0, 1, 2, 3);
  or |= __builtin_shufflevector(or, or, 2, 3, 0, 1, 6, 7, 4, 5);
  return or [0] | or [1];
}
/* Mask as bits, one a lane. */
GG_INLINE uint32_t gg_lanes8(gg_k8 mask)
{
  uint32_t lanes = 0;
  for (int l = 0; l < GG_BATCH; l++) lanes |= (uint32_t)(mask[l] & 1) << l;
  return lanes;
}
GG_INLINE gg_v8 gg_sqrt8(gg_v8 x)
{
  gg_v8 root;
  for (int l = 0; l < GG_BATCH; l++) root[l] = sqrt(x[l]);
  return root;
}
#endif

/* Nearest integers, ties to even, like gg_nearest. */
GG_INLINE gg_v8 gg_nearest8(gg_v8 x)
{
  gg_v8 shift = gg_all8(0x1.8p52);
  return (x + shift) - shift;
}

/* Fold into the nearest image. The product of an edge and a small whole number is exact, fused or not. The whole number
 * can depend on fusing only within a rounding of half an edge, where both images are equally far: no pair in
 * neighbouring cells or lists is there. */
GG_INLINE gg_v8 gg_fold8(gg_v8 x, double edge, double inverse)
{
#if defined(__AVX512F__)
  gg_v8 shift = gg_all8(0x1.8p52);
  gg_v8 whole = (gg_v8)_mm512_fmadd_pd((__m512d)x, (__m512d)gg_all8(inverse), (__m512d)shift) - shift;
  return (gg_v8)_mm512_fnmadd_pd((__m512d)whole, (__m512d)gg_all8(edge), (__m512d)x);
#else
  return x - edge * gg_nearest8(x * inverse);
#endif
}

/* The smallest and the largest of eight, in all lanes. */
#define FOLD(v, a, b, c, d, e, f, g, h) __builtin_shufflevector(v, v, a, b, c, d, e, f, g, h)
GG_INLINE gg_v8 gg_least8(gg_v8 x)
{
  x = gg_smaller8(x, FOLD(x, 4, 5, 6, 7, 0, 1, 2, 3));
  x = gg_smaller8(x, FOLD(x, 2, 3, 0, 1, 6, 7, 4, 5));
  return gg_smaller8(x, FOLD(x, 1, 0, 3, 2, 5, 4, 7, 6));
}
GG_INLINE gg_v8 gg_greatest8(gg_v8 x)
{
  x = gg_larger8(x, FOLD(x, 4, 5, 6, 7, 0, 1, 2, 3));
  x = gg_larger8(x, FOLD(x, 2, 3, 0, 1, 6, 7, 4, 5));
  return gg_larger8(x, FOLD(x, 1, 0, 3, 2, 5, 4, 7, 6));
}
#undef FOLD

/* The earliest of eight times, and its partner; of equal times the smallest partner. */
GG_INLINE double gg_earliest8(gg_v8 t, gg_m8 who, int64_t *partner)
{
  gg_v8 m = gg_least8(t);
#if defined(__AVX512F__)
  *partner = _mm512_mask_reduce_min_epi64(gg_not_above8(t, m), (__m512i)who);
#else
  int64_t first = INT64_MAX;
  for (int l = 0; l < GG_BATCH; l++) first = t[l] == m[0] && who[l] < first ? who[l] : first;
  *partner = first;
#endif
  return m[0];
}

/* Pack the words of the mask, except `but`; eight words are written. Returns their number. */
GG_INLINE uint32_t gg_pick8(uint32_t *to, const uint32_t *from, uint32_t but, gg_k8 mask)
{
#if defined(__AVX512F__) && defined(__AVX512VL__)
  __m256i all = _mm256_loadu_si256((const __m256i *)from);
  mask &= _mm256_cmpneq_epi32_mask(all, _mm256_set1_epi32((int)but));
  _mm256_storeu_si256((__m256i *)to, _mm256_maskz_compress_epi32(mask, all));
  return (uint32_t)__builtin_popcount(mask);
#else
  uint32_t count = 0;
  for (int l = 0; l < GG_BATCH; l++) {
    to[count] = from[l];
    count += (gg_lanes8(mask) >> l & 1) & (from[l] != but);
  }
  return count;
#endif
}

/* Half a record. */
typedef double gg_half __attribute__((vector_size(32), may_alias));

/* Load two halves side by side: the loads do a part of the transposition, for which the processor has only one shuffle
 * unit. */
GG_INLINE gg_v8 gg_side_by_side(const gg_half *one, const gg_half *two)
{
#if defined(__AVX512F__)
  return (gg_v8)_mm512_insertf64x4(_mm512_castpd256_pd512((__m256d)*one), (__m256d)*two, 1);
#else
  return __builtin_shufflevector(*one, *two, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

/* Transpose eight rows of four into columns. */
GG_INLINE void gg_columns(const gg_half *const row[GG_BATCH], gg_v8 column[4])
{
#define TWO(k, m) gg_side_by_side(row[k], row[m])
  gg_v8 a = TWO(0, 4), b = TWO(1, 5), c = TWO(2, 6), d = TWO(3, 7);
#undef TWO
#define EVEN(p, q) __builtin_shufflevector(p, q, 0, 8, 2, 10, 4, 12, 6, 14)
#define ODD(p, q) __builtin_shufflevector(p, q, 1, 9, 3, 11, 5, 13, 7, 15)
#define PAIR0(p, q) __builtin_shufflevector(p, q, 0, 1, 8, 9, 4, 5, 12, 13)
#define PAIR1(p, q) __builtin_shufflevector(p, q, 2, 3, 10, 11, 6, 7, 14, 15)
  gg_v8 ab0 = EVEN(a, b), ab1 = ODD(a, b), cd0 = EVEN(c, d), cd1 = ODD(c, d);
  column[0] = PAIR0(ab0, cd0);
  column[1] = PAIR0(ab1, cd1);
  column[2] = PAIR1(ab0, cd0);
  column[3] = PAIR1(ab1, cd1);
#undef EVEN
#undef ODD
#undef PAIR0
#undef PAIR1
}

/* Approximations of 1/sqrt(x) and 1/x for x > 0, by special instructions or from the bits of the exponent. They only
 * select the numbers that are computed exactly; no result depends on them. */
GG_INLINE gg_v8 gg_about_inverse_root8(gg_v8 x)
{
#if defined(__AVX512F__)
  return (gg_v8)_mm512_rsqrt14_pd((__m512d)x);
#else
  gg_v8 y = (gg_v8)(0x5fe6eb50c7b537a9 - (gg_m8)((gg_u8)x >> 1));
  y *= 1.5 - 0.5 * x * y * y;
  return y * (1.5 - 0.5 * x * y * y);
#endif
}
GG_INLINE gg_v8 gg_about_inverse8(gg_v8 x)
{
#if defined(__AVX512F__)
  return (gg_v8)_mm512_rcp14_pd((__m512d)x);
#else
  gg_v8 y = (gg_v8)(0x7fde623822fc16e6 - (gg_m8)x);
  y *= 2 - x * y;
  y *= 2 - x * y;
  return y * (2 - x * y);
#endif
}

/* Label a number by a whole number below GG_PLACES in its last bits: the largest of many numbers then identifies its
 * place. */
enum { GG_PLACES = 4096 };
GG_INLINE gg_v8 gg_label8(gg_v8 t, gg_m8 place)
{
  return (gg_v8)(((gg_m8)t & -(int64_t)GG_PLACES) | place);
}
GG_INLINE uint32_t gg_label_of(double t)
{
  uint64_t bits;
  memcpy(&bits, &t, sizeof bits);
  return bits % GG_PLACES;
}

#endif
