/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Isotropic functions Phi_l ~ (a^+ . a^+)^l: Sonine polynomials of c^2, orthonormal under the standard Gaussian;
 * tests are Phi_l exp(-decay c^2/2). One direction determines them. */
#ifndef GG_HERMITE_RADIAL_H
#define GG_HERMITE_RADIAL_H

#include "base/error.h"

enum { GG_RADIAL_MOST = 12 }; /* of l */

typedef struct gg_radial {
  int most;     /* l = 0 .. most */
  double decay; /* of tests of l > 1 */
  /* Phi_l = sum_j split[l][j] Ho_2j(c_z) Lambda_(l-j)(c_x, c_y), Lambda the same of two axes. */
  double split[GG_RADIAL_MOST + 1][GG_RADIAL_MOST + 1];
  double across[2][GG_RADIAL_MOST + 1][GG_RADIAL_MOST + 1]; /* < Lambda_M exp(-decay c^2/2) Lambda_m >; [0]: no decay */
  double growth[GG_RADIAL_MOST + 1][GG_RADIAL_MOST + 1];    /* < c.grad psi_l Phi_m > */
  double spread[GG_RADIAL_MOST + 1][GG_RADIAL_MOST + 1];    /* < laplacian psi_l Phi_m > */
} gg_radial;

gg_status gg_hermite_radial_make(gg_radial *radial, int most, double decay, gg_error *err);

/* The distribution of one component: sum_l marginal[l] Ho_2l. */
void gg_hermite_radial_marginal(const gg_radial *radial, const double *alpha, double *marginal);

#endif
