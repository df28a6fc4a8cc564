/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparison of many words with one: a bit is set for each equal word. */
#ifndef GG_SIMD_WORDS_H
#define GG_SIMD_WORDS_H

#include <stdint.h>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "common/vec.h"

#if defined(__AVX512VL__)
/* Convert a mask to a word through a register. Otherwise gcc 12 may store 16 bits of a mask and load 32, half of them
 * stale memory, as seen under sanitizers. */
GG_INLINE uint32_t gg_word_of_mask(uint16_t mask)
{
  __asm__("" : "+r"(mask));
  return mask;
}
#endif

GG_INLINE uint32_t gg_words_equal4(const uint32_t *words, uint32_t one)
{
#if defined(__AVX2__)
  __m128i equal = _mm_cmpeq_epi32(_mm_loadu_si128((const __m128i *)words), _mm_set1_epi32((int)one));
  return (uint32_t)_mm_movemask_ps(_mm_castsi128_ps(equal));
#else
  uint32_t equal = 0;
  for (int k = 0; k < 4; k++) equal |= (uint32_t)(words[k] == one) << k;
  return equal;
#endif
}

GG_INLINE uint32_t gg_words_equal8(const uint32_t *words, uint32_t one)
{
#if defined(__AVX512VL__)
  return gg_word_of_mask(
      _mm256_cmpeq_epi32_mask(_mm256_loadu_si256((const __m256i *)words), _mm256_set1_epi32((int)one)));
#elif defined(__AVX2__)
  __m256i equal = _mm256_cmpeq_epi32(_mm256_loadu_si256((const __m256i *)words), _mm256_set1_epi32((int)one));
  return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(equal));
#else
  uint32_t equal = 0;
  for (int k = 0; k < 8; k++) equal |= (uint32_t)(words[k] == one) << k;
  return equal;
#endif
}

GG_INLINE uint32_t gg_words_equal16(const uint32_t *words, uint32_t one)
{
#if defined(__AVX512VL__)
  return gg_word_of_mask(_mm512_cmpeq_epi32_mask(_mm512_loadu_si512(words), _mm512_set1_epi32((int)one)));
#else
  return gg_words_equal8(words, one) | gg_words_equal8(words + 8, one) << 8;
#endif
}

/* The lowest n bits; n < 32. */
GG_INLINE uint32_t gg_lowest_bits(uint32_t n)
{
  return (1u << n) - 1;
}

#endif
