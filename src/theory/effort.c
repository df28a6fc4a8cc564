/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/effort.h"

#include <math.h>

#include "common/linear_response.h"
#include "common/relaxation_times.h"
#include "common/thermostat.h"
#include "theory/theory_list.h"

/* Collisions per grain that the stress needs, times N error^2, measured in runs of 1000 to 4000 grains: some fifty
 * times the variance of one grain. eta* of a linear response is a slope over a*, fitted beside that of a*^3; half of
 * each sweep of a gas that cools is its beginning. */
static double for_stress(const gg_model *m)
{
  if (m->linear_response) {
    const gg_linear_response range = gg_common_linear_response_of(m);
    return (range.cools ? 60 : 30) / (range.high * range.high);
  }
  if (gg_common_is_kicked(m) && m->shear_rate != 0) return 650; /* the stress is small beside the pressure */
  if (m->walled) return 400; /* fluctuates along with the slow waves across the gap */
  return m->shear_rate != 0 ? 130 : 5;
}

/* Collisions per grain times N error^2 for N1, N2 and a2, which may be small: their absolute scatter is sqrt(12) and
 * sqrt(2.5), whatever the mean. The mean is estimated by a theory. 0: another quantity, or no theory. */
static double for_small(const gg_model *m, gg_quantity q)
{
  const bool difference = gg_common_quantity_mask(q) & GG_STRESS_DIFFERENCE;
  const gg_theory *theory = difference ? &gg_theory_gaussian_closure : &gg_theory_garzo_dufty1999;
  gg_theory_answer answer;
  if (!difference && q != GG_Q_A2) return 0;
  if (gg_theory_evaluate(theory, m, &answer, NULL) != GG_OK || !isfinite(answer.value[q])) return 0;
  return (difference ? 12 : 2.5) / (answer.value[q] * answer.value[q]);
}

double gg_theory_effort(const gg_model *m, gg_quantity q)
{
  const double usual = fmax(for_stress(m), 2 * gg_common_model_relaxation(m) * 2 / 3.0);
  return fmax(usual, for_small(m, q));
}
