/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of the distribution of one component of C or Omega, from a histogram of x/sigma, measured or of a theory. */
#ifndef GG_VELOCITY_CURVES_H
#define GG_VELOCITY_CURVES_H

#include "measure/histogram.h"

typedef struct gg_velocity_component {
  int n_species, species; /* number of species, and the index of this one */
  bool spin;
  int axis;
} gg_velocity_component;

/* P/P(0), and its deviation from a Gaussian at low velocity. `samples`: number of samples in the mean of the bins;
 * 0: the bins are probabilities, without a fit of the tail. */
void gg_measure_velocity_curves_put(gg_curves *list, gg_velocity_component which, const double *bin, double samples);

#endif
