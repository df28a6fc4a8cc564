/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/trend.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

#include <gsl/gsl_cdf.h>

/* Copy rows [from, from + m) of every run. */
static void cut(const double *y, size_t n, size_t n_runs, size_t from, size_t m, double *to)
{
  for (size_t r = 0; r < n_runs; r++)
    for (size_t i = 0; i < m; i++) to[r * m + i] = y[r * n + from + i];
}

/* Lengths of the tested beginning, as parts of all rows. The shortest is as long as the memory of the slowest mode
 * for which a window is planned. */
static const size_t beginnings[] = {48, 12};

/* The normal variable of the same probability as Student's t; beyond 8, where both are negligible, t itself. */
static double as_normal(double t, double degrees)
{
  double z = fabs(t) < 40 ? -gsl_cdf_ugaussian_Pinv(gsl_cdf_tdist_Q(fabs(t), degrees)) : INFINITY;
  return copysign(z < 8 ? z : fmin(fabs(t), z), t);
}

/* Compare the first rows with the scatter of blocks of the same length from the last two thirds. */
static void compare_beginning(const double *y, size_t n, size_t n_runs, size_t length, gg_trend *out)
{
  size_t per_run = length ? (n - n / 3) / length : 0, count = per_run * n_runs;
  double first = 0, mean = 0, squares = 0;
  if (count < 3) return;
  for (size_t r = 0; r < n_runs; r++) {
    const double *run = y + r * n;
    first += gg_statistics_mean(run, length) / (double)n_runs;
    for (size_t b = 0; b < per_run; b++) {
      double block = gg_statistics_mean(run + n - (b + 1) * length, length), before = mean;
      mean += (block - mean) / (double)(r * per_run + b + 1);
      squares += (block - before) * (block - mean);
    }
  }
  double error = sqrt(squares / (double)(count - 1) * (1 / (double)n_runs + 1 / (double)count));
  double z = error > 0 ? as_normal((mean - first) / error, (double)(count - 1)) : 0;
  if (!(fabs(z) > fabs(out->z))) return;
  out->z = z;
  out->share = (double)length / (double)n;
  out->relative = (mean - first) * out->share / fmax(fabs(mean), 1e-300);
}

gg_status gg_statistics_trend_test(const double *y, size_t n, size_t n_runs, gg_trend *out, gg_error *err)
{
  *out = (gg_trend){.z = NAN, .relative = NAN, .share = 1 / 3.0, .correlation_rows = 0.5};
  size_t third = n / 3;
  if (third < 8) return GG_OK;
  double *part = gg_base_array_new(third * n_runs, sizeof *part, err);
  if (!part) return GG_FAILED;
  gg_mean first, last;
  cut(y, n, n_runs, 0, third, part);
  gg_status status = gg_statistics_estimate_scalar(part, third, n_runs, &first, err);
  cut(y, n, n_runs, n - third, third, part);
  if (status == GG_OK) status = gg_statistics_estimate_scalar(part, third, n_runs, &last, err);
  free(part);
  if (status != GG_OK) return status;
  double change = last.mean - first.mean, error = hypot(first.scatter, last.scatter);
  out->z = error > 0 ? change / error : change == 0 ? 0 : INFINITY * (change > 0 ? 1 : -1);
  out->relative = change / fmax(fabs(first.mean + last.mean) / 2, 1e-300);
  out->correlation_rows = fmax(first.correlation_rows, last.correlation_rows);
  for (size_t k = 0; k < sizeof beginnings / sizeof *beginnings; k++)
    compare_beginning(y, n, n_runs, n / beginnings[k], out);
  return GG_OK;
}
