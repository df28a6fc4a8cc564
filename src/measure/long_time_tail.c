/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/long_time_tail.h"

#include <math.h>

/* Mean over pairs of species. */
static double one_fluid(const gg_model *m, const double of_pair[GG_PAIRS], int power)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++)
      sum += (double)m->n_of[i] / (double)m->n * (double)m->n_of[j] / (double)m->n * pow(of_pair[gg_pair(i, j)], power);
  return sum;
}

/* D + nu: 1.019 and 1.016 are the ratios of the full to the first Sonine approximation (Chapman & Cowling). */
static double vorticity_diffusion(const gg_model *m, double T, double mass)
{
  double chi = one_fluid(m, m->chi, 1), area = one_fluid(m, m->sigma, 2), x = m->phi * chi, v = sqrt(T / mass / M_PI);
  double D = 1.019 * 3 / (8 * m->density * area * chi) * v;
  double nu0 = 1.016 * 5 / (16 * m->density * area) * v;
  return D + nu0 * ((1 + 1.6 * x) * (1 + 1.6 * x) / chi + 768 / (25 * M_PI) * x * m->phi);
}

gg_long_time_tail gg_measure_long_time_tail_of(const gg_model *m, double T)
{
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i];
  gg_long_time_tail tail = {.strength = 2.0 / 3 * T / mass, .amplitude = 1, .tolerance = 0.3};
  double kappa = vorticity_diffusion(m, T, mass / (double)m->n);
  for (int a = 0; a < 3; a++) tail.rate[a] = kappa * pow(2 * M_PI / m->box[a], 2);
  return tail;
}

gg_long_time_tail gg_measure_long_time_tail_driven(double left, double t)
{
  return (gg_long_time_tail){.driven = true, .strength = left * pow(t, 1.5), .amplitude = 1, .tolerance = 1};
}

/* sum_n exp(-u n^2) - 1 over all integers, from the side where it converges faster. */
static double theta_less_one(double u)
{
  bool direct = u > M_PI;
  double sum = 0, v = direct ? u : M_PI * M_PI / u;
  for (int n = 1; n <= 4; n++) sum += 2 * exp(-v * n * n);
  return direct ? sum : sqrt(M_PI / u) * (1 + sum) - 1;
}

/* Modes other than k = 0 that are left. */
static double modes(const gg_long_time_tail *tail, double t)
{
  double x = theta_less_one(tail->rate[0] * t), y = theta_less_one(tail->rate[1] * t);
  double z = theta_less_one(tail->rate[2] * t);
  return x + y + z + x * y + y * z + z * x + x * y * z;
}

/* In ln t by Simpson's rule, to where the slowest mode has gone. */
double gg_measure_long_time_tail_beyond(const gg_long_time_tail *tail, double t)
{
  enum { STEPS = 64 };
  if (tail->driven) return tail->strength * pow(t, -1.5);
  double slowest = fmin(fmin(tail->rate[0], tail->rate[1]), tail->rate[2]), end = fmax(t, 1 / slowest) + 30 / slowest;
  double step = log(end / t) / STEPS, sum = 0;
  for (int i = 0; i <= STEPS; i++) {
    double at = t * exp(i * step), weight = i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2;
    sum += weight * at * modes(tail, at);
  }
  return tail->strength * sum * step / 3;
}

gg_coefficient gg_measure_long_time_tail_coefficient(const gg_long_time_tail *tail, const gg_running *at, int n)
{
  if (n < 1) return (gg_coefficient){NAN, NAN, NAN};
  double first = gg_measure_long_time_tail_beyond(tail, at[0].t), before = first;
  double expected = 1 / (tail->tolerance * tail->tolerance), weights = expected, sum = expected * tail->amplitude;
  for (int j = 1; j < n; j++) {
    double now = gg_measure_long_time_tail_beyond(tail, at[j].t), fall = before - now;
    double variance = at[j].noise * (at[j].t - at[j - 1].t);
    sum += fall * (at[j].D - at[j - 1].D) / variance;
    weights += fall * fall / variance;
    before = now;
  }
  double rest = first * sum / weights;
  return (gg_coefficient){at[0].D + rest, rest, first * tail->tolerance * expected / weights};
}
