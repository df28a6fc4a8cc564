/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A batch: as many numbers as a register has lanes (lanes.h), with the operations that the search for the earliest of
 * many contacts needs. gcc makes slow code of vectors that are wider than a register, so batches never are. Each lane
 * has the operations of a single number, so that all processors leave the same bits. Double precision. */
#ifndef GG_SIMD_BATCH_H
#define GG_SIMD_BATCH_H

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "simd/lanes.h"

enum { GG_LOOK_UP = 16 };

/* Words of a list, one a lane. */
typedef uint32_t gg_list __attribute__((vector_size(4 * GG_WIDTH), may_alias, aligned(4)));

/* Number of each lane. */
GG_INLINE gg_vi gg_batch_places(void)
{
  gg_vi place = {0};
  for (int l = 0; l < GG_WIDTH; l++) place[l] = l;
  return place;
}

GG_INLINE bool gg_any(gg_mask mask)
{
  return gg_bits(mask) != 0;
}

/* table[lowest four bits]; sixteen numbers must be readable. */
GG_INLINE gg_vd gg_batch_look_up(const double *table, gg_vd bits)
{
#ifdef GG_HAS_AVX512
  return _mm512_permutex2var_pd(_mm512_loadu_pd(table), (__m512i)bits, _mm512_loadu_pd(table + 8));
#else
  return gg_look_up(table, (gg_vu)bits & (GG_LOOK_UP - 1));
#endif
}

/* Nearest integers, ties to even, like gg_nearest. */
GG_INLINE gg_vd gg_batch_nearest(gg_vd x)
{
  gg_vd shift = gg_all(0x1.8p52);
  return (x + shift) - shift;
}

/* Fold into the nearest image. The product of an edge and a small whole number is exact, fused or not. The whole number
 * can depend on fusing only within a rounding of half an edge, where both images are equally far: no pair in
 * neighbouring cells or lists is there. */
GG_INLINE gg_vd gg_batch_fold(gg_vd x, double edge, double inverse)
{
#ifdef GG_HAS_AVX512
  gg_vd shift = gg_all(0x1.8p52);
  gg_vd whole = _mm512_fmadd_pd(x, gg_all(inverse), shift) - shift;
  return _mm512_fnmadd_pd(whole, gg_all(edge), x);
#else
  return x - edge * gg_batch_nearest(x * inverse);
#endif
}

/* Each lane with another: SWAP(x, 1) exchanges neighbours, SWAP(x, 2) pairs, SWAP(x, 4) halves of eight. */
#if defined(GG_HAS_AVX512)
#define SWAP(x, by) __builtin_shufflevector(x, x, by, 1 ^ by, 2 ^ by, 3 ^ by, 4 ^ by, 5 ^ by, 6 ^ by, 7 ^ by)
#elif defined(GG_HAS_AVX2)
#define SWAP(x, by) __builtin_shufflevector(x, x, by & 3, (1 ^ by) & 3, (2 ^ by) & 3, (3 ^ by) & 3)
#else
#define SWAP(x, by) __builtin_shufflevector(x, x, by & 1, (1 ^ by) & 1)
#endif
/* The smallest and the largest lane, in all lanes. */
#define GG_EXTREME(name, of_two)                                                                                       \
  GG_INLINE gg_vd name(gg_vd x)                                                                                        \
  {                                                                                                                    \
    if (GG_WIDTH > 4) x = of_two(x, SWAP(x, 4));                                                                       \
    if (GG_WIDTH > 2) x = of_two(x, SWAP(x, 2));                                                                       \
    return of_two(x, SWAP(x, 1));                                                                                      \
  }
GG_EXTREME(gg_batch_least, gg_smaller)
GG_EXTREME(gg_batch_greatest, gg_larger)
#undef GG_EXTREME
#undef SWAP

/* The earliest of a batch of times, and its partner; of equal times the smallest partner. */
GG_INLINE double gg_batch_earliest(gg_vd t, gg_vi who, int64_t *partner)
{
  gg_vd m = gg_batch_least(t);
#ifdef GG_HAS_AVX512
  *partner = _mm512_mask_reduce_min_epi64(gg_not_above(t, m), (__m512i)who);
#else
  int64_t first = INT64_MAX;
  for (int l = 0; l < GG_WIDTH; l++) first = t[l] == m[0] && who[l] < first ? who[l] : first;
  *partner = first;
#endif
  return m[0];
}

/* Pack the words of the mask, except `but`; a whole batch is written. Returns their number. */
GG_INLINE uint32_t gg_batch_pick(uint32_t *to, const uint32_t *from, uint32_t but, gg_mask mask)
{
#ifdef GG_HAS_AVX512
  __m256i all = _mm256_loadu_si256((const __m256i *)from);
  mask &= _mm256_cmpneq_epi32_mask(all, _mm256_set1_epi32((int)but));
  _mm256_storeu_si256((__m256i *)to, _mm256_maskz_compress_epi32(mask, all));
  return (uint32_t)__builtin_popcount(mask);
#else
  const uint32_t bits = gg_bits(mask);
  uint32_t count = 0;
  for (int l = 0; l < GG_WIDTH; l++) {
    to[count] = from[l];
    count += (bits >> l & 1) & (from[l] != but);
  }
  return count;
#endif
}

/* A row of numbers in a record, which may have members of other types. */
typedef double gg_row __attribute__((may_alias));

/* Transpose rows of four numbers, one a lane, into columns. */
GG_INLINE void gg_batch_columns(const gg_row *const row[GG_WIDTH], gg_vd column[4])
{
#if defined(GG_HAS_AVX512)
  /* A load puts two rows side by side, which saves a shuffle: the processor has one unit for shuffles. */
#define TWO(k, m) _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(row[k])), _mm256_loadu_pd(row[m]), 1)
  gg_vd a = TWO(0, 4), b = TWO(1, 5), c = TWO(2, 6), d = TWO(3, 7);
#undef TWO
#define EVEN(p, q) __builtin_shufflevector(p, q, 0, 8, 2, 10, 4, 12, 6, 14)
#define ODD(p, q) __builtin_shufflevector(p, q, 1, 9, 3, 11, 5, 13, 7, 15)
#define LOWER(p, q) __builtin_shufflevector(p, q, 0, 1, 8, 9, 4, 5, 12, 13)
#define UPPER(p, q) __builtin_shufflevector(p, q, 2, 3, 10, 11, 6, 7, 14, 15)
#elif defined(GG_HAS_AVX2)
  gg_vd a = _mm256_loadu_pd(row[0]), b = _mm256_loadu_pd(row[1]), c = _mm256_loadu_pd(row[2]),
        d = _mm256_loadu_pd(row[3]);
#define EVEN(p, q) __builtin_shufflevector(p, q, 0, 4, 2, 6)
#define ODD(p, q) __builtin_shufflevector(p, q, 1, 5, 3, 7)
#define LOWER(p, q) __builtin_shufflevector(p, q, 0, 1, 4, 5)
#define UPPER(p, q) __builtin_shufflevector(p, q, 2, 3, 6, 7)
#endif
#if defined(GG_HAS_AVX512) || defined(GG_HAS_AVX2)
  gg_vd ab0 = EVEN(a, b), ab1 = ODD(a, b), cd0 = EVEN(c, d), cd1 = ODD(c, d);
  column[0] = LOWER(ab0, cd0);
  column[1] = LOWER(ab1, cd1);
  column[2] = UPPER(ab0, cd0);
  column[3] = UPPER(ab1, cd1);
#undef EVEN
#undef ODD
#undef LOWER
#undef UPPER
#else
  for (int k = 0; k < 4; k++) column[k] = (gg_vd){row[0][k], row[1][k]};
#endif
}

/* Approximations of 1/sqrt(x) and 1/x for x > 0, by special instructions or from the bits of the exponent. They only
 * select the numbers that are computed exactly; no result depends on them. */
GG_INLINE gg_vd gg_about_inverse_root(gg_vd x)
{
#ifdef GG_HAS_AVX512
  return _mm512_rsqrt14_pd(x);
#else
  gg_vd y = (gg_vd)(0x5fe6eb50c7b537a9 - (gg_vi)((gg_vu)x >> 1));
  y *= 1.5 - 0.5 * x * y * y;
  return y * (1.5 - 0.5 * x * y * y);
#endif
}
GG_INLINE gg_vd gg_about_inverse(gg_vd x)
{
#ifdef GG_HAS_AVX512
  return _mm512_rcp14_pd(x);
#else
  gg_vd y = (gg_vd)(0x7fde623822fc16e6 - (gg_vi)x);
  y *= 2 - x * y;
  return y * (2 - x * y);
#endif
}

/* Label a number by a whole number below GG_PLACES in its last bits: the largest of many numbers then identifies its
 * place. */
enum { GG_PLACES = 4096 };
GG_INLINE gg_vd gg_batch_label(gg_vd t, gg_vi place)
{
  return (gg_vd)(((gg_vi)t & -(int64_t)GG_PLACES) | place);
}
GG_INLINE uint32_t gg_label_of(double t)
{
  uint64_t bits;
  memcpy(&bits, &t, sizeof bits);
  return bits % GG_PLACES;
}

#endif
