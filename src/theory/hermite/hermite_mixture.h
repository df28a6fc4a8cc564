/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Homogeneous mixtures of smooth grains, cooling or heated: each species is a sum of isotropic functions about a
 * Gaussian of its temperature. Heating: theory/heating.h. */
#ifndef GG_HERMITE_MIXTURE_H
#define GG_HERMITE_MIXTURE_H

#include "theory/heating.h"
#include "theory/hermite/radial.h"

typedef struct gg_hermite_mixture {
  gg_radial radial;
  double scale[GG_MAX_SPECIES]; /* of each species: C = scale c */
  double alpha[GG_MAX_SPECIES][GG_RADIAL_MOST + 1];
  gg_heating drive;
  double heating; /* x of heating.h, at sum_i x_i T_i = 1 */
} gg_hermite_mixture;

/* Solve for degree 2 l of the expansion; starts from the given scales (all 0: from equal temperatures). */
gg_status gg_hermite_mixture_solve(gg_hermite_mixture *mixture, const gg_model *model, int most, gg_error *err);

/* Cooling rate of the temperature sum_i x_i T_i at 1. */
double gg_hermite_mixture_cooling(const gg_hermite_mixture *mixture, const gg_model *model);

/* <c^2>/3 and <c^4> of a species, over its own scale. */
double gg_hermite_mixture_square(const gg_hermite_mixture *mixture, int species);
double gg_hermite_mixture_fourth(const gg_hermite_mixture *mixture, int species);

/* < g^power > of the approaching pairs of two species along one direction. */
double gg_hermite_mixture_flux(const gg_hermite_mixture *mixture, int i, int j, int power);

#endif
