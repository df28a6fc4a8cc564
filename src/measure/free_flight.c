/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/free_flight.h"

#include <math.h>

/* nu over that of a grain at rest, times 2; x = c/sqrt(2T/m) of its partners. */
static double rate_at(double x)
{
  return exp(-x * x) + (2 * x + 1 / x) * 0.5 * sqrt(M_PI) * erf(x);
}

enum { SPEEDS = GG_FLIGHT_SPEEDS };

/* Speed in sqrt(2T/m) of the grain itself: midpoints up to six. */
static double speed_at(int i)
{
  return 6 * (i + 0.5) / SPEEDS;
}

void gg_measure_free_flight_of(const gg_model *m, int species, double law[GG_FLIGHT_LAW])
{
  double own = m->mass[species];
  for (int i = 0; i < GG_FLIGHT_LAW; i++) law[i] = 0;
  for (int j = 0; j < m->n_species; j++) {
    int q = gg_pair(species, j), qq = gg_pair(species, species);
    double slower = sqrt(m->mass[j] / own), width = m->sigma[q] / m->sigma[qq];
    double share = (double)m->n_of[j] / (double)m->n_of[species] * width * width * m->chi[q] / m->chi[qq] / slower;
    for (int i = 0; i < SPEEDS; i++) law[1 + i] += share * rate_at(slower * speed_at(i));
  }
}

/* Exact to rounding for times of like grains, whose integrands vanish with their derivatives at both ends, and to half
 * a thousandth for the shortest paths. `by_length`: flights counted by length instead of duration. */
static double density(double at, const double *law, bool by_length)
{
  double flights = 0, sum = 0, total = 0, fall[SPEEDS], weight[SPEEDS];
  for (int i = 0; i < SPEEDS; i++) {
    double x = speed_at(i), rate = law[1 + i];
    fall[i] = by_length ? rate / x : rate;
    weight[i] = x * x * exp(-x * x) * rate;
    flights += weight[i];
    total += weight[i] / fall[i];
  }
  double unit = total / flights / law[GG_FLIGHT_MEAN]; /* unit of lengths or times, over that of the integral */
  for (int i = 0; i < SPEEDS; i++) sum += weight[i] * fall[i] * exp(-fall[i] * at * unit);
  return sum / flights * unit;
}

double gg_measure_free_time_law(double t, const double *law)
{
  return density(t, law, false);
}

double gg_measure_free_path_law(double l, const double *law)
{
  return density(l, law, true);
}
