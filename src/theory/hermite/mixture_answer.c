/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/enskog_hermite.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "theory/answer.h"
#include "theory/garzo_dufty1999.h"
#include "theory/hermite/hermite_mixture.h"
#include "theory/hermite/isotropic.h"
#include "theory/hermite/order_convergence.h"
#include "theory/hermite/viscosity.h"

static const char name[] = "enskog_hermite";

/* Half the degrees, 4 to 14; for the viscosity up to 8, and for so many species as take a second. */
enum { FIRST = 2, LAST = 7, LAST_VISCOSITY = 4, MOST_VISCOUS = 6 };
static const double good = 1e-8;

/* Collisions of a grain, and p_c over n T = (2 pi/3) sum_ij x_i n_j chi_ij sigma_ij^3 J_ij <g^2>/2, at T = 1. */
static double collision_rate(const gg_model *m, const gg_hermite_mixture *x)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int pair = gg_pair(i, j);
      double frequency = m->density * gg_theory_fraction(m, j) * m->chi[pair] * m->sigma[pair] * m->sigma[pair];
      sum += gg_theory_fraction(m, i) * 4 * M_PI * frequency * gg_hermite_mixture_flux(x, i, j, 1);
    }
  return sum;
}

static double transfer(const gg_model *m, const gg_hermite_mixture *x)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int pair = gg_pair(i, j);
      double volume = m->density * gg_theory_fraction(m, j) * m->chi[pair] * pow(m->sigma[pair], 3);
      double impulse = m->contact[i][j].jn * gg_hermite_mixture_flux(x, i, j, 2);
      sum += gg_theory_fraction(m, i) * 2 * M_PI / 3 * volume * impulse;
    }
  return sum;
}

/* White noise is set to balance Maxwellians at temperature0 (thermostat.h). */
static double temperature_of(const gg_model *m, const gg_hermite_mixture *x)
{
  if (x->drive.kind == GG_HEATING_BATH) return gg_theory_heating_temperature(&x->drive, x->heating, NAN);
  if (m->elastic || x->drive.kind != GG_HEATING_NOISE || !(x->heating > 0)) return m->temperature0;
  return pow(gg_common_thermostat_noise(m) / 2 / x->heating, 2. / 3);
}

static void answer_mixture(const gg_model *m, const gg_hermite_mixture *x, gg_theory_answer *a)
{
  double partial[GG_MAX_SPECIES], T = temperature_of(m, x), p = m->density * T;
  for (int i = 0; i < m->n_species; i++) {
    double square = gg_hermite_mixture_square(x, i);
    partial[i] = T * m->mass[i] * x->scale[i] * x->scale[i] * square;
    a->value[GG_Q_CUMULANT + i] = 2 * (gg_hermite_mixture_fourth(x, i) / (15 * square * square) - 1);
  }
  a->value[GG_Q_COOLING_RATE] = m->elastic ? 0 : gg_hermite_mixture_cooling(x, m) / gg_common_model_nu0(m, 1);
  a->value[GG_Q_PARTIAL_TEMPERATURE_RATIO] = partial[0] / partial[1];
  if (m->linear_response) return; /* T grows with time: no value */
  gg_theory_answer_temperature(m, T, NAN, a);
  for (int i = 0; i < m->n_species; i++) a->value[GG_Q_PARTIAL_TEMPERATURE + i] = partial[i];
  gg_theory_answer_pressure(m, T, p, p * transfer(m, x), a);
  a->value[GG_Q_COLLISION_RATE] = collision_rate(m, x) * sqrt(T);
}

/* The gas at rest, with its heating. */
static gg_hermite_gas resting(const gg_model *m, const gg_hermite_mixture *x)
{
  gg_hermite_gas gas = gg_hermite_gas_of(m);
  gas.stream[0][1] = 0;
  for (int i = 0; i < m->n_species; i++) {
    const gg_heating_rates at = gg_theory_heating_at(&x->drive, i, x->heating);
    gas.drag[i] = at.drag, gas.diffusion[i] = at.diffusion;
    for (int j = 0; j < m->n_species; j++) gas.impact[i][j].shear = 0;
  }
  return gas;
}

static gg_status expand(const gg_hermite_mixture *x, const gg_hermite_basis *b, int n_species, gg_hermite_state *state,
                        gg_error *err)
{
  for (int i = 0; i < n_species; i++) {
    state[i] = (gg_hermite_state){.a = malloc((size_t)b->n * sizeof(double)), .width = GG_HERMITE_WIDTH};
    if (!state[i].a) return gg_base_out_of_memory(err);
    for (int k = 0; k < 3; k++) state[i].L[k][k] = x->scale[i];
    gg_hermite_isotropic_expand(b, x->alpha[i], state[i].a);
  }
  return GG_OK;
}

static gg_status answer_viscosity(const gg_model *m, const gg_hermite_mixture *x, int degree, gg_theory_answer *a,
                                  gg_error *err)
{
  gg_hermite_state state[GG_MAX_SPECIES] = {{.a = NULL}};
  gg_hermite_gas gas = resting(m, x);
  gg_hermite_viscosity v;
  gg_hermite_basis b;
  double fading = gg_theory_thermostat_factor(m) == 0.5 ? gg_hermite_mixture_cooling(x, m) / 2 : 0,
         nu0 = gg_common_model_nu0(m, 1);
  GG_TRY(gg_hermite_basis_make(&b, degree, err));
  gg_status status = expand(x, &b, m->n_species, state, err);
  if (status == GG_OK) status = gg_hermite_viscosity_of(&gas, state, degree, !m->boltzmann, fading, &v, err);
  for (int i = 0; i < m->n_species; i++) free(state[i].a);
  gg_hermite_basis_clear(&b);
  GG_TRY(status);
  a->value[GG_Q_VISCOSITY_REDUCED] = nu0 * v.total;
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = nu0 * v.kinetic;
  return GG_OK;
}

gg_status gg_hermite_mixture_answer(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_convergence convergence = {.n = 0}, viscous = {.n = 0};
  gg_hermite_mixture x = {.drive = gg_theory_heating_of(m)};
  gg_error why;
  for (int l = FIRST; l <= LAST; l++) {
    if (l > LAST_VISCOSITY && gg_hermite_convergence_change(&convergence, GG_Q_COOLING_RATE) < good) break;
    gg_status status = gg_hermite_mixture_solve(&x, m, l, &why);
    if (status == GG_OK) answer_mixture(m, &x, gg_hermite_convergence_next(&convergence));
    if (status == GG_OK && l <= LAST_VISCOSITY && m->n_species <= MOST_VISCOUS)
      status = answer_viscosity(m, &x, 2 * l, gg_hermite_convergence_next(&viscous), &why);
    if (status != GG_OK) return gg_theory_reject(err, name, "fails here: %s", why.message);
  }
  GG_TRY(gg_hermite_convergence_finish(&convergence, name, GG_Q_PARTIAL_TEMPERATURE_RATIO, 0, a, err));
  if (viscous.n > 0)
    gg_hermite_convergence_take(&viscous, GG_Q_VISCOSITY_REDUCED, a),
        gg_hermite_convergence_take(&viscous, GG_Q_VISCOSITY_REDUCED_KINETIC, a);
  if (m->flow == GG_HCS) gg_theory_answer_critical_lengths(m, 0, a);
  return GG_OK;
}
