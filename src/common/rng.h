/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random streams: xoshiro256++ (Blackman & Vigna 2021) in the hot loops, seeded through the counter-based Philox of
 * Random123 (Salmon et al. 2011), so that (seed, stream) names an independent stream for every replica and every lane.
 * The state is plain data: copied into checkpoints as it is. */
#ifndef GG_RNG_H
#define GG_RNG_H

#include <stdint.h>

#include "common/vec.h"

typedef struct gg_rng {
  uint64_t s[4];
} gg_rng;

/* Numbers of the streams that one run draws from; a replica adds its index times GG_STREAMS_PER_REPLICA. */
enum {
  GG_STREAM_START = 0,
  GG_STREAM_ENGINE = 1,
  GG_STREAM_PLACES = 2, /* and the next */
  GG_STREAM_LANES = 16,
  GG_STREAM_SEGMENTS = 32,
  GG_STREAMS_PER_REPLICA = 1024
};

gg_rng gg_common_rng_seed(uint64_t seed, uint64_t stream);

GG_INLINE uint64_t gg_rotl(uint64_t x, int k)
{
  return (x << k) | (x >> (64 - k));
}

GG_INLINE uint64_t gg_rng_next(gg_rng *r)
{
  uint64_t *s = r->s, result = gg_rotl(s[0] + s[3], 23) + s[0], t = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= t;
  s[3] = gg_rotl(s[3], 45);
  return result;
}

/* Uniform in [0, 1), 53 bits. */
GG_INLINE double gg_rng_uniform(gg_rng *r)
{
  return (double)(gg_rng_next(r) >> 11) * 0x1p-53;
}

/* Uniform integer in [0, n), n < 2^32; Lemire's multiplication, bias below n/2^32 removed by rejection. */
GG_INLINE uint32_t gg_rng_below(gg_rng *r, uint32_t n)
{
  uint64_t m = (gg_rng_next(r) >> 32) * n;
  if ((uint32_t)m < n) {
    uint32_t threshold = -n % n;
    while ((uint32_t)m < threshold) m = (gg_rng_next(r) >> 32) * n;
  }
  return (uint32_t)(m >> 32);
}

/* Uniform on the unit sphere (Marsaglia 1972): no trigonometry, so the same bits from every compiler. */
GG_INLINE gg_vec gg_rng_direction(gg_rng *r)
{
  double a, b, q;
  do {
    a = 2 * gg_rng_uniform(r) - 1;
    b = 2 * gg_rng_uniform(r) - 1;
    q = a * a + b * b;
  } while (q >= 1);
  double f = 2 * __builtin_sqrt(1 - q);
  return (gg_vec){a * f, b * f, 1 - 2 * q};
}

/* Standard normal (GSL's ziggurat on this stream). */
double gg_common_rng_normal(gg_rng *r);
gg_vec gg_common_rng_normal_vec(gg_rng *r);
/* Isotropic velocity of unit variance in each component, with the fourth cumulant a2: v^2 has the gamma distribution of
 * shape 0.6/(0.4 + a2). Maxwellian at a2 = 0. */
gg_vec gg_common_rng_velocity(gg_rng *r, double a2);
/* Poisson count of this mean, up to 2^31 (GSL's). */
uint64_t gg_common_rng_poisson(gg_rng *r, double mean);

#endif
