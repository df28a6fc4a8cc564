/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Size limit of homogeneous states of a dissipative gas. */
#ifndef GG_GOLDHIRSCH_ZANETTI1993_H
#define GG_GOLDHIRSCH_ZANETTI1993_H

#include "theory/theory.h"

/* Box length above which free cooling at this density breaks up into vortices and clusters, in d of species 1 (in
 * 1/(n d^2) in the Boltzmann limit), or the state that the model's Gaussian thermostat heats: INFINITY for elastic
 * grains; NaN where it is unknown: rough mixtures, three species and more, friction. */
double gg_theory_clustering_length(const gg_model *model);

/* Number of grains up to which a box of this density and shape stays homogeneous, for free cooling and for the
 * Gaussian thermostat, which is the same gas in other units; INFINITY for elastic grains, NaN for other states and
 * where it is unknown. */
double gg_theory_stable_grains(const gg_model *model);

/* "homogeneity: the box is 12 d long and stays homogeneous up to 8.5 d only, about 350 grains: ..."; false if that
 * size is not finite. Returns text. */
bool gg_theory_stable_size(const gg_model *model, char *text, size_t size);

#endif
