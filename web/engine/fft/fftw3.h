/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The transforms of FFTW that graingas uses, under FFTW's names, by those of GSL: for the page, which FFTW would make
 * twice as large. Sizes are products of small primes. */
#ifndef GG_PAGE_FFTW3_H
#define GG_PAGE_FFTW3_H

#include <stddef.h>

typedef double fftw_complex[2];
typedef struct gg_page_plan *fftw_plan;
enum { FFTW_ESTIMATE = 0 };

double *fftw_alloc_real(size_t n);
fftw_complex *fftw_alloc_complex(size_t n);
void fftw_free(void *numbers);

/* NULL: out of memory. Sums of exp(-2 pi i jk/n) forward and exp(2 pi i jk/n) backward, of which nothing is divided by
 * n; the complex side has the modes up to n/2 alone, along the last axis in three dimensions. */
fftw_plan fftw_plan_dft_r2c_1d(int n, double *in, fftw_complex *out, unsigned flags);
fftw_plan fftw_plan_dft_c2r_1d(int n, fftw_complex *in, double *out, unsigned flags);
fftw_plan fftw_plan_dft_r2c_3d(int n0, int n1, int n2, double *in, fftw_complex *out, unsigned flags);
void fftw_execute(fftw_plan plan);
void fftw_destroy_plan(fftw_plan plan);

#endif
