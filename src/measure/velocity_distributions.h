/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of the distribution of one component of C or Omega, from a histogram of x/sigma, measured or a theory's. */
#ifndef GG_VELOCITY_CURVES_H
#define GG_VELOCITY_CURVES_H

#include "measure/histogram.h"

typedef struct gg_velocity_component {
  int n_species, species; /* of so many species, this one */
  bool spin;
  int axis;
} gg_velocity_component;

/* P/P(0), and its deviation from a Gaussian at low velocity. `samples`: those that the bins are the mean over; 0: the
 * bins are probabilities, of which no tail is fitted. */
void gg_measure_velocity_curves_put(gg_curves *list, gg_velocity_component which, const double *bin, double samples);

#endif
