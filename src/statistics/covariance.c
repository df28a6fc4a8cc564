/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/covariance.h"

#include <math.h>
#include <stdbool.h>

#include "statistics/estimator.h"

/* A mean is measured in itself, since most combinations are ratios and products; nearer to zero in its error. */
#define NEAR_ZERO 10

gg_status gg_statistics_varying_make(gg_varying *v, double mean, double error, const double *row, size_t n_rows,
                                     size_t n_runs, gg_error *err)
{
  gg_mean m;
  GG_TRY(gg_statistics_estimate_scalar(row, n_rows, n_runs, &m, err));
  *v = (gg_varying){.row = row, .unit = fabs(mean) > NEAR_ZERO * error ? mean : error};
  v->variance = pow(error / v->unit, 2);
  v->enlarged = pow(error / m.error, 2);
  v->memory = m.correlation_rows;
  return GG_OK;
}

/* Variance of the mean of a + sign b, enlarged as the errors of both are. */
static gg_status variance_of_sum(const gg_varying *a, const gg_varying *b, int sign, size_t n_rows, size_t n_runs,
                                 double *sum, double *variance, gg_error *err)
{
  gg_mean m;
  for (size_t i = 0; i < n_rows * n_runs; i++) sum[i] = a->row[i] / a->unit + sign * b->row[i] / b->unit;
  GG_TRY(gg_statistics_estimate_made_of(sum, n_rows, n_runs, fmax(a->memory, b->memory), &m, err));
  *variance = m.error * m.error * sqrt(a->enlarged * b->enlarged);
  return GG_OK;
}

/* True if the two means rise and fall together. */
static bool go_together(const gg_varying *a, const gg_varying *b, size_t n)
{
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a->row[i] / a->unit * (b->row[i] / b->unit);
  return sum > 0;
}

gg_status gg_statistics_correlation_coefficient(const gg_varying *a, const gg_varying *b, size_t n_rows, size_t n_runs,
                                                double *scratch, double *coefficient, gg_error *err)
{
  double variance;
  *coefficient = 0;
  if (!(a->variance > 0 && b->variance > 0)) return GG_OK; /* a constant */
  const int sign = go_together(a, b, n_rows * n_runs) ? -1 : 1;
  GG_TRY(variance_of_sum(a, b, sign, n_rows, n_runs, scratch, &variance, err));
  if (!isfinite(variance)) return GG_OK;
  const double covariance = sign * (variance - a->variance - b->variance) / 2 * (a->unit * b->unit < 0 ? -1 : 1);
  *coefficient = fmax(-1, fmin(covariance / sqrt(a->variance * b->variance), 1));
  return GG_OK;
}
