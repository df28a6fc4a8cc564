/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Autocorrelation of a stationary series by FFT, and its integrated correlation time. */
#ifndef GG_AUTOCORRELATION_H
#define GG_AUTOCORRELATION_H

#include "statistics/series.h"

#include <stddef.h>

/* Correlation of `n_runs` independent stretches of `n` rows each, end to end, about their common mean 0. */
typedef struct gg_correlation {
  double time;   /* integrated: 1/2 + sum_{t>=1} rho(t), in rows (1/2: uncorrelated); variance of the mean: 2 time
                    var/rows */
  double slow;   /* mean lag of the sum, at least `time`: nearer to the slowest of several times */
  double memory; /* correlation time of the parts of the series, if it is longer and the sum extended over it; else 0 */
  size_t window; /* end of the sum: the first t > 8 tau(t) (Madras & Sokal, J. Stat. Phys. 50 (1988) 109), or two
                    neighbouring lags whose covariances add up to nothing, but at least 2.5 memories */
  double *rho;   /* 0 .. window */
} gg_correlation;

/* Every covariance is too small by the variance of the mean, because the mean is taken from the series itself: this
 * variance is added (Wolff, Comput. Phys. Commun. 156 (2004) 143, eq. 49). A series that is too short for its
 * correlation time still gives too small values: 50 times as many rows are needed. `memory`: correlation time, in
 * rows, of a slower series of which this one is made, and which it may remember with the opposite sign; 0 without
 * one. */
gg_status gg_statistics_correlation_of(const double *x, size_t n, size_t n_runs, double memory, gg_correlation *c,
                                       gg_error *err);
void gg_statistics_correlation_clear(gg_correlation *c);

/* Variance of the mean of `length` successive rows, over that of as many independent ones. */
double gg_statistics_correlation_inflation(const gg_correlation *c, size_t length);

/* Decay time of a slow mode, from windows that are not much longer. An integral of its correlation function needs a
 * window of 50 correlation times, is too small by a factor of two for ten, and would accept short windows. The lag
 * at which the function has fallen by a factor e is better known.
 *
 * Unit: rows, of n_runs stretches of n rows end to end, each a mode with white noise added. Result: the lag over
 * which the correlation falls by a factor e from that at lag 1, corrected for the mean being that of the rows
 * themselves; 1/2 if neighbours are not correlated; n if the correlation never falls so far. */
double gg_statistics_decay_time(const double *y, size_t n, size_t n_runs);

/* Means of a channel over equal parts of a series' window, of `rows` each; rows that are left over are the first. */
void gg_statistics_parts(const gg_series *s, size_t channel, size_t parts, size_t rows, double *y);

/* Scatter of the part of y that is proportional to the square of x, both about their means. */
double gg_statistics_scatter_by_square(const double *x, const double *y, size_t n);

#endif
