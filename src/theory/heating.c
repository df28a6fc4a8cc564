/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/heating.h"

#include <math.h>

#include "common/thermostat.h"

gg_heating gg_theory_heating_of(const gg_model *m)
{
  const bool free = m->linear_response && gg_common_heat_of(m) == GG_UNHEATED;
  if (gg_flow_cools(m->flow) || free) return (gg_heating){.kind = GG_HEATING_COOLS};
  switch (gg_common_heat_of(m)) {
  case GG_HEAT_BATHES: return (gg_heating){GG_HEATING_BATH, &m->bath, 1 / sqrt(gg_common_thermostat_balance(m, 0))};
  case GG_HEAT_KICKS: return (gg_heating){.kind = GG_HEATING_NOISE};
  default: return (gg_heating){.kind = GG_HEATING_STRETCHES};
  }
}

/* drag = a x, diffusion = b x or, in a bath, b x^3. */
static gg_heating_rates rates(const gg_heating *h, int i, double x, double cube)
{
  switch (h->kind) {
  case GG_HEATING_BATH:
    return (gg_heating_rates){h->bath->drag[i] * x, h->bath->noise[i] / 2 * cube, h->bath->spin_drag[i] * x,
                              h->bath->spin_noise[i] / 2 * cube};
  case GG_HEATING_NOISE: return (gg_heating_rates){.diffusion = x};
  case GG_HEATING_COOLS: return (gg_heating_rates){.drag = -x, .spin_drag = -x};
  default: return (gg_heating_rates){.drag = -x};
  }
}

gg_heating_rates gg_theory_heating_at(const gg_heating *h, int i, double x)
{
  return rates(h, i, x, x * x * x);
}

gg_heating_rates gg_theory_heating_slopes(const gg_heating *h, int i, double x)
{
  return rates(h, i, 1, 3 * x * x);
}

double gg_theory_heating_step(const gg_heating *h, double x, double step, double rate)
{
  return fabs(step) / (h->kind == GG_HEATING_BATH ? fabs(x) : rate);
}
