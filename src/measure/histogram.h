/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Histograms of a velocity component x, in bins of a tenth of a given unit about 0: scaled to P(0) = 1, with the tail
 * as a stretched exponential, kurtosis and skewness. */
#ifndef GG_HISTOGRAM_H
#define GG_HISTOGRAM_H

#include "measure/curve.h"

enum {
  GG_HISTOGRAM_HALF = 80, /* bin k is centred on (k - HALF) widths */
  GG_HISTOGRAM_BINS = 2 * GG_HISTOGRAM_HALF + 1,
  GG_HISTOGRAM_GRAINS = GG_HISTOGRAM_BINS, /* after the bins: sums of 1, x^2, x^3, x^4 */
  GG_HISTOGRAM_SQUARES,
  GG_HISTOGRAM_CUBES,
  GG_HISTOGRAM_FOURTHS,
  GG_HISTOGRAM
};
#define GG_HISTOGRAM_WIDTH 0.1

GG_INLINE void gg_histogram_add(double *bin, double x)
{
  double at = x * (1 / GG_HISTOGRAM_WIDTH) + (GG_HISTOGRAM_HALF + 0.5), xx = x * x;
  bin[GG_HISTOGRAM_GRAINS]++;
  bin[GG_HISTOGRAM_SQUARES] += xx;
  bin[GG_HISTOGRAM_CUBES] += xx * x;
  bin[GG_HISTOGRAM_FOURTHS] += xx * xx;
  if (at >= 0 && at < GG_HISTOGRAM_BINS) bin[(int)at]++;
}

/* Add many values of x, about a mean, in a unit. */
void gg_measure_histogram_add_all(double *bin, const double *x, size_t n, double mean, double unit);
/* Mean and standard deviation of x. */
typedef struct gg_scale_of {
  double mean, sigma;
} gg_scale_of;
gg_scale_of gg_measure_scale_of_values(const double *x, size_t n);

/* Standard deviation, in the unit of x; the expected count of a bin at x = 0. */
double gg_measure_histogram_sigma(const double *bin);
double gg_measure_histogram_height(const double *bin, double sigma);
/* P(x/sigma)/P(0), and the numbers: tail, kurtosis, skewness. `samples`: number of samples in the mean of the bins;
 * 0: they are probabilities, and there is no tail. */
gg_curve *gg_measure_histogram_put(gg_curves *list, const char *name, const char *panel, const char *label,
                                   const double *bin, double sigma, double samples);

#endif
