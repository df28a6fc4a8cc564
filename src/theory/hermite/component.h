/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distribution of one component of the velocity: phi(c) sum_k t_k Ho_k(c), phi the standard Gaussian. */
#ifndef GG_HERMITE_COMPONENT_H
#define GG_HERMITE_COMPONENT_H

#include "measure/sonine.h"
#include "theory/hermite/hermite_state.h"

typedef struct gg_hermite_component {
  int degree;
  double t[GG_HERMITE_MOST_DEGREE + 1];
} gg_hermite_component;

/* Along a coordinate axis. */
gg_hermite_component gg_hermite_component_of(const gg_hermite_basis *basis, const gg_hermite_state *state, int axis);

/* <c^order>, up to 6. */
double gg_hermite_component_moment(const gg_hermite_component *component, int order);

/* The histogram of grains (measure/histogram.h): probabilities of bins of x = (c - <c>)/sigma. */
void gg_hermite_component_histogram(const gg_hermite_component *component, double *bin);

/* Speeds of an isotropic distribution. temperature_ratio is not changed. */
void gg_hermite_component_speeds(const gg_hermite_component *component, gg_sonine_sums *sums);

#endif
