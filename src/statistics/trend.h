/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is a stretch of a series stationary? Compare its first and last third: a relaxation still under way, or a slow trend,
 * shows as a difference beyond its error. And its very beginning with the latter two thirds: a relaxation that is over
 * soon makes the first third scatter so much that a difference of thirds hides in it, and yet shifts the mean. */
#ifndef GG_TREND_H
#define GG_TREND_H

#include "statistics/estimator.h"

typedef struct gg_trend {
  double z;        /* of the comparison that differs most: difference over error, as of a normal variable; NaN if too
                      short to tell */
  double relative; /* the difference over the mean; of a beginning as much as it shifts the mean over all rows */
  double share;    /* of the rows, that were compared with what is later: a third, or those of the beginning */
  double correlation_rows;
} gg_trend;

/* y: n_runs stretches of n rows end to end. Errors come from the scatter of blocks alone: a trend within a third would
 * pass for a long correlation, and hide itself. */
gg_status gg_statistics_trend_test(const double *y, size_t n, size_t n_runs, gg_trend *out, gg_error *err);

#endif
