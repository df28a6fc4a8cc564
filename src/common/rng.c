/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/rng.h"

#include <Random123/philox.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "common/portable_math.h"

gg_rng gg_common_rng_seed(uint64_t seed, uint64_t stream)
{
  philox4x64_key_t key = {{seed, 0x677261696e676173u}}; /* "graingas" */
  philox4x64_ctr_t counter = {{stream, 0, 0, 0}};
  philox4x64_ctr_t block = philox4x64(counter, key);
  gg_rng r;
  for (int i = 0; i < 4; i++) r.s[i] = block.v[i];
  if (!(r.s[0] | r.s[1] | r.s[2] | r.s[3])) r.s[0] = 1; /* the one state that xoshiro cannot leave */
  return r;
}

/* A gsl_rng that draws from our stream, so that GSL's samplers serve every distribution. */
static unsigned long gsl_get(void *state)
{
  return (unsigned long)(gg_rng_next(state) >> 32);
}
static double gsl_get_double(void *state)
{
  return gg_rng_uniform(state);
}
static void gsl_set(void *state, unsigned long seed)
{
  *(gg_rng *)state = gg_common_rng_seed(seed, 0);
}
static const gsl_rng_type stream_type = {"xoshiro256++", 0xffffffffu,   0, sizeof(gg_rng), gsl_set,
                                         gsl_get,        gsl_get_double};

/* Further out, one number in 1700, the ziggurat takes a logarithm. */
#define TAIL 3.44

double gg_common_rng_normal(gg_rng *r)
{
  gsl_rng adapter = {&stream_type, r};
  const double x = gsl_ran_gaussian_ziggurat(&adapter, 1.0);
  return fabs(x) > TAIL ? gg_agreed(x, GG_AGREED_FUNCTION) : x;
}

gg_vec gg_common_rng_normal_vec(gg_rng *r)
{
  double x = gg_common_rng_normal(r), y = gg_common_rng_normal(r), z = gg_common_rng_normal(r);
  return (gg_vec){x, y, z};
}

uint64_t gg_common_rng_poisson(gg_rng *r, double mean)
{
  gsl_rng adapter = {&stream_type, r};
  return gsl_ran_poisson(&adapter, mean);
}

gg_vec gg_common_rng_velocity(gg_rng *r, double a2)
{
  if (a2 == 0) return gg_common_rng_normal_vec(r);
  gsl_rng adapter = {&stream_type, r};
  const double shape = 0.6 / (0.4 + a2), speed = sqrt(3 / shape * gsl_ran_gamma(&adapter, shape, 1));
  return gg_scale(gg_agreed(speed, GG_AGREED_FUNCTION), gg_rng_direction(r));
}
