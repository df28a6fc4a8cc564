/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lanes: GG_WIDTH numbers in a register, up to eight. They are double, or float if GG_SINGLE_LANES is defined. Every
 * operation is lane by lane, exact or correctly rounded, and nothing is contracted, so that all processors leave the
 * same bits. A file that is compiled for a set of instructions has its registers, any other file those of the lowest
 * set. If the compiler finds the best instructions by itself, plain vector types are used.
 *
 * gg_vd, gg_vi, gg_vu: numbers, whole numbers, and words of the same width. gg_mask: one truth value a lane. */
#ifndef GG_SIMD_LANES_H
#define GG_SIMD_LANES_H

#include <stdint.h>

#include "common/vec.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define GG_HAS_AVX512
#include <immintrin.h>
#elif defined(__AVX2__)
#define GG_HAS_AVX2
#include <immintrin.h>
#endif

/* GG_MM: an intrinsic for a register of numbers. GG_MM_MASK: one that returns a mask. GG_MM_WORDS: a comparison of
 * words. */
#ifdef GG_SINGLE_LANES
typedef float gg_real;
typedef uint32_t gg_word; /* of the width of a number */
#define GG_MM(operation) _mm256_##operation##_ps
#define GG_MM_MASK(operation) _mm256_##operation##_ps_mask
#define GG_MM_WORDS(operation) _mm256_##operation##_epu32_mask
typedef int32_t gg_whole;
#if defined(GG_HAS_AVX512) || defined(GG_HAS_AVX2)
enum { GG_WIDTH = 8 };
#else
enum { GG_WIDTH = 4 };
#endif
#else
typedef double gg_real;
typedef uint64_t gg_word;
typedef int64_t gg_whole;
#if defined(GG_HAS_AVX512)
#define GG_MM(operation) _mm512_##operation##_pd
#define GG_MM_MASK(operation) _mm512_##operation##_pd_mask
#define GG_MM_WORDS(operation) _mm512_##operation##_epu64_mask
enum { GG_WIDTH = 8 };
#elif defined(GG_HAS_AVX2)
#define GG_MM(operation) _mm256_##operation##_pd
enum { GG_WIDTH = 4 };
#else
enum { GG_WIDTH = 2 };
#endif
#endif
enum { GG_REAL_BITS = 8 * sizeof(gg_real) };

typedef gg_real gg_vd __attribute__((vector_size(sizeof(gg_real) * GG_WIDTH)));
typedef gg_whole gg_vi __attribute__((vector_size(sizeof(gg_real) * GG_WIDTH)));
typedef gg_word gg_vu __attribute__((vector_size(sizeof(gg_real) * GG_WIDTH)));

#ifdef GG_HAS_AVX512
#include "simd/lanes_avx512.h"
#else
#include "simd/lanes_vector.h"
#endif

/* x in all lanes. */
GG_INLINE gg_vd gg_all(gg_real x)
{
  return x - (gg_vd){0};
}
GG_INLINE gg_vu gg_all_words(gg_word x)
{
  return x - (gg_vu){0};
}
GG_INLINE gg_vu gg_select_words(gg_mask m, gg_vu yes, gg_vu no)
{
  return (gg_vu)gg_select(m, (gg_vd)yes, (gg_vd)no);
}
GG_INLINE gg_vd gg_load(const gg_real *p)
{
  return *(const gg_vd *)p;
}
GG_INLINE void gg_store(gg_real *p, gg_vd v)
{
  *(gg_vd *)p = v;
}

/* Vectors in space, one a lane. */
typedef struct gg_vd3 {
  gg_vd x, y, z;
} gg_vd3;

#define GG_NUMBER gg_vd
#define GG_VECTOR gg_vd3
#define GG_OF(name) gg_vd3_##name
#include "common/vec_of.h"

#endif
