/* Autocorrelation of a stationary series by FFT, and its integrated correlation time. */
#ifndef GG_AUTOCORRELATION_H
#define GG_AUTOCORRELATION_H

#include "common/error.h"

/* Integrated autocorrelation time tau = 1/2 + sum_{t>=1} rho(t), in rows (1/2: uncorrelated), of `n_runs` independent
 * stretches of `n` rows each, laid end to end in x, about their common mean 0. The sum stops at the first t > 5 tau(t)
 * (Sokal's window; Madras & Sokal, J. Stat. Phys. 50 (1988) 109). Variance of the mean: 2 tau var/(n n_runs).
 * A series too short for its tau gives an underestimate: ask for n > 50 tau. */
gg_status gg_correlation_time(const double *x, size_t n, size_t n_runs, double *tau, gg_error *err);

#endif
