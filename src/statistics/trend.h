/* Is a stretch of a series stationary? Compare its first and last third: a relaxation still under way, or a slow drift,
 * shows as a difference beyond its error. */
#ifndef GG_DRIFT_H
#define GG_DRIFT_H

#include "statistics/estimator.h"

typedef struct gg_drift {
  double z;        /* (last third - first third)/combined error; NaN if too short to tell */
  double relative; /* the difference over the mean */
  double correlation_rows;
} gg_drift;

/* y: n_runs stretches of n rows end to end. The error takes the correlation time of the whole stretch into account,
 * which a drift inflates: the test errs towards calling a clear drift by its size (`relative`), too. */
gg_status gg_drift_test(const double *y, size_t n, size_t n_runs, gg_drift *out, gg_error *err);

#endif
