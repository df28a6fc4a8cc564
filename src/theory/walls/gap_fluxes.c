/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closures at given states, without balances and walls: stress and heat flux where density, temperature, shear rate and
 * slopes are known, for instance measured. Gases answer at given pressure and shear stress (gap.h), so these are found
 * by Newton's method. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/contact_value.h"
#include "theory/answer.h"
#include "theory/walls/gap.h"

static double number_density(const gg_model *m, double solid_fraction)
{
  return m->boltzmann ? solid_fraction : solid_fraction * 6 / M_PI; /* points: n over its mean */
}

/* A state to find: ln n, and the shear rate over n sqrt(T), from x: ln P, tau/P. */
typedef struct target {
  gg_gap_gas gas;
  double T, n, shear;
} target;

static bool left_of(const target *t, const double x[2], gg_gap_local *at, double left[2])
{
  const double P = exp(x[0]);
  const bool within = t->gas.local(t->gas.self, P, x[1] * P, t->T, at);
  left[0] = log(at->n / t->n), left[1] = (at->shear - t->shear) / (t->n * sqrt(t->T));
  return within;
}

static double limited(double step, double most)
{
  return fmin(fmax(step, -most), most);
}

/* Newton's method from x; false without a state within the densities and shear rates of the gas. */
static bool find(const target *t, double x[2], gg_gap_local *at)
{
  const double d = 1e-6, enough = 1e-10;
  for (int step = 0; step < 40; step++) {
    double left[2], J[2][2], moved[2];
    gg_gap_local other;
    const bool within = left_of(t, x, at, left);
    if (fabs(left[0]) + fabs(left[1]) < enough) return within;
    for (int k = 0; k < 2; k++) {
      const double beside[2] = {x[0] + d * (k == 0), x[1] + d * (k == 1)};
      left_of(t, beside, &other, moved);
      for (int i = 0; i < 2; i++) J[i][k] = (moved[i] - left[i]) / d;
    }
    const double det = J[0][0] * J[1][1] - J[0][1] * J[1][0];
    x[0] -= limited((left[0] * J[1][1] - left[1] * J[0][1]) / det, 0.5);
    x[1] -= limited((left[1] * J[0][0] - left[0] * J[1][0]) / det, 0.2);
    if (!isfinite(x[0]) || !isfinite(x[1])) break;
  }
  return false;
}

static gg_gap_fluxes fluxes_at(const gg_model *m, gg_gap_gas gas, const gg_gap_state *s)
{
  const gg_gap_fluxes none = {NAN, NAN, NAN, NAN, NAN, NAN};
  const double n = number_density(m, s->solid_fraction), y = m->boltzmann ? 0 : s->solid_fraction;
  const target t = {gas, s->temperature, n, s->shear_rate};
  const double n_slope = number_density(m, s->solid_fraction_slope), unit = m->stress_unit;
  gg_gap_local at;
  if (!(n > 0 && s->temperature > 0 && isfinite(s->shear_rate))) return none;
  const double Z = 1 + 2 * (1 + m->e[0]) * y * (m->boltzmann ? 1 : gg_common_contact_value_of(m->contact_value, y));
  double x[2] = {log(n * Z * s->temperature), 0};
  if (!find(&t, x, &at)) return none;
  const double P = exp(x[0]);
  return (gg_gap_fluxes){.P_xx = unit * (P + at.xx),
                         .P_yy = unit * P,
                         .P_zz = unit * (P + at.zz),
                         .P_yx = unit * x[1] * P,
                         .q_y = -unit * (at.kappa * s->temperature_slope + at.mu * n_slope),
                         .loss = unit * at.loss};
}

gg_status gg_theory_gap_fluxes(const gg_gap_theory *theory, const gg_model *m, size_t n, const gg_gap_state *state,
                               gg_gap_fluxes *fluxes, gg_error *err)
{
  const double room = 0.02; /* of densities about those given */
  double low = INFINITY, high = 0;
  gg_gap_gas gas;
  GG_TRY(gg_theory_require_one_species(m, theory->name, err));
  GG_TRY(gg_theory_require_smooth(m, theory->name, err));
  for (size_t i = 0; i < n; i++)
    if (state[i].solid_fraction > 0)
      low = fmin(low, state[i].solid_fraction), high = fmax(high, state[i].solid_fraction);
  if (!(low <= high)) low = high = m->boltzmann ? 1 : m->phi;
  if (!m->boltzmann) high = fmin(high * (1 + room), gg_common_contact_value_limit(m->contact_value));
  void *memory = gg_base_array_new(1, theory->size, err);
  if (!memory) return GG_FAILED;
  const double least = number_density(m, low * (1 - room)), most = number_density(m, high);
  const gg_status status = theory->gas_of(m, least, most, memory, &gas, err);
  for (size_t i = 0; i < n && status == GG_OK; i++) fluxes[i] = fluxes_at(m, gas, &state[i]);
  free(memory);
  return status;
}
