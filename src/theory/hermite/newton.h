/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady state: Newton's method on the coefficients, the Gaussian following the second moments. */
#ifndef GG_HERMITE_NEWTON_H
#define GG_HERMITE_NEWTON_H

#include "theory/hermite/operator.h"

/* A bath whose drag and noise, times `factor`, keep all grains at the temperature T = sum_i x_i m_i <C.C>_i/3: where a
 * gas has several states at one drag, it has one drag at each temperature. */
typedef struct gg_hermite_pin {
  double T, factor;
  gg_hermite_gas bath;    /* drag and diffusion of factor 1, and nothing else that streams */
  struct gg_newton *kept; /* the Jacobian of the last call, for the next one */
} gg_hermite_pin;
gg_hermite_pin gg_hermite_pin_of(const gg_hermite_gas *gas);
void gg_hermite_pin_end(gg_hermite_pin *pin);
double gg_hermite_temperature(const gg_hermite_basis *basis, const gg_hermite_gas *gas, const gg_hermite_state *state);

/* From the states given, one of each species, whose widths are kept. GG_FAILED where the iteration does not converge.
 * With `pin` (else NULL) its factor is an unknown, too, from the one given on. */
gg_status gg_hermite_newton(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                            gg_hermite_pin *pin, gg_error *err);

#endif
