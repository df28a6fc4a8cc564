/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means and their standard errors. A quantity is a function f of channel means (a plain mean, a ratio, a difference
 * of stresses). Its error comes from the series of its linear response to each row,
 *   y_t = f(a) + sum_i (df/da_i)(a_i,t - a_i),
 * so that correlations between channels and in time are both included. The standard error follows from the scatter
 * of blocks of y much longer than its correlation time (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461). Two
 * factors enlarge it: one for the correlation of neighbouring blocks (a few per cent, in short windows a quarter),
 * and a small one for the uncertainty of the scatter itself. So mean +- error and mean +- 1.96 error contain the
 * true value in 68 and 95 of 100 cases. */
#ifndef GG_ESTIMATOR_H
#define GG_ESTIMATOR_H

#include "common/model.h"
#include "statistics/series.h"

/* Value of a quantity for given channel means; NaN where it has none. For a family: the value of one member (a
 * species). */
typedef double gg_of_means(const double *mean, const gg_model *model);
typedef double gg_member_of_means(const double *mean, const gg_model *model, int member);

/* A quantity as a function of channel means: plain, or a member of a family. */
typedef struct gg_function {
  gg_of_means *of;
  gg_member_of_means *each; /* where `of` is NULL */
  int member;
  const char *unknown; /* why its value is NaN; NULL: nobody knows */
} gg_function;

static inline double gg_function_value(gg_function f, const double *mean, const gg_model *model)
{
  return f.of ? f.of(mean, model) : f.each(mean, model, f.member);
}

typedef struct gg_mean {
  double mean, error;      /* NaN if unknown */
  double scatter;          /* the error if blocks were independent */
  double correlation_rows; /* integrated correlation time, rows */
  size_t blocks;           /* independent blocks behind the error */
  bool trusted;            /* at least GG_MIN_BLOCKS blocks of at least 5 correlation times */
} gg_mean;

enum { GG_MIN_BLOCKS = 16, GG_MAX_BLOCKS = 64 };

/* Rows [begin, end) of each of n_runs series of equal length and width. `offset` is the observable's first channel
 * in a row, `channels` the number of channels on which f depends. `slow`: the decay time, in rows, of a mode that is
 * slower than the window can resolve and that f may follow; 0: none is known. */
gg_status gg_statistics_estimate_mean(const gg_series *const *series, size_t n_runs, size_t begin, size_t end,
                                      size_t offset, size_t channels, gg_function f, const gg_model *model, double slow,
                                      gg_mean *out, gg_error *err);

/* Means of the linear response over blocks of `length` rows, n_runs floor((end - begin)/length) of them, about the
 * mean of all rows. The covariance of two quantities of one window follows from them. All 0 where f has no value. */
gg_status gg_statistics_response_blocks(const gg_series *const *series, size_t n_runs, size_t begin, size_t end,
                                        size_t offset, size_t channels, gg_function f, const gg_model *model,
                                        size_t length, double *blocks, gg_error *err);

/* Factor on an error that is taken from the scatter of n >= 2 independent numbers: the scatter itself is uncertain.
 * With this factor the mean square of deviation over error is 1.02 for 8 numbers, 1.00 for 16 and more; without it is
 * that of Student's t, (n - 1)/(n - 3). Mean +- error then holds the truth in 72 % of cases for 8 numbers and in 70 %
 * for 16, mean +- 1.96 error in 95 %. The expansion of sqrt((n - 1)/(n - 3)) in 1/(n - 1): finite for 2 and 3 numbers,
 * too. */
static inline double gg_statistics_student(size_t n)
{
  const double x = 1 / (double)(n - 1);
  return 1 + x * (1 + 1.5 * x);
}

/* f at one instant over n_runs independent runs: its value for the means of their rows, and its error by leaving out
 * one run at a time. This is the function of the means, not the mean of f: for a ratio to a rate that counts a few
 * collisions in each run, the mean is biased and scatters without bound. `scratch`: 2 x channels. The error of one
 * run is NaN. */
gg_mean gg_statistics_estimate_over_runs(const double *const *row, size_t n_runs, size_t channels, gg_function f,
                                         const gg_model *model, double *scratch);

/* Mean of n >= 1 numbers; for equal numbers exactly that number. (GSL's function has a long-double division for
 * each.) */
double gg_statistics_mean(const double *y, size_t n);

/* gg_statistics_estimate_mean for a scalar series, n_runs stretches of n rows end to end. */
gg_status gg_statistics_estimate_scalar(const double *y, size_t n, size_t n_runs, gg_mean *out, gg_error *err);
/* The same for a series that is made of a slower one, of this correlation time in rows
 * (gg_statistics_correlation_of). */
gg_status gg_statistics_estimate_made_of(const double *y, size_t n, size_t n_runs, double memory, gg_mean *out,
                                         gg_error *err);

#endif
