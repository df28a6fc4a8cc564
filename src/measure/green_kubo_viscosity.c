/* SPDX-License-Identifier: GPL-3.0-or-later */
/* eta* = nu_0 eta/(n T) of cooling and heated gases by linear response: the limit of -P_xy/(n T a*) at a vanishing
 * reduced shear rate a* (common/linear_response.h). The noise of P_xy/(nT) is the same at every a*: hence least
 * squares of -P_xy/(n T) on eta* a* + B a*^3, over all samples while a* varies over its range. The sums of the
 * regression are the channels, so that the estimator's error of eta* contains that of the extrapolation.
 *
 * The kinetic stress is that at the instant of the sample. The collisional one is a mean over the interval before
 * it, in which it is proportional to sqrt(T): it belongs to the temperature at which sqrt(T) has its mean. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/linear_response.h"
#include "measure/cooling_interval.h"
#include "measure/grain_snapshot.h"
#include "measure/observable.h"

/* Sums of one regression: a*^2, a*^4, a*^6, and the stress times a*, a*^3. */
enum { A2, A4, A6, SA, SA3, SUMS };
enum { KINETIC, COLLISIONAL = SUMS, CHANNELS = 2 * SUMS };

/* Rows, of two collisions a grain each, after which a heated gas has forgotten its rescaling. */
enum { RELAXATION = 5 };

typedef struct memory { /* data that one sample leaves for the next */
  double last_temperature;
  double since; /* rows since the last rescaling */
} memory;

typedef struct viscosity {
  const gg_model *model;
  double cc, cxcy; /* mass-weighted sums over the grains */
  memory memory;
  gg_species_scratch scratch;
} viscosity;

static const char *refuses(const gg_model *m)
{
  return m->linear_response ? NULL : "needs flow: small_shear";
}

static size_t width(const gg_model *m)
{
  (void)m;
  return CHANNELS;
}

static void *create(const gg_model *model, gg_error *err)
{
  viscosity *v = gg_base_array_new(1, sizeof *v, err);
  if (v) v->model = model;
  return v;
}

static void *memory_of(void *self, size_t *bytes)
{
  viscosity *v = self;
  *bytes = sizeof v->memory;
  return &v->memory;
}

static void begin(void *self)
{
  viscosity *v = self;
  v->cc = v->cxcy = 0;
}

static void add_chunk(void *self, const gg_chunk *chunk)
{
  viscosity *v = self;
  gg_chunk grains = *chunk;
  for (int a = 0; a < 3 && chunk->whole_c[0]; a++)
    grains.c[a] = chunk->whole_c[a]; /* independent of the scene's frame */
  for (int i = 0; i < v->model->n_species; i++) {
    gg_species_view g = gg_measure_species_chunk(&grains, i, &v->scratch);
    double cc = 0, cxcy = 0;
    for (size_t k = 0; k < g.n; k++) {
      double x = g.c[0][k], y = g.c[1][k], z = g.c[2][k];
      cc += x * x + y * y + z * z;
      cxcy += x * y;
    }
    v->cc += v->model->mass[i] * cc;
    v->cxcy += v->model->mass[i] * cxcy;
  }
}

/* Add to the sums, with a and the stress in units of the high end of a*, so that no sum is tiny. */
static void put(const gg_linear_response *range, double a, double stress, double *sums)
{
  double u = a / range->high, u2 = u * u, y = stress / range->high;
  sums[A2] = u2, sums[A4] = u2 * u2, sums[A6] = u2 * u2 * u2;
  sums[SA] = y * u, sums[SA3] = y * u * u2;
}

static bool counts(const viscosity *v, const gg_linear_response *range, double a)
{
  return range->cools ? a >= range->low : v->memory.since > RELAXATION;
}

static void finish(void *self, const gg_interval *in, double *row)
{
  viscosity *v = self;
  const gg_model *m = v->model;
  double T = v->cc / (3 * (double)m->n), T0 = v->memory.last_temperature * in->velocity_factor * in->velocity_factor;
  v->memory.last_temperature = T;
  v->memory.since = in->velocity_factor == 1 ? v->memory.since + 1 : 0;
  for (int k = 0; k < CHANNELS; k++) row[k] = 0;
  gg_linear_response range = gg_common_linear_response_of(m);
  double a = gg_common_reduced_shear_rate(m, T);
  if (!(in->elapsed > 0) || !counts(v, &range, a)) return;
  put(&range, a, -v->cxcy / ((double)m->n * T), row + KINETIC);
  if (m->boltzmann) return;
  double impulse = 0, root = gg_cooling_interval_of(T0, T, 1).root, mean_T = root * root;
  for (int q = 0; q < gg_pairs_of(v->model->n_species); q++) impulse += in->transfer->stress[q][0][1];
  double stress = impulse / (m->volume * in->elapsed * m->density * mean_T);
  put(&range, gg_common_reduced_shear_rate(m, mean_T), -stress, row + COLLISIONAL);
}

/* For a whole sweep the determinant of both powers is 0.2 (cooling) or 0.36 (heated) of A2 A6; for a part of one it
 * is so small that the fit amplifies the noise, and its error has no meaning. */
#define LEAST_DETERMINANT 0.1

static double fit(const double *s)
{
  const double determinant = s[A2] * s[A6] - s[A4] * s[A4];
  if (!(determinant > LEAST_DETERMINANT * s[A2] * s[A6])) return NAN;
  return (s[SA] * s[A6] - s[SA3] * s[A4]) / determinant;
}

static double kinetic(const double *mean, const gg_model *m)
{
  (void)m;
  return fit(mean + KINETIC);
}

static double total(const double *mean, const gg_model *m)
{
  return kinetic(mean, m) + (m->boltzmann ? 0 : fit(mean + COLLISIONAL));
}

static const char too_short[] = "too short: the averaging has less than a sweep of the reduced shear rate";

static const gg_derived derived[] = {
    {GG_Q_VISCOSITY_REDUCED, .of = total, .unknown = too_short},
    {GG_Q_VISCOSITY_REDUCED_KINETIC, .of = kinetic, .unknown = too_short},
    GG_DERIVED_END,
};

const gg_observable gg_measure_viscosity = {
    GG_OBSERVABLE(VISCOSITY, viscosity),
    .create = create,
    .destroy = free,
    .memory = memory_of,
    .refuses = refuses,
    .rows =
        &(const gg_observable_rows){
            .width = width, .begin = begin, .add_chunk = add_chunk, .finish = finish, .derived = derived},
    .cost = {.ns = {0.5, 0.5}},
};
