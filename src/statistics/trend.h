/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stationarity test of a stretch of a series. It compares the first and the last third: an unfinished relaxation, or
 * a slow trend, is a difference beyond its error. It also compares the very beginning with the last two thirds: a
 * short relaxation makes the first third scatter so much that the difference of thirds is within its error, and yet
 * shifts the mean. */
#ifndef GG_TREND_H
#define GG_TREND_H

#include "statistics/estimator.h"

typedef struct gg_trend {
  double z;        /* of the largest difference: difference over error, as a normal variable; NaN if too short */
  double relative; /* the difference over the mean; for a beginning: its shift of the mean over all rows */
  double share;    /* fraction of the rows that were compared with later ones: a third, or that of the beginning */
  double correlation_rows;
} gg_trend;

/* y: n_runs stretches of n rows end to end. Errors come from the scatter of blocks alone: with correlations a trend
 * within a third would count as a long correlation, and hide itself. */
gg_status gg_statistics_trend_test(const double *y, size_t n, size_t n_runs, gg_trend *out, gg_error *err);

#endif
