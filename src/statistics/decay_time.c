#include "statistics/decay_time.h"

#include <math.h>

static double covariance(const double *y, size_t n, size_t n_runs, double mean, size_t lag)
{
  double sum = 0;
  for (size_t r = 0; r < n_runs; r++)
    for (size_t i = 0; i + lag < n; i++) sum += (y[r * n + i] - mean) * (y[r * n + i + lag] - mean);
  return sum / (double)(n_runs * (n - lag));
}

/* Variance of the mean of n rows of a mode with this decay time, over that of the mode. */
static double of_mean(double tau, double n)
{
  return 2 * tau / n * (1 - tau / n * (1 - exp(-n / tau)));
}

double gg_statistics_decay_time(const double *y, size_t n, size_t n_runs)
{
  double mean = 0, rows = (double)(n * n_runs);
  if (n < 4) return 0.5;
  for (size_t i = 0; i < n * n_runs; i++) mean += y[i] / rows;
  double first = covariance(y, n, n_runs, mean, 1);
  if (!(first > 2 / sqrt(rows) * covariance(y, n, n_runs, mean, 0))) return 0.5; /* noise has as much */
  for (size_t lag = 1; lag + 1 < n; lag++) {
    double tau = (double)lag, v = of_mean(tau, (double)n) / (double)n_runs;
    double seen = covariance(y, n, n_runs, mean, lag + 1) / first;
    if (seen * (exp(-1 / tau) - v) <= exp(-1 - 1 / tau) - v) return tau;
  }
  return (double)n;
}
