/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decay of disturbances of a steady state: the eigenvalues of the Jacobian, as rates. */
#ifndef GG_HERMITE_SPECTRUM_H
#define GG_HERMITE_SPECTRUM_H

#include "theory/hermite/operator.h"

/* A disturbance is proportional to exp(-decay t) cos(frequency t). */
typedef struct gg_hermite_mode {
  double decay, frequency;
} gg_hermite_mode;

/* All modes with the symmetries of the flow, the slowest first: basis.n - 1 of them for each species. */
gg_status gg_hermite_spectrum(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                              gg_hermite_mode *mode, gg_error *err);

#endif
