/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Homogeneous states of smooth spheres, for the theories of one species and of mixtures. */
#ifndef GG_GARZO_DUFTY1999_H
#define GG_GARZO_DUFTY1999_H

#include "theory/answer.h"

/* Fourth cumulant a_2 of free cooling in two linearisations, and of a gas heated by white noise. */
double gg_theory_a2_van_noije_ernst(double e);
double gg_theory_a2_montanero_santos(double e);
double gg_theory_a2_white_noise(double e);

/* s in nu_eta - s zeta: 1/2 for cooling, 1 for a Gaussian thermostat, 0 for white noise. */
double gg_theory_thermostat_factor(const gg_model *model);

/* Answers for one species at first Sonine order: temperature, pressure, cooling and collision rate. */
void gg_theory_answer_sonine(const gg_model *model, double T, double a2, gg_theory_answer *answer);

#endif
