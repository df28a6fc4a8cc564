/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A distribution: n (2 pi)^(-3/2) |L|^-1 exp(-c^2/2) sum_r a_r Ho_r(c), C = L c, with L L^T = width x <C C>. */
#ifndef GG_HERMITE_STATE_H
#define GG_HERMITE_STATE_H

#include "theory/hermite/basis.h"

/* Width of the Gaussian and decay of the tests. The Gaussian is somewhat wider than f: tails of granular gases are
 * longer than a Gaussian's, and an expansion in moments (width 1, decay 0) diverges for dilute gases of e below .8.
 * Widths .9 to 2 and decays 0 to 1 were tested; these values work at every density and e. */
#define GG_HERMITE_WIDTH 1.1
#define GG_HERMITE_DECAY 0.2

typedef struct gg_hermite_state {
  double L[3][3]; /* lower triangular */
  double width;
  double *a;
} gg_hermite_state;

/* Second moments <C C> of an expansion. */
void gg_hermite_second_moments(const gg_hermite_basis *basis, const gg_hermite_state *state, double M[3][3]);

/* Lower triangular L with L L^T = A; false where A is not positive. */
bool gg_hermite_cholesky(double A[3][3], double L[3][3]);

/* L of the Gaussian of an expansion whose second moments are M. */
bool gg_hermite_gaussian(double width, double M[3][3], double L[3][3]);

/* The same moments up to degree N about another Gaussian. */
gg_status gg_hermite_expand_anew(const gg_hermite_basis *basis, gg_hermite_state *state, double L[3][3], gg_error *err);

/* Mean of a polynomial of C, of degree up to N + 3, over the distribution. */
typedef double gg_hermite_function(const double C[3]);
double gg_hermite_mean(const gg_hermite_basis *basis, const gg_hermite_state *state, gg_hermite_function *function);
/* <C_axis^4>. */
double gg_hermite_fourth_moment(const gg_hermite_basis *basis, const gg_hermite_state *state, int axis);

#endif
