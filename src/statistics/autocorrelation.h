/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Autocorrelation of a stationary series by FFT, and its integrated correlation time. */
#ifndef GG_AUTOCORRELATION_H
#define GG_AUTOCORRELATION_H

#include "base/error.h"

#include <stddef.h>

/* Of `n_runs` independent stretches of `n` rows each, laid end to end, about their common mean 0. */
typedef struct gg_correlation {
  double time;   /* integrated: 1/2 + sum_{t>=1} rho(t), in rows (1/2: uncorrelated); variance of the mean: 2 time
                    var/rows */
  double slow;   /* mean lag of the sum, at least `time`: nearer to the slowest of several times */
  double memory; /* of what the series is made of, if that is longer and the sum extended over it; else 0 */
  size_t window; /* the sum goes so far: to the first t > 8 tau(t) (Madras & Sokal, J. Stat. Phys. 50 (1988) 109), or
                    to where two neighbouring lags have nothing left between them, but over 2.5 memories at least */
  double *rho;   /* 0 .. window */
} gg_correlation;

/* That the mean is itself taken from the series makes every covariance too small by the variance of the mean: it is put
 * back (Wolff, Comput. Phys. Commun. 156 (2004) 143, eq. 49). Still, a series too short for its time gives too little:
 * ask for 50 times as many rows. `memory`: correlation time, in rows, of a slower series that this one is made of, and
 * may remember with the opposite sign; 0 if there is none. */
gg_status gg_statistics_correlation_of(const double *x, size_t n, size_t n_runs, double memory, gg_correlation *c,
                                       gg_error *err);
void gg_statistics_correlation_clear(gg_correlation *c);

/* Variance of the mean of `length` successive rows, over that of as many independent ones. */
double gg_statistics_correlation_inflation(const gg_correlation *c, size_t length);

/* How long a slow mode remembers, from windows that are not much longer than that. An integral of its correlation
 * function needs a window of 50 correlation times, comes out half as long from ten, and calls short windows long
 * enough; when the function has fallen by a factor e is known better.
 *
 * In rows, of n_runs stretches of n rows end to end, each a mode with white noise on top: the lag over which the
 * correlation falls by a factor e from that at lag 1, allowing for the mean being that of the rows themselves. 1/2
 * where neighbours are not correlated; n where it never falls so far. */
double gg_statistics_decay_time(const double *y, size_t n, size_t n_runs);

#endif
