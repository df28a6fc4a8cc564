/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/estimator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_statistics_double.h>

#include "base/memory.h"
#include "statistics/autocorrelation.h"

double gg_statistics_mean(const double *y, size_t n)
{
  double lane[4] = {0};
  for (size_t i = 0; i < n; i++) lane[i % 4] += y[i] - y[0];
  return y[0] + (lane[0] + lane[1] + (lane[2] + lane[3])) / (double)n;
}

/* Means over equal blocks, none across the end of a run; returns how many. */
static size_t block_means(const double *y, size_t n, size_t n_runs, size_t length, double *means)
{
  size_t per_run = n / length, count = 0;
  for (size_t r = 0; r < n_runs; r++)
    for (size_t b = 0; b < per_run; b++) /* the remaining rows, nearest to the start, are left out */
      means[count++] = gg_statistics_mean(y + r * n + (n - per_run * length) + b * length, length);
  return count;
}

/* The longest blocks that leave GG_MAX_BLOCKS of them, but never shorter than ten correlation times while that leaves
 * GG_MIN_BLOCKS. */
static size_t block_length(size_t n, size_t n_runs, double tau)
{
  size_t total = n * n_runs;
  double shortest = ceil(10 * tau), most = floor((double)total / GG_MIN_BLOCKS);
  double length = fmax(ceil((double)total / GG_MAX_BLOCKS), fmin(shortest, most));
  return length < 1 ? 1 : length > (double)n ? n : (size_t)length;
}

#define LEAST_OF_VARIANCE 0.25 /* of blocks that the mean of all keeps: a smaller value would be noise */

/* Correction for correlated neighbours. Blocks that are not much longer than the correlation time are correlated,
 * and scatter less than the error of their mean (or more, if the correlation becomes negative). The factor follows
 * from the correlation function. */
static double neighbours(const gg_correlation *c, size_t n, size_t length)
{
  double whole = gg_statistics_correlation_inflation(c, n), block = gg_statistics_correlation_inflation(c, length);
  if (!(block > 0)) return 1;
  return sqrt(fmax(whole / block, c->memory > 0 ? LEAST_OF_VARIANCE : 1));
}

/* Correction for windows of less than 40 times of the slowest mode, beyond that for few blocks: chosen on
 * autoregressive series (validation/errors). */
static double small_sample(const gg_correlation *c, size_t blocks, size_t total)
{
  return fmax(gg_statistics_student(blocks), 1 + 2.5 * c->slow / (double)total);
}

gg_status gg_statistics_estimate_made_of(const double *y, size_t n, size_t n_runs, double memory, gg_mean *out,
                                         gg_error *err)
{
  *out = (gg_mean){.mean = NAN, .error = NAN, .scatter = NAN, .correlation_rows = 0.5};
  size_t total = n * n_runs;
  if (total == 0) return GG_OK;
  out->mean = gg_statistics_mean(y, total);
  if (total < 4) return GG_OK;
  double *work = gg_base_array_new(total, sizeof *work, err);
  if (!work) return GG_FAILED;
  for (size_t i = 0; i < total; i++) work[i] = y[i] - out->mean;
  gg_correlation c;
  gg_status status = gg_statistics_correlation_of(work, n, n_runs, memory, &c, err);
  if (status == GG_OK) {
    size_t length = block_length(n, n_runs, fmax(c.time, c.memory));
    out->correlation_rows = c.time;
    out->blocks = block_means(y, n, n_runs, length, work);
    if (out->blocks >= 2) out->scatter = gsl_stats_sd(work, 1, out->blocks) / sqrt((double)out->blocks);
    if (out->blocks >= 2) out->error = out->scatter * neighbours(&c, n, length) * small_sample(&c, out->blocks, total);
    out->trusted = out->blocks >= GG_MIN_BLOCKS && (double)length >= 5 * c.time;
    gg_statistics_correlation_clear(&c);
  }
  free(work);
  return status;
}

gg_status gg_statistics_estimate_scalar(const double *y, size_t n, size_t n_runs, gg_mean *out, gg_error *err)
{
  return gg_statistics_estimate_made_of(y, n, n_runs, 0, out, err);
}

static void channel_means(const gg_series *const *series, size_t n_runs, size_t begin, size_t end, size_t offset,
                          size_t channels, double *mean)
{
  for (size_t k = 0; k < channels; k++) mean[k] = 0;
  for (size_t r = 0; r < n_runs; r++)
    for (size_t i = begin; i < end; i++)
      for (size_t k = 0; k < channels; k++) mean[k] += gg_series_row(series[r], i)[offset + k];
  for (size_t k = 0; k < channels; k++) mean[k] /= (double)(n_runs * (end - begin));
}

/* The rows of the channels on which f depends, all of equal length. */
typedef struct rows {
  const gg_series *const *series;
  size_t n_runs, begin, n, offset, channels;
} rows;

/* The step in a channel for derivatives of f: small, but with a visible change of f. Quantities come in any units,
 * and values of dilute gases or heavy grains are small: so the step is scaled by the value of the channel and by its
 * scatter. */
static double step_of(const rows *a, size_t k, double at)
{
  double squares = 0, least = 1e-3;
  if (fabs(at) < 1e-6) {
    for (size_t r = 0; r < a->n_runs; r++)
      for (size_t i = 0; i < a->n; i++)
        squares += pow(gg_series_row(a->series[r], a->begin + i)[a->offset + k] - at, 2);
    double size = fabs(at) + sqrt(squares / (double)(a->n * a->n_runs));
    if (size > 0 && size < 1e-6) least = 1e3 * size;
  }
  return 1e-6 * (fabs(at) + least);
}

/* df/da_k by a central difference: f is smooth on the scale of a mean's error. */
static double slope(gg_function f, const gg_model *model, const rows *a, double *mean, size_t k)
{
  double at = mean[k], step = step_of(a, k, at);
  mean[k] = at + step;
  double up = gg_function_value(f, mean, model);
  mean[k] = at - step;
  double down = gg_function_value(f, mean, model);
  mean[k] = at;
  return up == down ? 0 : (up - down) / (2 * step); /* 0 also for a channel that is NaN */
}

/* Add df_k (a_k - mean_k) of every row to y. */
static void add_response(const rows *a, size_t k, const double *mean, const double *df, double *y)
{
  for (size_t r = 0; df[k] != 0 && r < a->n_runs; r++)
    for (size_t i = 0; i < a->n; i++)
      y[r * a->n + i] += df[k] * (gg_series_row(a->series[r], a->begin + i)[a->offset + k] - mean[k]);
}

/* Correlation time, in rows, of the channel whose fluctuations alone would move f most; 0 if f depends on one
 * channel. `y` is scratch for as many rows. */
static gg_status memory_of_parts(const rows *a, const double *mean, const double *df, double *y, double *memory,
                                 gg_error *err)
{
  size_t total = a->n * a->n_runs, loudest = 0, parts = 0;
  double most = 0;
  for (size_t k = 0; k < a->channels; k++) {
    if (df[k] == 0) continue;
    memset(y, 0, total * sizeof *y);
    add_response(a, k, mean, df, y);
    double squares = gsl_stats_tss_m(y, 1, total, 0);
    parts += squares > 0;
    if (squares > most) most = squares, loudest = k;
  }
  *memory = 0;
  if (parts < 2) return GG_OK;
  memset(y, 0, total * sizeof *y);
  add_response(a, loudest, mean, df, y);
  gg_correlation c;
  GG_TRY(gg_statistics_correlation_of(y, a->n, a->n_runs, 0, &c, err));
  *memory = c.time;
  gg_statistics_correlation_clear(&c);
  return GG_OK;
}

/* The sum over correlations extends over about one decay time of a slow mode (REACH times this fraction of it): a
 * longer sum would add more noise than it gains. The missing part is corrected as in small_sample. */
#define SHARE_OF_SLOW 0.4
#define DOUBT_OF_SLOW 2.5

/* A function of channel means, and the data for its linear response. */
typedef struct response {
  rows of;
  double value;
  double *y, *mean, *df; /* y: a number a row; mean and df follow it in the same allocation */
} response;

static gg_status response_make(response *p, const rows *of, gg_function f, const gg_model *model, gg_error *err)
{
  size_t total = of->n * of->n_runs;
  *p = (response){.of = *of, .y = gg_base_array_new(total + 2 * of->channels, sizeof(double), err)};
  if (!p->y) return GG_FAILED;
  p->mean = p->y + total, p->df = p->mean + of->channels;
  channel_means(of->series, of->n_runs, of->begin, of->begin + of->n, of->offset, of->channels, p->mean);
  p->value = gg_function_value(f, p->mean, model);
  for (size_t k = 0; isfinite(p->value) && k < of->channels; k++) p->df[k] = slope(f, model, of, p->mean, k);
  return GG_OK;
}

static void respond(response *p)
{
  memset(p->y, 0, p->of.n * p->of.n_runs * sizeof *p->y);
  for (size_t k = 0; k < p->of.channels; k++) add_response(&p->of, k, p->mean, p->df, p->y);
}

gg_status gg_statistics_estimate_mean(const gg_series *const *series, size_t n_runs, size_t begin, size_t end,
                                      size_t offset, size_t channels, gg_function f, const gg_model *model, double slow,
                                      gg_mean *out, gg_error *err)
{
  *out = (gg_mean){.mean = NAN, .error = NAN, .scatter = NAN, .correlation_rows = 0.5};
  if (end <= begin) return GG_OK;
  const rows a = {series, n_runs, begin, end - begin, offset, channels};
  response p;
  GG_TRY(response_make(&p, &a, f, model, err));
  gg_status status = GG_OK;
  if (isfinite(p.value)) {
    double memory;
    status = memory_of_parts(&a, p.mean, p.df, p.y, &memory, err);
    respond(&p);
    if (status == GG_OK)
      status = gg_statistics_estimate_made_of(p.y, a.n, n_runs, fmax(memory, SHARE_OF_SLOW * slow), out, err);
    out->error *= 1 + DOUBT_OF_SLOW * slow / (double)(a.n * n_runs);
    out->mean = p.value;
  }
  free(p.y);
  return status;
}

gg_status gg_statistics_response_blocks(const gg_series *const *series, size_t n_runs, size_t begin, size_t end,
                                        size_t offset, size_t channels, gg_function f, const gg_model *model,
                                        size_t length, double *blocks, gg_error *err)
{
  if (end <= begin) return GG_OK;
  const rows a = {series, n_runs, begin, end - begin, offset, channels};
  response p;
  GG_TRY(response_make(&p, &a, f, model, err));
  respond(&p); /* without a value df is 0 */
  block_means(p.y, a.n, n_runs, length, blocks);
  free(p.y);
  return GG_OK;
}

gg_mean gg_statistics_estimate_over_runs(const double *const *row, size_t n_runs, size_t channels, gg_function f,
                                         const gg_model *model, double *scratch)
{
  double *mean = scratch, *rest = scratch + channels, sum = 0, squares = 0;
  const double n = (double)n_runs;
  memset(mean, 0, channels * sizeof *mean);
  for (size_t r = 0; r < n_runs; r++)
    for (size_t k = 0; k < channels; k++) mean[k] += row[r][k] / n;
  gg_mean m = {.mean = gg_function_value(f, mean, model), .error = NAN, .scatter = NAN, .correlation_rows = NAN};
  if (n_runs < 2) return m;
  for (size_t r = 0; r < n_runs; r++) {
    for (size_t k = 0; k < channels; k++) rest[k] = mean[k] + (mean[k] - row[r][k]) / (n - 1);
    const double d = gg_function_value(f, rest, model) - m.mean;
    sum += d, squares += d * d;
  }
  m.blocks = n_runs;
  m.scatter = sqrt((n - 1) / n * fmax(squares - sum * sum / n, 0)) + 0 * squares; /* NaN stays NaN */
  m.error = m.scatter * gg_statistics_student(n_runs);
  return m;
}
