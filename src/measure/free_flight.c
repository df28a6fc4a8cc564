#include "measure/free_flight.h"

#include <math.h>

/* nu over that of a grain at rest, times 2; x = c/sqrt(2T). */
static double rate_at(double x)
{
  return exp(-x * x) + (2 * x + 1 / x) * 0.5 * sqrt(M_PI) * erf(x);
}

enum { SPEEDS = 60 };

/* Midpoints up to six thermal speeds: exact to rounding for times, whose integrands vanish with their derivatives at
 * both ends, and to half a thousandth for the shortest paths. `by_length`: flights counted by length instead of
 * duration. */
static double density(double at, double mean, bool by_length)
{
  double flights = 0, sum = 0, total = 0, fall[SPEEDS], weight[SPEEDS];
  for (int i = 0; i < SPEEDS; i++) {
    double x = 6 * (i + 0.5) / SPEEDS;
    fall[i] = by_length ? rate_at(x) / x : rate_at(x);
    weight[i] = x * x * exp(-x * x) * rate_at(x);
    flights += weight[i];
    total += weight[i] / fall[i];
  }
  double unit = total / flights / mean; /* of lengths or times, over that of the integral */
  for (int i = 0; i < SPEEDS; i++) sum += weight[i] * fall[i] * exp(-fall[i] * at * unit);
  return sum / flights * unit;
}

double gg_free_time_law(double t, const double *mean)
{
  return density(t, *mean, false);
}

double gg_free_path_law(double l, const double *mean)
{
  return density(l, *mean, true);
}
