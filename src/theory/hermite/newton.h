/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady state: Newton's method on the coefficients; the Gaussian follows the second moments. */
#ifndef GG_HERMITE_NEWTON_H
#define GG_HERMITE_NEWTON_H

#include "theory/hermite/operator.h"

/* A bath whose drag and noise, times `factor`, keep all grains at the temperature T = sum_i x_i m_i <C.C>_i/3. A gas
 * may have several states at one drag, but it has one drag at each temperature. */
typedef struct gg_hermite_pin {
  double T, factor;
  gg_hermite_gas bath;    /* drag and diffusion for factor 1, without other streaming */
  struct gg_newton *kept; /* the Jacobian of the last call, reused by the next one */
} gg_hermite_pin;
gg_hermite_pin gg_hermite_pin_of(const gg_hermite_gas *gas);
void gg_hermite_pin_end(gg_hermite_pin *pin);
double gg_hermite_temperature(const gg_hermite_basis *basis, const gg_hermite_gas *gas, const gg_hermite_state *state);

/* Starts from the given states, one of each species, whose widths are kept. GG_FAILED if the iteration does not
 * converge. With `pin` (else NULL) its factor is an unknown, too, with the given initial value. */
gg_status gg_hermite_newton(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                            gg_hermite_pin *pin, gg_error *err);

#endif
