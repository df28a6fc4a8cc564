/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How two means over one window vary together. */
#ifndef GG_COVARIANCE_H
#define GG_COVARIANCE_H

#include <stddef.h>

#include "base/error.h"

typedef struct gg_varying {
  const double *row; /* linear response */
  double unit;
  double variance; /* of the mean, in that unit squared: its error as reported */
  double enlarged; /* this over the estimate from these rows */
  double memory;   /* correlation time in rows */
} gg_varying;

/* A mean with its reported error; `row`: blocks of its linear response (gg_statistics_response_blocks), n_rows of each
 * of n_runs. */
gg_status gg_statistics_varying_make(gg_varying *v, double mean, double error, const double *row, size_t n_rows,
                                     size_t n_runs, gg_error *err);
/* Correlation coefficient of two means. If they vary together, their difference has a small variance, which would be
 * lost in the inaccuracy of both errors. So the covariance is chosen such that the difference has the variance of its
 * own series of blocks. For means that vary oppositely, the sum is used. `scratch`: n_rows n_runs numbers. */
gg_status gg_statistics_correlation_coefficient(const gg_varying *a, const gg_varying *b, size_t n_rows, size_t n_runs,
                                                double *scratch, double *coefficient, gg_error *err);

#endif
