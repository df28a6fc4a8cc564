#include "measure/histogram.h"

#include <math.h>

#include "measure/tail.h"

enum { HALF = GG_HISTOGRAM_HALF };
#define WIDTH GG_HISTOGRAM_WIDTH
#define TAIL_FROM 2.0
enum { LEAST_COUNT = 25 }; /* in the last bin that a tail is fitted to */

double gg_histogram_sigma(const double *bin)
{
  return sqrt(bin[GG_HISTOGRAM_SQUARES] / bin[GG_HISTOGRAM_GRAINS]);
}

/* Counts over a Gaussian's in the bins |x| < 1/2 by least squares as A + B x^2, taken at x = 0. */
double gg_histogram_height(const double *bin, double sigma)
{
  double n = 0, x2 = 0, x4 = 0, y = 0, x2y = 0;
  for (int k = -4; k <= 4; k++) {
    double x = k * WIDTH / sigma, xx = x * x, ratio = bin[HALF + k] * exp(xx / 2);
    n++, x2 += xx, x4 += xx * xx, y += ratio, x2y += xx * ratio;
  }
  return (y * x4 - x2 * x2y) / (n * x4 - x2 * x2);
}

static void put_tail(gg_curve *c, const double *bin, double sigma, double samples)
{
  double folded[HALF], width = WIDTH / sigma;
  int from = (int)fmin(round(TAIL_FROM / width), HALF), n = 0;
  for (; from + n < HALF; n++) {
    folded[n] = (bin[HALF - from - n] + bin[HALF + from + n]) * samples;
    if (folded[n] < LEAST_COUNT) break;
  }
  gg_tail_data data = {folded, (size_t)n, (from - 0.5) * width, width, 2 * gg_histogram_height(bin, sigma) * samples};
  gg_tail least = gg_tail_double_log(&data), likely = gg_tail_likelihood(&data);
  gg_curve_put_number(c, "alpha", least.alpha, "1");
  gg_curve_put_number(c, "gamma", least.gamma, "1");
  gg_curve_put_number(c, "alpha_likelihood", likely.alpha, "1");
  gg_curve_put_number(c, "gamma_likelihood", likely.gamma, "1");
  gg_curve_put_setting(c, "fit_from", data.first, "1");
  gg_curve_put_setting(c, "fit_to", data.first + n * width, "1");
}

static double gaussian(double x, const double *none)
{
  (void)none;
  return exp(-x * x / 2);
}

gg_curve *gg_histogram_put(gg_curves *list, const char *name, const char *panel, const char *label, const double *bin,
                           double sigma, double samples)
{
  double zero = gg_histogram_height(bin, sigma), variance = gg_histogram_sigma(bin) * gg_histogram_sigma(bin);
  gg_curve *c = gg_curve_add(list, GG_HISTOGRAM_BINS, name, panel, label);
  c->log_y = true;
  for (int i = 0; i < (int)c->n; i++) c->x[i] = (i - HALF) * WIDTH / sigma, c->value[i] = bin[i] / zero;
  gg_curve_beside(c, "Gaussian", gaussian, NULL);
  put_tail(c, bin, sigma, samples);
  double n = bin[GG_HISTOGRAM_GRAINS];
  gg_curve_put_number(c, "kurtosis", bin[GG_HISTOGRAM_FOURTHS] / n / (variance * variance), "1");
  gg_curve_put_number(c, "skewness", bin[GG_HISTOGRAM_CUBES] / n / pow(variance, 1.5), "1");
  return c;
}
