/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests are psi_m = Ho_m(c) exp(-decay c^2/2), so that the far tails of f, which no expansion of low degree
 * describes, do not contribute; trials are Ho_s(c) under the Gaussian weight. */
#ifndef GG_HERMITE_OVERLAP_H
#define GG_HERMITE_OVERLAP_H

#include "base/error.h"

/* Along one axis, for tests displaced by shifts: < Ho_m(x + shift) exp(-decay (x + shift)^2/2) Ho_s(x) >. */
typedef struct gg_hermite_overlap {
  int tests, trials; /* numbers of tests and trials: 0 <= m < tests, 0 <= s < trials */
  double decay;
  int n;
  double *x, *w; /* Gauss-Hermite rule, exact for these */
} gg_hermite_overlap;

gg_status gg_hermite_overlap_make(gg_hermite_overlap *o, int tests, int trials, double decay, gg_error *err);
void gg_hermite_overlap_clear(gg_hermite_overlap *o);

/* By rows m, `trials` wide. */
void gg_hermite_overlap_at(const gg_hermite_overlap *o, double shift, double *matrix);

/* n nodes and weights of a Gauss-Hermite rule of the weight exp(-x^2/2)/sqrt(2 pi), or of a Gauss-Legendre rule on
 * (0, 1). */
gg_status gg_hermite_rule(int n, double *x, double *w, gg_error *err);
gg_status gg_hermite_legendre_rule(int n, double *x, double *w, gg_error *err);

#endif
