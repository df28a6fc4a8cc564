/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Homogeneous smooth grains with heating that balances their loss of energy, at T = 1: theory/heating.h. f is
 * isotropic: a sum of Phi_l ~ (a^+ . a^+)^l, Sonine polynomials of c^2, for which one direction is enough. */
#ifndef GG_HERMITE_ISOTROPIC_H
#define GG_HERMITE_ISOTROPIC_H

#include "theory/heating.h"
#include "theory/hermite/operator.h"

typedef struct gg_hermite_isotropic {
  gg_hermite_operator op;
  gg_hermite_gas gas; /* drag and diffusion are those of the solution */
  gg_hermite_state state;
  double cooling_rate; /* of the temperature by collisions, at T = 1 */
  double heating;      /* x of heating.h */
} gg_hermite_isotropic;

/* frequency = n chi sigma^2. */
gg_status gg_hermite_isotropic_solve(gg_hermite_isotropic *h, int degree, double frequency, double eta,
                                     const gg_heating *heating, gg_error *err);
/* a of the Ho_r from alpha_l of the Phi_l. */
void gg_hermite_isotropic_expand(const gg_hermite_basis *basis, const double *alpha, double *a);

/* zeta_u of a cooling gas, zeta = zeta_0 + zeta_u div u: the loss of grains that separate at contact, and of the
 * response of f to that, which decays at zeta/2 as the thermal speed does. `reach`: sigma in the length unit of
 * frequency. */
gg_status gg_hermite_isotropic_expansion(gg_hermite_isotropic *h, double reach, double *zeta_u, gg_error *err);

void gg_hermite_isotropic_end(gg_hermite_isotropic *h);

#endif
