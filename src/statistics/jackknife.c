/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/jackknife.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "statistics/estimator.h"

/* BESIDE: number of points of the curve that are averaged with a number derived from it. Four would make errors of
 * exponents a little better, and those of moments, which have a longer memory than most points, too small. */
enum { ARRAYS = 6, NEIGHBOURS = 4, BESIDE = 2 };
#define STRONGEST 0.9        /* correlation above which a block adds no information */
#define LEAST_MEMORY 0.02    /* in blocks: a shorter memory makes no difference */
#define MOST_OF_VARIANCE 0.9 /* largest fraction of a block's variance in the mean of all: above it nothing is known   \
                              */

gg_status gg_statistics_jackknife_init(gg_jackknife *j, size_t width, gg_error *err)
{
  *j = (gg_jackknife){.width = width, .first = true};
  double *all = gg_base_array_new(ARRAYS * width + 1, sizeof *all, err);
  if (!all) return GG_FAILED;
  double **arrays[ARRAYS] = {&j->now, &j->before, &j->sum, &j->squares, &j->products, &j->ends};
  for (size_t k = 0; k < ARRAYS; k++) *arrays[k] = all + k * width;
  return GG_OK;
}

void gg_statistics_jackknife_clear(gg_jackknife *j)
{
  free(j->now < j->before ? j->now : j->before); /* the two swap places */
  *j = (gg_jackknife){0};
}

void gg_statistics_jackknife_cut(gg_jackknife *j)
{
  j->first = true;
}

double *gg_statistics_jackknife_next(gg_jackknife *j)
{
  return j->now;
}

void gg_statistics_jackknife_add(gg_jackknife *j)
{
  for (size_t i = 0; i < j->width; i++) {
    double d = j->now[i];
    j->sum[i] += d;
    j->squares[i] += d * d;
    if (j->first) continue;
    j->products[i] += d * j->before[i];
    j->ends[i] += d + j->before[i];
  }
  double *swap = j->now;
  j->now = j->before, j->before = swap;
  j->pairs += !j->first;
  j->blocks++;
  j->first = false;
}

/* Sum of squares about the mean. */
static double scatter(const gg_jackknife *j, size_t i)
{
  return j->squares[i] - j->sum[i] * j->sum[i] / (double)j->blocks;
}

/* Correlation of neighbours; about the mean of the same n numbers it is too low by 1/n. NaN if nothing varies. */
static double correlation(const gg_jackknife *j, size_t i)
{
  double n = (double)j->blocks, mean = j->sum[i] / n, total = scatter(j, i);
  if (!(total > 0) || n < 3) return NAN;
  return (j->products[i] - mean * j->ends[i] + (double)j->pairs * mean * mean) / total + 1 / n;
}

/* Variance of the mean over a stretch of `length` decay times, over that of the mode itself. */
static double of_stretch(double length)
{
  return 2 * (length + expm1(-length)) / (length * length);
}

/* Variance of the mean over that of independent blocks of the same scatter, for numbers in which a fraction f of the
 * variance of a block is the slow mode's: V = (1 + f (I - 1))/n of that variance, where I is the ratio for the mode
 * alone. About the mean of the blocks themselves the scatter is 1 - V of the variance, and the measured correlation
 * r of neighbours is f r_mode - V of it: this gives f. */
static double with_slow_mode(const gg_jackknife *j, double r, double memory)
{
  double n = (double)j->blocks, per_run = n / (n - (double)j->pairs), one = of_stretch(1 / memory);
  double r_mode = pow(expm1(-1 / memory) * memory, 2) / one, I = per_run * of_stretch(per_run / memory) / one;
  double above = r + (1 - r) / n, below = r_mode - (I - 1) * (1 - r) / n;
  double f = below > 0 ? fmin(fmax(above / below, 0), 1) : above > 0;
  double V = fmin((1 + f * (I - 1)) / n, MOST_OF_VARIANCE);
  return (n - 1) * V / (1 - V);
}

double gg_statistics_jackknife_errors(const gg_jackknife *j, size_t from, size_t n, double memory, double beside,
                                      double *error)
{
  double blocks = (double)j->blocks, all = 0;
  size_t known = 0;
  for (size_t i = 0; i < n; i++) {
    double count = isfinite(beside) ? BESIDE : 0, sum = count > 0 ? count * beside : 0, own = correlation(j, from + i);
    for (size_t k = i < NEIGHBOURS ? 0 : i - NEIGHBOURS; k < n && k <= i + NEIGHBOURS; k++) {
      double r = correlation(j, from + k);
      if (isfinite(r)) sum += r, count++;
    }
    double r = count > 0 ? fmin(fmax(sum / count, 0), STRONGEST) : 0, more = (1 + r) / (1 - r);
    if (memory > LEAST_MEMORY && count > 0) more = with_slow_mode(j, sum / count - 1 / blocks, memory);
    double variance = (blocks - 1) / blocks * fmax(scatter(j, from + i), 0) * more;
    const double scatter_error = sqrt(variance) + 0 * j->sum[from + i]; /* NaN stays NaN */
    error[i] = blocks > 1 ? scatter_error * gg_statistics_student(j->blocks) : NAN;
    if (isfinite(own)) all += own, known++;
  }
  return known ? all / (double)known : NAN;
}
