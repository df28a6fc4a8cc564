/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fftw3.h"

#include <gsl/gsl_fft_complex.h>
#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <stdlib.h>
#include <string.h>

struct gg_page_plan {
  int n[3]; /* the last one is that of the real numbers side by side */
  double *real;
  fftw_complex *complex;
  int backward;
};

double *fftw_alloc_real(size_t n)
{
  return malloc(n * sizeof(double));
}
fftw_complex *fftw_alloc_complex(size_t n)
{
  return malloc(n * sizeof(fftw_complex));
}
void fftw_free(void *numbers)
{
  free(numbers);
}

static fftw_plan plan(int n0, int n1, int n2, double *real, fftw_complex *complex, int backward)
{
  fftw_plan p = malloc(sizeof *p);
  if (p) *p = (struct gg_page_plan){{n0, n1, n2}, real, complex, backward};
  return p;
}

fftw_plan fftw_plan_dft_r2c_1d(int n, double *in, fftw_complex *out, unsigned flags)
{
  (void)flags;
  return plan(1, 1, n, in, out, 0);
}
fftw_plan fftw_plan_dft_c2r_1d(int n, fftw_complex *in, double *out, unsigned flags)
{
  (void)flags;
  return plan(1, 1, n, out, in, 1);
}
fftw_plan fftw_plan_dft_r2c_3d(int n0, int n1, int n2, double *in, fftw_complex *out, unsigned flags)
{
  (void)flags;
  return plan(n0, n1, n2, in, out, 0);
}
void fftw_destroy_plan(fftw_plan p)
{
  free(p);
}

/* GSL has the modes as re 0, re 1, im 1, ... re n/2: all that is missing are two zeros. */
static void forward_line(size_t n, double *x, fftw_complex *modes)
{
  gsl_fft_real_wavetable *table = gsl_fft_real_wavetable_alloc(n);
  gsl_fft_real_workspace *room = gsl_fft_real_workspace_alloc(n);
  gsl_fft_real_transform(x, 1, n, table, room);
  modes[0][0] = x[0], modes[0][1] = 0;
  if (n % 2 == 0) modes[n / 2][1] = 0;
  memcpy(modes[1], x + 1, (n - 1) * sizeof *x);
  gsl_fft_real_workspace_free(room);
  gsl_fft_real_wavetable_free(table);
}

static void backward_line(size_t n, double *x, fftw_complex *modes)
{
  gsl_fft_halfcomplex_wavetable *table = gsl_fft_halfcomplex_wavetable_alloc(n);
  gsl_fft_real_workspace *room = gsl_fft_real_workspace_alloc(n);
  x[0] = modes[0][0];
  memcpy(x + 1, modes[1], (n - 1) * sizeof *x);
  gsl_fft_halfcomplex_backward(x, 1, n, table, room);
  gsl_fft_real_workspace_free(room);
  gsl_fft_halfcomplex_wavetable_free(table);
}

/* Along one of the first axes: `lines` begin side by side, and again in each of `blocks`. */
static void forward_axis(size_t n, size_t lines, size_t blocks, fftw_complex *modes)
{
  gsl_fft_complex_wavetable *table = gsl_fft_complex_wavetable_alloc(n);
  gsl_fft_complex_workspace *room = gsl_fft_complex_workspace_alloc(n);
  for (size_t b = 0; n > 1 && b < blocks; b++)
    for (size_t i = 0; i < lines; i++) gsl_fft_complex_forward(modes[b * n * lines + i], lines, n, table, room);
  gsl_fft_complex_workspace_free(room);
  gsl_fft_complex_wavetable_free(table);
}

void fftw_execute(fftw_plan p)
{
  size_t n0 = (size_t)p->n[0], n1 = (size_t)p->n[1], n2 = (size_t)p->n[2], half = n2 / 2 + 1;
  if (p->backward) {
    backward_line(n2, p->real, p->complex);
    return;
  }
  for (size_t line = 0; line < n0 * n1; line++) forward_line(n2, p->real + line * n2, p->complex + line * half);
  forward_axis(n1, half, n0, p->complex);
  forward_axis(n0, n1 * half, 1, p->complex);
}
