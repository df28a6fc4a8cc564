/* Is a stretch of a series stationary? Compare its first and last third: a relaxation still under way, or a slow trend,
 * shows as a difference beyond its error. */
#ifndef GG_TREND_H
#define GG_TREND_H

#include "statistics/estimator.h"

typedef struct gg_trend {
  double z;        /* (last third - first third)/combined error; NaN if too short to tell */
  double relative; /* the difference over the mean */
  double correlation_rows;
} gg_trend;

/* y: n_runs stretches of n rows end to end. The error comes from the scatter of blocks alone: a trend within a third
 * would pass for a long correlation, and hide itself. */
gg_status gg_trend_test(const double *y, size_t n, size_t n_runs, gg_trend *out, gg_error *err);

#endif
