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

/* 1.019 and 1.016 are the ratios of the full to the first Sonine approximation (Chapman & Cowling). */
static double self_diffusion(const gg_model *m, double T, double mass)
{
  return 1.019 * 3 / (8 * m->density * one_fluid(m, m->sigma, 2) * one_fluid(m, m->chi, 1)) * sqrt(T / mass / M_PI);
}

static double kinematic_viscosity(const gg_model *m, double T, double mass)
{
  const double chi = one_fluid(m, m->chi, 1), x = m->phi * chi;
  const double dilute = 1.016 * 5 / (16 * m->density * one_fluid(m, m->sigma, 2)) * sqrt(T / mass / M_PI);
  return dilute * ((1 + 1.6 * x) * (1 + 1.6 * x) / chi + 768 / (25 * M_PI) * x * m->phi);
}

static double mass_of_all(const gg_model *m)
{
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i];
  return mass;
}

gg_long_time_tail gg_measure_long_time_tail_of(const gg_model *m, double T)
{
  const double mass = mass_of_all(m), mean = mass / (double)m->n;
  gg_long_time_tail tail = {.strength = 2.0 / 3 * T / mass, .amplitude = 1, .tolerance = 0.3};
  double kappa = self_diffusion(m, T, mean) + kinematic_viscosity(m, T, mean);
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

/* Sum over the remaining modes, without k = 0. */
static double modes(const gg_long_time_tail *tail, double t)
{
  double x = theta_less_one(tail->rate[0] * t), y = theta_less_one(tail->rate[1] * t);
  double z = theta_less_one(tail->rate[2] * t);
  return x + y + z + x * y + y * z + z * x + x * y * z;
}

/* Integral in ln t by Simpson's rule, up to the decay of the slowest mode. */
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

/* The integral over all times of the modes of an infinite gas minus those of the box, at a rate of 1 for k = 1. At
 * first the sum over k is (pi/t)^(3/2) over the edges' rates for both, so that the box lacks the mode k = 0 alone;
 * in the end it lacks all of them. In ln t by Simpson's rule, with the parts before and after. */
static double lacking_of_box(const gg_long_time_tail *tail)
{
  enum { STEPS = 256 };
  const double *rate = tail->rate, slowest = fmin(fmin(rate[0], rate[1]), rate[2]),
               fastest = fmax(fmax(rate[0], rate[1]), rate[2]);
  const double from = 0.05 / fastest, to = 30 / slowest, step = log(to / from) / STEPS;
  const double free = sqrt(M_PI / rate[0]) * sqrt(M_PI / rate[1]) * sqrt(M_PI / rate[2]);
  double sum = 0;
  for (int i = 0; i <= STEPS; i++) {
    const double t = from * exp(i * step), weight = i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2;
    sum += weight * t * (free * pow(t, -1.5) - modes(tail, t));
  }
  return from + sum * step / 3 + 2 * free / sqrt(to);
}

double gg_measure_long_time_tail_lacking(const gg_model *m, double T)
{
  gg_long_time_tail tail = gg_measure_long_time_tail_of(m, T);
  for (int a = 0; a < 3; a++) tail.rate[a] = pow(2 * M_PI / m->box[a], 2);
  return tail.strength * lacking_of_box(&tail) / kinematic_viscosity(m, T, mass_of_all(m) / (double)m->n);
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
