/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/linear_response.h"

#include <math.h>

#include "common/relaxation_times.h"

/* eta* falls with a* like 1 - 4 a*^2 (e = 0.7): 6 % at the high end, which the extrapolation takes out to 0.05 %. A
 * sweep spans a factor of four in a*, which fixes its slope. */
static const double low = 0.03, high = 0.12;

gg_linear_response gg_common_linear_response_of(const gg_model *m)
{
  bool cools = m->thermostat == GG_NO_THERMOSTAT && !m->elastic;
  /* The stress left over from a* = high is forgotten while a* grows fourfold from `low`/4 to `low`. */
  if (cools) return (gg_linear_response){.start = low / 4, .low = low, .high = high, .power = 4, .cools = true};
  return (gg_linear_response){.start = high, .low = low, .high = high, .power = -2};
}

double gg_common_reduced_shear_rate(const gg_model *m, double T)
{
  return m->shear_rate / gg_common_model_nu0(m, T);
}

bool gg_common_linear_response_ends(const gg_model *m, double T)
{
  if (!m->linear_response) return false;
  double a = gg_common_reduced_shear_rate(m, T);
  return gg_common_linear_response_of(m).cools ? a > high : a < low;
}

double gg_common_linear_response_length(const gg_model *m)
{
  gg_linear_response s = gg_common_linear_response_of(m);
  if (s.cools) return 2 * M_LN2 * s.power * gg_common_model_cooling(m);
  return 1.25 * m->chi[0] * 1.5 * (1 / (s.low * s.low) - 1 / (s.high * s.high));
}
