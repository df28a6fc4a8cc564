/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/ensemble_size.h"

#include <math.h>
#include <stdio.h>

#include "common/finite_size.h"

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

double gg_scene_ensemble_most_bias(gg_flow flow)
{
  return gg_flow_is_walled(flow) ? SHARE_BETWEEN_WALLS : SHARE;
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
  return error > 0 ? ceil(gg_common_finite_size_bias(s->flow, s->phi) /
                          (gg_scene_ensemble_most_bias(s->flow) * error * scarcest(s)))
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
               bias = gg_common_finite_size_bias(s->flow, s->phi) / ((double)gg_scene_ensemble_size(s) * scarcest(s));
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
