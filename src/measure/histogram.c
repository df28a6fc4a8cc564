/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/histogram.h"

#include <math.h>

#include "measure/stretched_tail.h"
#include "simd/clones.h"

enum { HALF = GG_HISTOGRAM_HALF };
#define WIDTH GG_HISTOGRAM_WIDTH
#define TAIL_FROM 2.0
enum { LEAST_COUNT = 25 }; /* in the last bin of the fit of a tail */

/* Sums in eight lanes, so that their bits do not depend on the width of registers. */
enum { LANES = 8 };

static double sum_of(const double lane[LANES])
{
  return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

GG_CLONES static void add_moments(const double *restrict x, size_t n, double *restrict one, double *restrict two)
{
  for (size_t i = 0; i < n; i += LANES)
    for (size_t l = 0; l < LANES; l++) one[l] += x[i + l], two[l] += x[i + l] * x[i + l];
}

gg_scale_of gg_measure_scale_of_values(const double *x, size_t n)
{
  double one[LANES] = {0}, two[LANES] = {0}, whole = (double)n;
  size_t even = n - n % LANES;
  add_moments(x, even, one, two);
  for (size_t i = even; i < n; i++) one[i - even] += x[i], two[i - even] += x[i] * x[i];
  double mean = sum_of(one) / whole;
  return (gg_scale_of){mean, sqrt(sum_of(two) / whole - mean * mean)};
}

/* Bin of each value, from 1 on (0, and the one after the last: beyond the bins), and sums of powers. */
enum { CHUNK = 256, BEYOND = GG_HISTOGRAM_BINS + 1 };
GG_CLONES static void place(const double *restrict x, double mean, double inverse, int32_t *restrict at,
                            double (*restrict power)[LANES])
{
  for (size_t i = 0; i < CHUNK; i += LANES)
    for (size_t l = 0; l < LANES; l++) {
      double u = (x[i + l] - mean) * inverse, uu = u * u, bin = u * (1 / WIDTH) + (HALF + 1.5);
      bin = bin > 0 ? bin : 0;
      at[i + l] = (int32_t)(bin < BEYOND ? bin : BEYOND);
      power[0][l] += uu, power[1][l] += uu * u, power[2][l] += uu * uu;
    }
}

void gg_measure_histogram_add_all(double *bin, const double *x, size_t n, double mean, double unit)
{
  double power[3][LANES] = {{0}}, inverse = 1 / unit;
  uint32_t counts[2][BEYOND + 1] = {{0}}; /* alternating: equal neighbours would depend on one another */
  int32_t at[CHUNK];
  size_t i = 0;
  for (; i + CHUNK <= n; i += CHUNK) {
    place(x + i, mean, inverse, at, power);
    for (size_t k = 0; k < CHUNK; k += 2) counts[0][at[k]]++, counts[1][at[k + 1]]++;
  }
  for (int k = 0; k < GG_HISTOGRAM_BINS; k++) bin[k] += (double)(counts[0][k + 1] + counts[1][k + 1]);
  bin[GG_HISTOGRAM_GRAINS] += (double)i;
  for (int k = 0; k < 3; k++) bin[GG_HISTOGRAM_SQUARES + k] += sum_of(power[k]);
  for (; i < n; i++) gg_histogram_add(bin, (x[i] - mean) * inverse);
}

double gg_measure_histogram_sigma(const double *bin)
{
  return sqrt(bin[GG_HISTOGRAM_SQUARES] / bin[GG_HISTOGRAM_GRAINS]);
}

/* Counts over a Gaussian's in the bins |x| < 1/2 by least squares as A + B x^2, taken at x = 0. */
double gg_measure_histogram_height(const double *bin, double sigma)
{
  double n = 0, x2 = 0, x4 = 0, y = 0, x2y = 0;
  for (int k = -4; k <= 4; k++) {
    double x = k * WIDTH / sigma, xx = x * x, ratio = bin[HALF + k] * exp(xx / 2);
    n++, x2 += xx, x4 += xx * xx, y += ratio, x2y += xx * ratio;
  }
  return (y * x4 - x2 * x2y) / (n * x4 - x2 * x2);
}

/* The bins of |x| from that of `from` to that of `to`, or to the last one before the first with few counts. */
static gg_stretched_tail_data tail_of(const double *bin, double sigma, double samples, const double range[2],
                                      double folded[HALF])
{
  const double width = WIDTH / sigma;
  int from = (int)fmin(round(range[0] / width), HALF), n = 0;
  for (; from + n < HALF && (from + n) * width <= range[1]; n++) {
    folded[n] = (bin[HALF - from - n] + bin[HALF + from + n]) * samples;
    if (folded[n] < LEAST_COUNT) break;
  }
  return (gg_stretched_tail_data){folded, (size_t)n, (from - 0.5) * width, width,
                                  2 * gg_measure_histogram_height(bin, sigma) * samples};
}

/* Fits over the thesis's ranges. The bins share sigma, P(0) and slow fluctuations: as numbers of the curve the fits
 * have errors that include these. */
static void put_ranges(gg_curve *c, const double *bin, double sigma, double samples)
{
  double folded[HALF];
  for (int k = 0; k < GG_TAIL_RANGES; k++) {
    char name[sizeof c->number[0].name];
    const gg_stretched_tail_data data = tail_of(bin, sigma, samples, gg_measure_stretched_tail_range[k], folded);
    const gg_stretched_tail fit = gg_measure_stretched_tail_double_log(&data);
    gg_measure_stretched_tail_name(name, sizeof name, "alpha", gg_measure_stretched_tail_range[k]);
    gg_measure_curve_put_number(c, name, fit.alpha, "1");
    gg_measure_stretched_tail_name(name, sizeof name, "gamma", gg_measure_stretched_tail_range[k]);
    gg_measure_curve_put_number(c, name, fit.gamma, "1");
  }
}

static void put_tail(gg_curve *c, const double *bin, double sigma, double samples)
{
  static const double whole[2] = {TAIL_FROM, INFINITY};
  double folded[HALF];
  const gg_stretched_tail_data data = tail_of(bin, sigma, samples, whole, folded);
  gg_stretched_tail least = gg_measure_stretched_tail_double_log(&data),
                    likely = gg_measure_stretched_tail_likelihood(&data);
  gg_measure_curve_put_number(c, "alpha", least.alpha, "1");
  gg_measure_curve_put_number(c, "gamma", least.gamma, "1");
  gg_measure_curve_put_number(c, "alpha_likelihood", likely.alpha, "1");
  gg_measure_curve_put_number(c, "gamma_likelihood", likely.gamma, "1");
  gg_measure_curve_put_setting(c, "fit_from", data.first, "1");
  gg_measure_curve_put_setting(c, "fit_to", data.first + (double)data.n * data.width, "1");
  put_ranges(c, bin, sigma, samples);
}

static double gaussian(double x, const double *none)
{
  (void)none;
  return exp(-x * x / 2);
}

gg_curve *gg_measure_histogram_put(gg_curves *list, const char *name, const char *panel, const char *label,
                                   const double *bin, double sigma, double samples)
{
  double zero = gg_measure_histogram_height(bin, sigma),
         variance = gg_measure_histogram_sigma(bin) * gg_measure_histogram_sigma(bin);
  gg_curve *c = gg_measure_curve_add(list, GG_HISTOGRAM_BINS, name, panel, label);
  c->log_y = true;
  for (int i = 0; i < (int)c->n; i++) c->x[i] = (i - HALF) * WIDTH / sigma, c->value[i] = bin[i] / zero;
  gg_measure_curve_beside(c, "Gaussian", gaussian, NULL);
  if (samples > 0) put_tail(c, bin, sigma, samples);
  double n = bin[GG_HISTOGRAM_GRAINS];
  gg_measure_curve_put_number(c, "kurtosis", bin[GG_HISTOGRAM_FOURTHS] / n / (variance * variance), "1");
  gg_measure_curve_put_number(c, "skewness", bin[GG_HISTOGRAM_CUBES] / n / pow(variance, 1.5), "1");
  return c;
}
