/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady states of rough grains: uniform shear; free cooling in its scaled frame; heated. */
#ifndef GG_ROUGH_STEADY_H
#define GG_ROUGH_STEADY_H

#include "theory/heating.h"
#include "theory/rough/rough_state.h"

typedef struct gg_rough_steady {
  gg_rough_choice choice;
  gg_rough_gas gas;
  gg_rough_weight weight;
  gg_rough_stream stream;
  gg_rough_relative relative;
  gg_rough_form form;
  int degree;
  double *a;
} gg_rough_steady;

/* The caller sets choice, gas, weight and stream: those of a shear flow. */
gg_status gg_rough_shear_solve(gg_rough_steady *state, int degree, gg_error *err);

/* The caller sets choice, gas and the spread of the weight's spins; T = 1. x: of heating.h. */
gg_status gg_rough_isotropic_solve(gg_rough_steady *state, int degree, const gg_heating *heating, double *x,
                                   gg_error *err);

/* An isotropic state with its linear response to a slow shear, whose rate the caller sets in gas.shear and in stream;
 * the rest of *state is what its maker left. growth: rate at which the response grows over f0; plain tests only. */
gg_status gg_rough_slow_shear_solve(gg_rough_steady *state, const gg_rough_steady *isotropic, double growth,
                                    gg_error *err);

/* The weight of the next solution: Gaussian of the second moments of this one. False if they are not positive. */
bool gg_rough_follow(gg_rough_steady *state);

void gg_rough_steady_clear(gg_rough_steady *state);

#endif
