/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady uniform shear of smooth grains, with or without heating by white noise, each species about a separate
 * Gaussian: degree after degree. */
#ifndef GG_HERMITE_SHEAR_H
#define GG_HERMITE_SHEAR_H

#include "theory/hermite/operator.h"

typedef struct gg_hermite_shear {
  const gg_model *model;
  gg_hermite_gas gas;
  gg_hermite_operator op; /* of the present degree */
  gg_hermite_state state[GG_MAX_SPECIES];
} gg_hermite_shear;

/* Starts with the anisotropic Gaussians of the second moments, warmer if noise heats. */
gg_status gg_hermite_shear_begin(gg_hermite_shear *shear, const gg_model *model, gg_error *err);
void gg_hermite_shear_end(gg_hermite_shear *shear);

/* The steady state at this degree (even, from 4 on; not below that of the last call). */
gg_status gg_hermite_shear_solve(gg_hermite_shear *shear, int degree, gg_error *err);

/* The same at the present degree about Gaussians of other widths, by species, if the temperatures are close. */
gg_status gg_hermite_shear_about(gg_hermite_shear *shear, const double width[], gg_error *err);

/* widening.c: the same at the present degree about Gaussians that are wide enough for the tails of grains in a bath.
 * `widened`: wider Gaussians were needed. GG_FAILED if no width is enough. */
bool gg_hermite_shear_has_tails(gg_hermite_shear *shear); /* so that Gaussians have to be wider */
gg_status gg_hermite_shear_widen(gg_hermite_shear *shear, bool *widened, gg_error *err);

bool gg_hermite_has_drag(const gg_hermite_gas *gas);

#endif
