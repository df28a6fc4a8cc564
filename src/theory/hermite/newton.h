/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady state: Newton's method on the coefficients, the Gaussian following the second moments. */
#ifndef GG_HERMITE_NEWTON_H
#define GG_HERMITE_NEWTON_H

#include "theory/hermite/operator.h"

/* From the states given, one of each species, whose widths are kept. GG_FAILED where the iteration does not converge.
 */
gg_status gg_hermite_newton(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state, gg_error *err);

#endif
