#include "measure/autocorrelation.h"

#include <fftw3.h>
#include <stdlib.h>
#include <string.h>

#include "measure/planner.h"

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

/* Sum rho up to Sokal's window; covariances at lag t are over n - t pairs. */
static double sum_to_window(const double *covariance, size_t n)
{
  double tau = 0.5, variance = covariance[0] / (double)n;
  if (!(variance > 0)) return 0.5;
  for (size_t t = 1; t < n; t++) {
    tau += covariance[t] / (double)(n - t) / variance;
    if ((double)t > 5 * tau) break;
  }
  return tau > 0.5 ? tau : 0.5; /* anticorrelated series: do not claim less than independent samples have */
}

gg_status gg_correlation_time(const double *x, size_t n, size_t n_runs, double *tau, gg_error *err)
{
  *tau = 0.5;
  if (n < 4) return GG_OK;
  transform f;
  GG_TRY(transform_make(&f, n, err));
  double *power = gg_new_array(f.length / 2 + 1, sizeof *power, err);
  if (power) {
    for (size_t r = 0; r < n_runs; r++) add_power(&f, x + r * n, n, power);
    for (size_t k = 0; k <= f.length / 2; k++) f.spectrum[k][0] = power[k], f.spectrum[k][1] = 0;
    fftw_execute(f.backward);
    *tau = sum_to_window(f.real, n);
  }
  free(power);
  transform_free(&f);
  return power ? GG_OK : GG_FAILED;
}
