/* SPDX-License-Identifier: GPL-3.0-or-later */
/* xoshiro256++ in eight lanes. `gg_vq` holds the 64-bit words of eight, four or two lanes, by the width of registers.
 */
#ifndef GG_DSMC_LANE_RNG_H
#define GG_DSMC_LANE_RNG_H

#include "dsmc/kernel/pass.h"
#include "simd/lanes.h"

/* In single precision no wider than other registers: occasional use of wider registers would slow down all others. */
#if defined(GG_HAS_AVX512) && !defined(GG_SINGLE_LANES)
enum { GG_QUADS = 8 };
#elif defined(GG_HAS_AVX512) || defined(GG_HAS_AVX2)
enum { GG_QUADS = 4 };
#else
enum { GG_QUADS = 2 };
#endif

typedef uint64_t gg_vq __attribute__((vector_size(8 * GG_QUADS)));

typedef struct gg_dsmc_lane_rng {
  gg_vq s[4][GG_DSMC_LANES / GG_QUADS];
} gg_dsmc_lane_rng;

GG_INLINE gg_vq gg_dsmc_lane_rotl(gg_vq x, int k)
{
  return (x << k) | (x >> (64 - k));
}

GG_INLINE gg_vq gg_xor3(gg_vq a, gg_vq b, gg_vq c)
{
#ifdef GG_HAS_AVX512
#ifdef GG_SINGLE_LANES
  return (gg_vq)_mm256_ternarylogic_epi64((__m256i)a, (__m256i)b, (__m256i)c, 0x96);
#else
  return (gg_vq)_mm512_ternarylogic_epi64((__m512i)a, (__m512i)b, (__m512i)c, 0x96);
#endif
#else
  return a ^ b ^ c;
#endif
}

/* Next random word of each lane of a part. */
GG_INLINE gg_vq gg_dsmc_lane_next(gg_dsmc_lane_rng *rng, int part)
{
  gg_vq *s0 = &rng->s[0][part], *s1 = &rng->s[1][part], *s2 = &rng->s[2][part], *s3 = &rng->s[3][part];
  const gg_vq a = *s0, b = *s1, c = *s2, d = *s3;
  *s0 = gg_xor3(a, d, b);
  *s1 = gg_xor3(b, c, a);
  *s2 = gg_xor3(c, a, b << 17);
  *s3 = gg_dsmc_lane_rotl(d ^ b, 45);
  return gg_dsmc_lane_rotl(a + d, 23) + a;
}

GG_INLINE void gg_dsmc_lane_rng_load(gg_dsmc_lane_rng *rng, const gg_dsmc_rng_lanes *from)
{
  for (int i = 0; i < 4; i++)
    for (int part = 0; part < GG_DSMC_LANES / GG_QUADS; part++)
      __builtin_memcpy(&rng->s[i][part], &from->s[i][part * GG_QUADS], sizeof(gg_vq));
}

GG_INLINE void gg_dsmc_lane_rng_save(const gg_dsmc_lane_rng *rng, gg_dsmc_rng_lanes *to)
{
  for (int i = 0; i < 4; i++)
    for (int part = 0; part < GG_DSMC_LANES / GG_QUADS; part++)
      __builtin_memcpy(&to->s[i][part * GG_QUADS], &rng->s[i][part], sizeof(gg_vq));
}

#endif
