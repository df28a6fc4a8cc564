/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The second moments of gaussian_closure.c in time, for sheared gases and for mixtures. Without shear the velocities
 * of each species are Maxwellian, with separate temperatures. */
#include <math.h>

#include "common/thermostat.h"
#include "theory/answer.h"
#include "theory/gaussian_moments.h"
#include "theory/relaxation.h"

bool gg_theory_gaussian_relaxes(const gg_model *m)
{
  const bool known = !m->walled && !m->law.name && !gg_model_is_injected(m) && !m->linear_response;
  return known && (gg_model_is_sheared(m) || m->n_species > 1);
}

/* Initial state: one temperature for all; spins roll with the flow. */
void gg_theory_gaussian_start(const gg_model *m, gg_gaussian state[])
{
  for (int i = 0; i < m->n_species; i++) {
    const double T = m->temperature0 / m->mass[i], theta = m->ratio0 * T / m->inertia[i];
    state[i] = (gg_gaussian){.M = {{{T, 0, 0}, {0, T, 0}, {0, 0, T}}},
                             .Theta = {{{theta, 0, 0}, {0, theta, 0}, {0, 0, theta}}},
                             .spin = gg_model_rolling(m, i)};
  }
}

static double energy_of(const gg_model *m, const gg_gaussian state[])
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += m->fraction[i] * m->mass[i] * gg_tensor_trace(state[i].M);
  return sum;
}

/* White noise that is equal for all species; or scaling of velocities that keeps their energy. */
static void add_thermostat(const gg_model *m, const gg_gaussian state[], gg_gaussian_rates *r)
{
  if (m->bath.on || gg_flow_cools(m->flow)) return;
  const double noise = gg_common_thermostat_kicks(m);
  const double scale = gg_common_heat_of(m) == GG_HEAT_SCALES ? energy_of(m, r->change) / energy_of(m, state) : 0;
  for (int i = 0; i < m->n_species; i++)
    for (int a = 0; a < 3; a++) {
      r->change[i].M.at[a][a] += noise;
      for (int b = 0; b < 3; b++) r->change[i].M.at[a][b] -= scale * state[i].M.at[a][b];
    }
}

/* Changes of the moments by the bath, and the energy per volume that it supplies and removes; a negative drag
 * supplies energy. */
static void add_bath(const gg_model *m, const gg_gaussian *state, int i, gg_gaussian *change, double flow[2])
{
  const gg_bath *b = &m->bath;
  const double n = m->density * gg_theory_fraction(m, i) * m->mass[i], nK = n * m->inertia[i];
  const double slip = state[i].spin - gg_model_rolling(m, i), C2 = gg_tensor_trace(state[i].M);
  for (int a = 0; a < 3; a++) {
    for (int c = 0; c < 3; c++) change->M.at[a][c] -= 2 * b->drag[i] * state[i].M.at[a][c];
    change->M.at[a][a] += b->noise[i];
  }
  flow[b->drag[i] > 0] += n * fabs(b->drag[i]) * C2;
  flow[0] += 1.5 * n * b->noise[i];
  if (!gg_theory_species_spins(m, i)) return;
  for (int a = 0; a < 3; a++) {
    for (int c = 0; c < 3; c++) change->Theta.at[a][c] -= 2 * b->spin_drag[i] * state[i].Theta.at[a][c];
    change->Theta.at[a][a] += b->spin_noise[i];
  }
  change->spin -= b->spin_drag[i] * slip;
  flow[1] += nK * b->spin_drag[i] * (gg_tensor_trace(state[i].Theta) + state[i].spin * slip);
  flow[0] += 1.5 * nK * b->spin_noise[i];
}

void gg_theory_gaussian_changes_at(const gg_model *m, const gg_gaussian *state, gg_gaussian_rates *r, double flow[2])
{
  gg_theory_gaussian_rates_at(m, state, r);
  flow[0] = flow[1] = 0;
  for (int i = 0; i < m->n_species; i++) {
    const double xy = state[i].M.at[0][1], yy = state[i].M.at[1][1];
    gg_gaussian *change = &r->change[i];
    change->M.at[0][0] -= 2 * m->shear_rate * xy;
    change->M.at[0][1] -= m->shear_rate * yy;
    change->M.at[1][0] -= m->shear_rate * yy;
    if (m->bath.on) add_bath(m, state, i, change, flow);
  }
}

static void rates_at(const gg_model *m, const gg_gaussian state[], gg_gaussian_rates *r)
{
  double flow[2];
  gg_theory_gaussian_changes_at(m, state, r, flow);
  add_thermostat(m, state, r);
}

static void move(const gg_model *m, const gg_gaussian from[], double dt, const gg_gaussian change[], gg_gaussian to[])
{
  for (int i = 0; i < m->n_species; i++) {
    for (int a = 0; a < 9; a++) {
      to[i].M.at[a / 3][a % 3] = from[i].M.at[a / 3][a % 3] + dt * change[i].M.at[a / 3][a % 3];
      to[i].Theta.at[a / 3][a % 3] = from[i].Theta.at[a / 3][a % 3] + dt * change[i].Theta.at[a / 3][a % 3];
    }
    to[i].spin = from[i].spin + dt * change[i].spin;
  }
}

static double fastest(const gg_model *m, const gg_gaussian state[], const gg_gaussian_rates *r)
{
  double most = 0;
  for (int i = 0; i < m->n_species; i++) {
    const double fed = m->bath.on ? m->bath.noise[i] : 0;
    most = fmax(most, r->frequency[i] + 3 * fabs(m->shear_rate) + 2 * fabs(m->bath.drag[i]) + 2 * m->bath.spin_drag[i] +
                          3 * fed / gg_tensor_trace(state[i].M));
  }
  return most;
}

static void symmetrise(gg_tensor *A)
{
  A->at[0][1] = A->at[1][0] = (A->at[0][1] + A->at[1][0]) / 2;
}

static bool is_small(gg_tensor change, gg_tensor of, double time)
{
  for (int a = 0; a < 9; a++)
    if (!(fabs(change.at[a / 3][a % 3]) * time <= 1e-7 * gg_tensor_trace(of))) return false;
  return true;
}

/* True if the remaining change is too small to be seen. */
static bool is_steady(const gg_model *m, const gg_gaussian state[], const gg_gaussian_rates *r, double time)
{
  for (int i = 0; i < m->n_species; i++)
    if (!is_small(r->change[i].M, state[i].M, time) || !is_small(r->change[i].Theta, state[i].Theta, time) ||
        !(fabs(r->change[i].spin) * time <= 1e-7 * sqrt(gg_tensor_trace(state[i].Theta))))
      return false;
  return true;
}

static double collision_rate(const gg_model *m, const gg_gaussian_rates *r)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += m->fraction[i] * r->frequency[i];
  return sum;
}

/* Processor time of a step, over the square of the number of species. Friction has a quadrature more, unless all
 * directions are alike. */
static double seconds_of(const gg_model *m)
{
  return m->rule == GG_FRICTIONAL && gg_model_is_sheared(m) ? 3e-3 : 2e-4;
}

#define LONG 1e5 /* relaxations are shorter, in units of the fastest rate; longer times would show rounding */

/* The fourth-order Runge-Kutta method, with steps in units of the fastest time. */
void gg_theory_gaussian_relax(const gg_model *m, double time, gg_relaxing *x)
{
  gg_gaussian *state = x->of;
  gg_gaussian_rates r[4];
  gg_gaussian at[GG_MAX_SPECIES];
  while (time > 0 && !(x->stop && gg_stop_asked(x->stop))) {
    rates_at(m, state, &r[0]);
    const double most = fastest(m, state, &r[0]);
    const bool settled = is_steady(m, state, &r[0], fmin(time, LONG / most));
    const double dt = settled ? time : fmin(time, (x->stride > 0 ? x->stride : 0.5) / most);
    x->collisions += dt * collision_rate(m, &r[0]);
    x->work -= (settled ? 0.25 : 1) * seconds_of(m) * m->n_species * m->n_species;
    if (settled || !(dt > 0) || x->work < 0) return;
    for (int k = 1; k < 4; k++) {
      move(m, state, k < 3 ? dt / 2 : dt, r[k - 1].change, at);
      rates_at(m, at, &r[k]);
    }
    for (int k = 0; k < 4; k++) move(m, state, k % 3 ? dt / 3 : dt / 6, r[k].change, state);
    for (int i = 0; i < m->n_species; i++)
      symmetrise(&state[i].M), symmetrise(&state[i].Theta); /* otherwise rounding errors grow */
    time = dt < time ? time - dt : 0;
  }
}

gg_tensor gg_theory_gaussian_stress(const gg_model *m, const gg_gaussian state[])
{
  gg_gaussian_rates r;
  gg_theory_gaussian_rates_at(m, state, &r);
  gg_tensor P = r.Pc;
  for (int a = 0; a < 9; a++) {
    double *at = &P.at[a / 3][a % 3];
    for (int i = 0; i < m->n_species; i++) *at += m->number_density[i] * m->mass[i] * state[i].M.at[a / 3][a % 3];
    *at *= m->stress_unit;
  }
  return P;
}
