/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/autocorrelation.h"

#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Sums over lags usually need few lags: those products are summed directly. A series that needs more is transformed
 * as a whole. Beyond some 300 lags transforms would be faster from the start. */
enum { FEWEST = 64, FEW = 256, LANES = 8 };

typedef double two __attribute__((vector_size(16)));
typedef double two_there __attribute__((vector_size(16), may_alias, aligned(8)));

/* a_i b_(i+k) of n rows is added to lane k. */
static void add_lanes(const double *a, const double *b, size_t n, double *lane)
{
  two sum[LANES / 2] = {0};
  size_t i = 0;
  for (; i + LANES <= n; i++)
    for (int k = 0; k < LANES / 2; k++) sum[k] += (two){a[i], a[i]} * *(const two_there *)(b + i + 2 * k);
  for (int k = 0; k < LANES; k++) lane[k] += sum[k / 2][k % 2];
  for (; i < n; i++)
    for (size_t k = 0; i + k < n; k++) lane[k] += a[i] * b[i + k];
}

/* Mean products of rows at lags from .. to - 1, over the available pairs. */
static void add_products(const double *x, size_t n, size_t n_runs, size_t from, size_t to, double *covariance)
{
  for (size_t t = from; t < to && t < n; t += LANES) {
    double lane[LANES] = {0};
    for (size_t r = 0; r < n_runs; r++) add_lanes(x + r * n, x + r * n + t, n - t, lane);
    for (size_t k = 0; k < LANES && t + k < n; k++) covariance[t + k] = lane[k] / (double)(n - t - k);
  }
}

/* In-place transforms of powers of two, by GSL. FFTW would plan, allocate and share data, and ends the program if
 * its planner gets no memory. Half-complex format: real parts from the front, imaginary parts from the back. */
typedef struct transform {
  size_t length; /* of the padded series: at least 2 n, so that no lag wraps around */
  double *data;
} transform;

static gg_status transform_make(transform *f, size_t n, gg_error *err)
{
  size_t length = 2;
  while (length < 2 * n) length *= 2;
  *f = (transform){.length = length, .data = gg_base_array_new(length, sizeof(double), err)};
  return f->data ? GG_OK : GG_FAILED;
}

/* Set `power` to the sum over runs of |X(k)|^2. */
static void add_power(transform *f, const double *x, size_t n, double *power)
{
  double *X = f->data;
  memcpy(X, x, n * sizeof *x);
  memset(X + n, 0, (f->length - n) * sizeof *x);
  gsl_fft_real_radix2_transform(X, 1, f->length);
  power[0] += X[0] * X[0];
  power[f->length / 2] += X[f->length / 2] * X[f->length / 2];
  for (size_t k = 1; k < f->length / 2; k++) power[k] += X[k] * X[k] + X[f->length - k] * X[f->length - k];
}

/* The window is 8 tau. Five would do for a single exponential. If a fast process is added to a slow one, 5 tau is
 * too short: for a slow part with a third of the variance, over 60 of its times, errors would be 11 % too small (2 %
 * with 8 tau). */
enum { WINDOW = 8, ROUNDS = 3 };

/* A ratio has a shorter memory than its parts: common deviations of both parts cancel, but the part that follows the
 * other returns later with the opposite sign. The remainder is small at each lag, would end the sum, and is a
 * quarter of it (theta/T of dilute rough grains: errors 7 % too large). So the sum extends over some times of the
 * slower part. A longer sum would add more noise than it gains (chosen on that series, in windows of 100 to 1600
 * rows). */
#define LONGER 1.5
#define REACH 2.5

/* The sum also ends at two neighbouring lags whose covariances add up to nothing: beyond is noise, which in a window
 * of 30 times would make half of the error's own uncertainty (Geyer, Stat. Sci. 7 (1992) 473). */
static bool is_noise(const double *covariance, size_t t, double shift)
{
  return t > 1 && covariance[t - 1] + covariance[t] + 2 * shift <= 0;
}

/* rho from covariances, its sum, and the end of the sum, at `reach` lags or later; false if the end is not before
 * lag n. An anticorrelated series gets at least the variance of independent samples. */
static bool sum_to_window(const double *covariance, size_t n, double shift, size_t reach, gg_correlation *c)
{
  double moment = 0;
  size_t t = 1;
  *c = (gg_correlation){.time = 0.5, .slow = 0.5, .rho = c->rho};
  c->rho[0] = 1;
  if (!(covariance[0] + shift > 0)) return true;
  for (; t < n && (t <= reach || (double)c->window <= WINDOW * c->time); t++) {
    if (t > reach && is_noise(covariance, t, shift)) break;
    c->rho[t] = (covariance[t] + shift) / (covariance[0] + shift);
    c->time += c->rho[t];
    moment += (double)t * c->rho[t];
    c->window = t;
  }
  if (c->time < 0.5) *c = (gg_correlation){.time = 0.5, .slow = 0.5, .rho = c->rho};
  c->slow = fmax(c->time, moment / c->time);
  return t < n;
}

static bool sum(const double *covariance, size_t n, size_t rows, size_t reach, gg_correlation *c)
{
  double shift = 0;
  bool ends = true;
  for (int round = 0; round < ROUNDS; round++) {
    ends = sum_to_window(covariance, n, shift, reach, c) && ends;
    shift = 2 * c->time * (covariance[0] + shift) / (double)rows;
  }
  return ends;
}

/* False if lags below n are not enough. */
static bool integrate(const double *covariance, size_t n, size_t rows, double memory, gg_correlation *c)
{
  bool ends = sum(covariance, n, rows, 0, c);
  if (memory > LONGER * c->time) {
    ends = sum(covariance, n, rows, (size_t)ceil(REACH * memory), c) && ends;
    c->memory = memory;
  }
  return ends;
}

static gg_status by_transforms(const double *x, size_t n, size_t n_runs, double memory, gg_correlation *c,
                               gg_error *err)
{
  transform f;
  GG_TRY(transform_make(&f, n, err));
  double *power = gg_base_array_new(f.length / 2 + 1, sizeof *power, err);
  if (power) {
    for (size_t r = 0; r < n_runs; r++) add_power(&f, x + r * n, n, power);
    memset(f.data, 0, f.length * sizeof *f.data);
    memcpy(f.data, power, (f.length / 2 + 1) * sizeof *power);
    gsl_fft_halfcomplex_radix2_backward(f.data, 1, f.length);
    for (size_t t = 0; t < n; t++) f.data[t] /= (double)(n - t); /* number of pairs at lag t */
    integrate(f.data, n, n * n_runs, memory, c);
  }
  free(f.data);
  free(power);
  return power ? GG_OK : GG_FAILED;
}

gg_status gg_statistics_correlation_of(const double *x, size_t n, size_t n_runs, double memory, gg_correlation *c,
                                       gg_error *err)
{
  *c = (gg_correlation){.time = 0.5, .slow = 0.5};
  c->rho = gg_base_array_new(n ? n : 1, sizeof *c->rho, err);
  if (!c->rho) return GG_FAILED;
  c->rho[0] = 1;
  if (n < 2 || n * n_runs < 4) return GG_OK;
  double covariance[FEW];
  for (size_t from = 0, to = FEWEST; to <= FEW; from = to, to *= 4) {
    add_products(x, n, n_runs, from, to, covariance);
    if (integrate(covariance, to < n ? to : n, n * n_runs, memory, c) || n <= to) return GG_OK;
  }
  gg_status status = by_transforms(x, n, n_runs, memory, c, err);
  if (status != GG_OK) gg_statistics_correlation_clear(c);
  return status;
}

void gg_statistics_correlation_clear(gg_correlation *c)
{
  free(c->rho);
  c->rho = NULL;
}

double gg_statistics_correlation_inflation(const gg_correlation *c, size_t length)
{
  double sum = 1;
  for (size_t t = 1; t <= c->window && t < length; t++) sum += 2 * (1 - (double)t / (double)length) * c->rho[t];
  return sum;
}

static double covariance(const double *y, size_t n, size_t n_runs, double mean, size_t lag)
{
  double sum = 0;
  for (size_t r = 0; r < n_runs; r++)
    for (size_t i = 0; i + lag < n; i++) sum += (y[r * n + i] - mean) * (y[r * n + i + lag] - mean);
  return sum / (double)(n_runs * (n - lag));
}

/* Variance of the mean of n rows of a mode with this decay time, over that of the mode. */
static double of_mean(double tau, double n)
{
  return 2 * tau / n * (1 - tau / n * (1 - exp(-n / tau)));
}

double gg_statistics_decay_time(const double *y, size_t n, size_t n_runs)
{
  double mean = 0, rows = (double)(n * n_runs);
  if (n < 4) return 0.5;
  for (size_t i = 0; i < n * n_runs; i++) mean += y[i] / rows;
  double first = covariance(y, n, n_runs, mean, 1);
  if (!(first > 2 / sqrt(rows) * covariance(y, n, n_runs, mean, 0))) return 0.5; /* noise has as much */
  for (size_t lag = 1; lag + 1 < n; lag++) {
    double tau = (double)lag, v = of_mean(tau, (double)n) / (double)n_runs;
    double seen = covariance(y, n, n_runs, mean, lag + 1) / first;
    if (seen * (exp(-1 / tau) - v) <= exp(-1 - 1 / tau) - v) return tau;
  }
  return (double)n;
}

void gg_statistics_parts(const gg_series *s, size_t channel, size_t parts, size_t rows, double *y)
{
  const size_t first = s->n - parts * rows;
  for (size_t i = 0; i < parts; i++) {
    y[i] = 0;
    for (size_t k = 0; k < rows; k++) y[i] += gg_series_row(s, first + i * rows + k)[channel] / (double)rows;
  }
}

double gg_statistics_scatter_by_square(const double *x, const double *y, size_t n)
{
  double square = 0, mean = 0, products = 0, squares = 0;
  for (size_t i = 0; i < n; i++) square += x[i] * x[i] / (double)n, mean += y[i] / (double)n;
  for (size_t i = 0; i < n; i++) {
    const double d = x[i] * x[i] - square;
    products += d * (y[i] - mean) / (double)n, squares += d * d / (double)n;
  }
  return squares > 0 ? fabs(products) / sqrt(squares) : 0;
}
