/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/ensemble_size.h"

#include <math.h>
#include <stdio.h>

/* Means lie off by so much over the number of grains, those of the scarcest species: fluctuations of T lower it by half
 * their relative variance, as its rate of change bends. Measured
 * (validation/noise_free/monte_carlo_bias.c): 0.5 to 1.5 in T, the stresses and the viscosity. */
#define BIAS_TIMES_N 2
/* Between walls the flow fluctuates, too, and what dissipates follows: T of dense Couette flows rises by 4 to 22 of 1/N
 * (phi = 0.1 and 0.3, e = 0.5 to 0.9, N = 1000 beside 20000), of a dilute one by 0.4(0.7) (phi = 0.01). */
#define BIAS_BETWEEN_WALLS 25
#define BIAS_BY_PHI 230
/* Kept below this share of the requested error; between walls, where waves across the gap make long runs, below half.
 */
#define SHARE 0.25
#define SHARE_BETWEEN_WALLS 0.5
/* Beyond, memory and warm-up cost more than any error that can be reached in days requires. */
enum { MOST_ENSEMBLE = 1000000 };

double gg_scene_ensemble_requested_error(const gg_scene *s)
{
  double least = s->run.relative_error != GG_AUTO ? s->run.relative_error : INFINITY;
  for (int q = 0; q < GG_MAX_UNTIL; q++)
    if (s->run.until[q] > 0) least = fmin(least, s->run.until[q]);
  return isfinite(least) ? least : s->run.collisions != GG_AUTO ? 0 : 0.01;
}

double gg_scene_ensemble_size_error(const gg_scene *s)
{
  return s->fixed.ensemble_error != GG_AUTO ? s->fixed.ensemble_error : gg_scene_ensemble_requested_error(s);
}

static double bias_times_n(gg_flow flow, double phi)
{
  return gg_flow_is_walled(flow) ? fmin(BIAS_TIMES_N + BIAS_BY_PHI * phi, BIAS_BETWEEN_WALLS) : BIAS_TIMES_N;
}

double gg_scene_ensemble_most_bias(gg_flow flow)
{
  return gg_flow_is_walled(flow) ? SHARE_BETWEEN_WALLS : SHARE;
}

double gg_scene_ensemble_bias(const gg_model *m)
{
  int64_t least = m->n;
  for (int i = 0; i < m->n_species; i++)
    if (m->n_of[i] > 0 && m->n_of[i] < least) least = m->n_of[i];
  return bias_times_n(m->flow, m->phi) / (double)least;
}

static double scarcest(const gg_scene *s)
{
  double least = 1, sum = 0;
  for (int i = 0; i < s->n_species; i++) {
    sum += s->species[i].fraction;
    if (s->species[i].fraction > 0) least = fmin(least, s->species[i].fraction);
  }
  return s->n_species > 1 && sum > 0 ? least / sum : 1;
}

static double needed(const gg_scene *s)
{
  const double error = gg_scene_ensemble_size_error(s);
  return error > 0 ? ceil(bias_times_n(s->flow, s->phi) / (gg_scene_ensemble_most_bias(s->flow) * error * scarcest(s)))
                   : 0;
}

static bool is_given(const gg_scene *s)
{
  return s->dsmc.particles || s->particles > GG_LEAST_ENSEMBLE;
}

int64_t gg_scene_ensemble_size(const gg_scene *s)
{
  if (s->dsmc.particles) return s->dsmc.particles;
  if (is_given(s)) return s->particles;
  return (int64_t)fmin(fmax(needed(s), GG_LEAST_ENSEMBLE), MOST_ENSEMBLE);
}

void gg_scene_ensemble_size_reason(const gg_scene *s, char *text, size_t size)
{
  const double error = gg_scene_ensemble_size_error(s), most = gg_scene_ensemble_most_bias(s->flow),
               bias = bias_times_n(s->flow, s->phi) / ((double)gg_scene_ensemble_size(s) * scarcest(s));
  *text = 0;
  if (is_given(s)) return;
  if (!(error > 0))
    snprintf(text, size, "automatic: finite-size bias up to %.2g %%", 100 * bias);
  else if (bias <= 1.001 * most * error)
    snprintf(text, size, "automatic: finite-size bias below %.2g %%, at most %s of the requested error of %.3g %%",
             100 * bias, most < 0.5 ? "a quarter" : "half", 100 * error);
  else
    snprintf(text, size, "automatic, the most there are: finite-size bias up to %.2g %%, requested error %.3g %%",
             100 * bias, 100 * error);
}
