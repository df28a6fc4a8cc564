#include "statistics/trend.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_statistics_double.h>

/* Copy rows [from, from + m) of every run. */
static void cut(const double *y, size_t n, size_t n_runs, size_t from, size_t m, double *to)
{
  for (size_t r = 0; r < n_runs; r++)
    for (size_t i = 0; i < m; i++) to[r * m + i] = y[r * n + from + i];
}

gg_status gg_trend_test(const double *y, size_t n, size_t n_runs, gg_trend *out, gg_error *err)
{
  *out = (gg_trend){.z = NAN, .relative = NAN, .correlation_rows = 0.5};
  size_t third = n / 3;
  if (third < 8) return GG_OK;
  double *part = gg_new_array(third * n_runs, sizeof *part, err);
  if (!part) return GG_FAILED;
  gg_mean first, last;
  cut(y, n, n_runs, 0, third, part);
  gg_status status = gg_estimate_scalar(part, third, n_runs, &first, err);
  cut(y, n, n_runs, n - third, third, part);
  if (status == GG_OK) status = gg_estimate_scalar(part, third, n_runs, &last, err);
  free(part);
  if (status != GG_OK) return status;
  double change = last.mean - first.mean, error = hypot(first.scatter, last.scatter);
  out->z = error > 0 ? change / error : change == 0 ? 0 : INFINITY * (change > 0 ? 1 : -1);
  out->relative = change / fmax(fabs(first.mean + last.mean) / 2, 1e-300);
  out->correlation_rows = fmax(first.correlation_rows, last.correlation_rows);
  return GG_OK;
}
