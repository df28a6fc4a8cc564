/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With drag gamma and noise xi^2 (thermostat.h), nu the collision rate of Maxwellians, m = 1:
 *
 * Smooth grains in the first Sonine approximation (T.P.C. van Noije & M.H. Ernst, Granular Matter 1 (1998) 57), g = n
 * d^2 chi, v_0^2 = 2T, <v^2> = (3/2) v_0^2, <v^4> = (15/4) v_0^4 (1 + a2):
 *   d<v^2>/dt = -g v_0^3 mu_2 - 2 gamma <v^2> + 3 xi^2,   d<v^4>/dt = -g v_0^5 mu_4 - 4 gamma <v^4> + 10 xi^2 <v^2>
 *   mu_2 = sqrt(2 pi) (1-e^2) (1 + 3 a2/16)
 *   mu_4 = sqrt(2 pi) {(1-e^2)(9/2+e^2) + a2 [(3/32)(1-e^2)(69+10e^2) + 2(1+e)]}
 * Rough grains with two Maxwellians (two_maxwellian.h):
 *   dT/dt = nu T dE_tr/3 - 2 gamma T + xi^2,   dtheta/dt = nu T dE_rot/3 - 2 gamma_r theta + K xi_r^2
 * Sheared gases and mixtures: gaussian_relaxation.c. */
#include "theory/relaxation.h"

#include "base/memory.h"
#include "common/thermostat.h"
#include "theory/two_maxwellian.h"

const char *gg_theory_relaxation_name(const gg_model *m)
{
  const bool known =
      m->n_species == 1 && !gg_model_is_sheared(m) && !m->walled && !m->law.name && !gg_model_is_injected(m);
  if (gg_theory_gaussian_relaxes(m)) return gg_model_is_sheared(m) ? "Gaussian closure" : "Maxwellians";
  return !known ? NULL : m->rule == GG_SMOOTH ? "first Sonine" : "two Maxwellians";
}

gg_relaxing gg_theory_relaxation_start(const gg_model *m)
{
  const double theta = m->rule == GG_SMOOTH ? 0 : m->ratio0 * m->temperature0;
  gg_relaxing x = {.T = m->temperature0, .theta = theta, .a2 = m->rule == GG_SMOOTH ? m->a2_0 : 0, .work = 2};
  if (!gg_theory_gaussian_relaxes(m)) return x;
  gg_base_gsl_enter();
  gg_theory_gaussian_start(m, x.of);
  if (gg_model_is_sheared(m)) x.P = gg_theory_gaussian_stress(m, x.of);
  gg_base_gsl_leave();
  return x;
}

gg_relaxing gg_theory_relaxation_lost(void)
{
  gg_relaxing x = {.T = NAN, .theta = NAN, .a2 = NAN, .collisions = NAN, .work = -1};
  for (int i = 0; i < GG_MAX_SPECIES; i++) x.of[i].M.at[0][0] = x.of[i].spin = NAN;
  for (int a = 0; a < 9; a++) x.P.at[a / 3][a % 3] = NAN;
  return x;
}

/* Mean spin; see GG_ROLLING_PHI. */
static double spin_of(const gg_model *m, const gg_relaxing *x)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += m->fraction[i] * x->of[i].spin * 2 / m->diameter[i];
  return m->rule != GG_SMOOTH && m->phi >= GG_ROLLING_PHI ? sum : NAN;
}

/* Stress of a sheared gas. */
static double stress_value(const gg_model *m, const gg_tensor *P, gg_quantity q)
{
  const double p = gg_tensor_trace(*P) / 3;
  switch (q) {
  case GG_Q_PRESSURE: return p;
  case GG_Q_P_XX: return P->at[0][0];
  case GG_Q_P_YY: return P->at[1][1];
  case GG_Q_P_ZZ: return P->at[2][2];
  case GG_Q_P_XY: return P->at[0][1];
  case GG_Q_N1: return (P->at[0][0] - P->at[1][1]) / p;
  case GG_Q_N2: return (P->at[1][1] - P->at[2][2]) / p;
  case GG_Q_SHEAR_VISCOSITY: return fabs(P->at[0][1]) / m->shear_rate;
  default: return NAN;
  }
}

double gg_theory_relaxation_value(const gg_model *m, const gg_relaxing *x, gg_quantity q)
{
  const int species = (int)q - (int)GG_Q_PARTIAL_TEMPERATURE;
  if (q == GG_Q_TEMPERATURE) return x->T;
  if (q == GG_Q_ROTATIONAL_TEMPERATURE) return x->theta;
  if (q == GG_Q_TEMPERATURE_RATIO) return x->theta / x->T;
  if (!gg_theory_gaussian_relaxes(m)) return q == GG_Q_A2 && m->rule == GG_SMOOTH ? x->a2 : NAN;
  if (species >= 0 && species < m->n_species) return m->mass[species] * gg_tensor_trace(x->of[species].M) / 3;
  if (!gg_model_is_sheared(m)) return NAN;
  return q == GG_Q_SPIN_Z ? spin_of(m, x) : stress_value(m, &x->P, q);
}

void gg_theory_relaxation_stress(const gg_model *m, gg_relaxing *x)
{
  gg_base_gsl_enter();
  x->P = gg_theory_gaussian_stress(m, x->of);
  gg_base_gsl_leave();
}

static double noise_of(const gg_model *m)
{
  return m->bath.on ? m->bath.noise[0] : gg_common_thermostat_kicks(m);
}

static double drag_of(const gg_model *m)
{
  return m->bath.on ? m->bath.drag[0] : 0;
}

static gg_relaxing smooth_rates(const gg_model *m, gg_relaxing x)
{
  const double e = m->e[0], v2 = 2 * x.T, g = m->density * m->chi[0] * sqrt(2 * M_PI * v2), lost = 1 - e * e;
  const double noise = noise_of(m), drag = drag_of(m), square = 1.5 * v2, fourth = 3.75 * v2 * v2 * (1 + x.a2);
  const double mu2 = lost * (1 + 3 * x.a2 / 16);
  const double mu4 = lost * (4.5 + e * e) + x.a2 * (3. / 32 * lost * (69 + 10 * e * e) + 2 * (1 + e));
  const double d2 = -g * v2 * mu2 - 2 * drag * square + 3 * noise;
  const double d4 = -g * v2 * v2 * mu4 - 4 * drag * fourth + 10 * noise * square;
  return (gg_relaxing){.T = d2 / 3, .a2 = (1 + x.a2) * (d4 / fourth - 2 * d2 / square)};
}

static gg_relaxing rough_rates(const gg_model *m, gg_relaxing x)
{
  const gg_exchange lost =
      gg_theory_exchange_at(gg_theory_grain_of(m), m->rule == GG_FRICTIONAL ? m->mu[0] : INFINITY, x.theta / x.T);
  const double energy = gg_common_model_collision_rate(m, x.T) * x.T / 3;
  const gg_bath none = {0}, *b = m->bath.on ? &m->bath : &none;
  return (gg_relaxing){.T = energy * lost.translation - 2 * drag_of(m) * x.T + noise_of(m),
                       .theta =
                           energy * lost.rotation - 2 * b->spin_drag[0] * x.theta + m->inertia[0] * b->spin_noise[0]};
}

static gg_relaxing rates(const gg_model *m, gg_relaxing x)
{
  gg_relaxing r = m->rule == GG_SMOOTH ? smooth_rates(m, x) : rough_rates(m, x);
  if (gg_common_heat_of(m) != GG_HEAT_SCALES) return r;
  r.T = 0; /* cooling changes velocities by a factor, and a2 stays */
  return r;
}

static gg_relaxing moved(gg_relaxing x, double dt, gg_relaxing r)
{
  x.T += dt * r.T, x.theta += dt * r.theta, x.a2 += dt * r.a2;
  return x;
}

/* The fourth-order Runge-Kutta method. */
static gg_relaxing step(const gg_model *m, gg_relaxing x, double dt)
{
  const gg_relaxing a = rates(m, x), b = rates(m, moved(x, dt / 2, a)), c = rates(m, moved(x, dt / 2, b)),
                    d = rates(m, moved(x, dt, c));
  return moved(moved(moved(moved(x, dt / 6, a), dt / 3, b), dt / 3, c), dt / 6, d);
}

static void relax_moments(const gg_model *m, double time, gg_relaxing *x)
{
  gg_theory_gaussian_relax(m, time, x);
  if (gg_model_is_sheared(m)) x->P = gg_theory_gaussian_stress(m, x->of);
  x->T = x->theta = 0;
  for (int i = 0; i < m->n_species; i++) {
    const double share = m->mass[i] * m->fraction[i];
    x->T += share * gg_tensor_trace(x->of[i].M) / 3;
    if (m->rule != GG_SMOOTH) x->theta += share * m->inertia[i] * gg_tensor_trace(x->of[i].Theta) / 3;
  }
}

/* Steps that are short beside the collision time and the times of drag and noise. */
static void relax_temperatures(const gg_model *m, double time, gg_relaxing *x)
{
  const double seconds = 1e-6; /* of a step */
  for (unsigned k = 1; time > 0 && x->work >= 0; k++) {
    if (k % 1024 == 0 && x->stop && gg_stop_asked(x->stop)) return;
    const double rate = gg_common_model_collision_rate(m, x->T);
    const double fastest =
        rate + 2 * fabs(drag_of(m)) + noise_of(m) / x->T + (m->bath.on ? 2 * m->bath.spin_drag[0] : 0);
    const double dt = fmin(time, 0.05 / fastest);
    *x = step(m, *x, dt);
    x->collisions += dt * rate, x->work -= seconds;
    time = dt < time ? time - dt : 0;
  }
}

void gg_theory_relax(const gg_model *m, double time, gg_relaxing *x)
{
  gg_base_gsl_enter();
  if (x->work >= 0) (gg_theory_gaussian_relaxes(m) ? relax_moments : relax_temperatures)(m, time, x);
  gg_base_gsl_leave();
  if (x->work < 0) *x = gg_theory_relaxation_lost();
}
