#include "statistics/autocorrelation.h"

#include <fftw3.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "statistics/planner.h"

typedef struct transform {
  size_t length; /* of the padded series: at least 2 n, so that nothing wraps around */
  double *real;
  fftw_complex *spectrum;
  fftw_plan forward, backward;
} transform;

static void transform_free(transform *f)
{
  gg_planner_lock();
  if (f->forward) fftw_destroy_plan(f->forward);
  if (f->backward) fftw_destroy_plan(f->backward);
  gg_planner_unlock();
  fftw_free(f->real);
  fftw_free(f->spectrum);
}

static gg_status transform_make(transform *f, size_t n, gg_error *err)
{
  size_t length = 2;
  while (length < 2 * n) length *= 2;
  *f = (transform){.length = length};
  f->real = fftw_alloc_real(length);
  f->spectrum = fftw_alloc_complex(length / 2 + 1);
  if (f->real && f->spectrum) {
    gg_planner_lock();
    f->forward = fftw_plan_dft_r2c_1d((int)length, f->real, f->spectrum, FFTW_ESTIMATE);
    f->backward = fftw_plan_dft_c2r_1d((int)length, f->spectrum, f->real, FFTW_ESTIMATE);
    gg_planner_unlock();
  }
  if (f->forward && f->backward) return GG_OK;
  transform_free(f);
  return gg_fail(err, GG_FAILED, "no Fourier transform of %zu points could be planned", length);
}

/* Leave sum over runs of |X(k)|^2 in `power`. */
static void add_power(transform *f, const double *x, size_t n, double *power)
{
  memcpy(f->real, x, n * sizeof *x);
  memset(f->real + n, 0, (f->length - n) * sizeof *x);
  fftw_execute(f->forward);
  for (size_t k = 0; k <= f->length / 2; k++)
    power[k] += f->spectrum[k][0] * f->spectrum[k][0] + f->spectrum[k][1] * f->spectrum[k][1];
}

/* Five would do for a single exponential; where something fast is on top of something slow, 5 tau end too soon: of a
 * slow part with a third of the variance, over 60 of its times, errors would be 11 % too small (2 % now). */
enum { WINDOW = 8, ROUNDS = 3 };

/* The sum also ends where two neighbouring lags have nothing left between them: beyond is noise, which in a window of
 * 30 times would make half of the error's own uncertainty (Geyer, Stat. Sci. 7 (1992) 473). */
static bool is_noise(const double *covariance, size_t t, double shift)
{
  return t > 1 && covariance[t - 1] + covariance[t] + 2 * shift <= 0;
}

/* rho from covariances, its sum and where that ends. Anticorrelated series: do not claim less than independent samples
 * have. */
static void sum_to_window(const double *covariance, size_t n, double shift, gg_correlation *c)
{
  double moment = 0;
  *c = (gg_correlation){.time = 0.5, .slow = 0.5, .rho = c->rho};
  c->rho[0] = 1;
  if (!(covariance[0] + shift > 0)) return;
  for (size_t t = 1; t < n && (double)c->window <= WINDOW * c->time; t++) {
    if (is_noise(covariance, t, shift)) break;
    c->rho[t] = (covariance[t] + shift) / (covariance[0] + shift);
    c->time += c->rho[t];
    moment += (double)t * c->rho[t];
    c->window = t;
  }
  if (c->time < 0.5) *c = (gg_correlation){.time = 0.5, .slow = 0.5, .rho = c->rho};
  c->slow = fmax(c->time, moment / c->time);
}

static gg_status correlate(transform *f, const double *x, size_t n, size_t n_runs, gg_correlation *c, gg_error *err)
{
  double *power = gg_new_array(f->length / 2 + 1, sizeof *power, err);
  if (!power) return GG_FAILED;
  for (size_t r = 0; r < n_runs; r++) add_power(f, x + r * n, n, power);
  for (size_t k = 0; k <= f->length / 2; k++) f->spectrum[k][0] = power[k], f->spectrum[k][1] = 0;
  free(power);
  fftw_execute(f->backward);
  for (size_t t = 0; t < n; t++) f->real[t] /= (double)(n - t); /* pairs at a lag t */
  double shift = 0;
  for (int round = 0; round < ROUNDS; round++) {
    sum_to_window(f->real, n, shift, c);
    shift = 2 * c->time * (f->real[0] + shift) / (double)(n * n_runs);
  }
  return GG_OK;
}

gg_status gg_correlation_of(const double *x, size_t n, size_t n_runs, gg_correlation *c, gg_error *err)
{
  *c = (gg_correlation){.time = 0.5, .slow = 0.5};
  c->rho = gg_new_array(n ? n : 1, sizeof *c->rho, err);
  if (!c->rho) return GG_FAILED;
  c->rho[0] = 1;
  if (n < 4) return GG_OK;
  transform f;
  gg_status status = transform_make(&f, n, err);
  if (status == GG_OK) {
    status = correlate(&f, x, n, n_runs, c, err);
    transform_free(&f);
  }
  if (status != GG_OK) gg_correlation_clear(c);
  return status;
}

void gg_correlation_clear(gg_correlation *c)
{
  free(c->rho);
  c->rho = NULL;
}

double gg_correlation_inflation(const gg_correlation *c, size_t length)
{
  double sum = 1;
  for (size_t t = 1; t <= c->window && t < length; t++) sum += 2 * (1 - (double)t / (double)length) * c->rho[t];
  return sum;
}
