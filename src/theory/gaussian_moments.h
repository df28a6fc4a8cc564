/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collision integrals of Enskog's equation over anisotropic Gaussian distributions of velocity and spin,
 *   f_i = n_i N(C; 0, M_i) N(s; s_i z, Theta_i),
 * exact in shear rate, roughness and density: the production terms of the second moments, and the collisional stress.
 * Spins are surface velocities s = (d/2) omega. Model units, per grain or per volume. */
#ifndef GG_GAUSSIAN_MOMENTS_H
#define GG_GAUSSIAN_MOMENTS_H

#include "theory/contact_averages.h"
#include "theory/theory.h"

typedef struct gg_gaussian_rates {
  gg_gaussian change[GG_MAX_SPECIES]; /* d/dt of each moment, by collisions alone */
  gg_tensor Pc;                       /* collisional stress per volume; 0 in the Boltzmann limit */
  double loss; /* energy per volume that collisions dissipate; computed without differences of large numbers */
  double frequency[GG_MAX_SPECIES]; /* collisions per grain of the species */
  double speed[GG_MAX_SPECIES];     /* <|C|> */
} gg_gaussian_rates;

/* Rates of the moments for smooth, rough or frictional grains, any number of species; shear_rate and sizes from the
 * model. One state a species; the spins of a species that never spins are ignored. */
void gg_theory_gaussian_rates_at(const gg_model *model, const gg_gaussian *state, gg_gaussian_rates *rates);

/* The same with streaming and the bath; and per volume the energy that the bath supplies and removes (flow). */
void gg_theory_gaussian_changes_at(const gg_model *model, const gg_gaussian *state, gg_gaussian_rates *rates,
                                   double flow[2]);

/* gaussian_relaxation.c: true if the closure describes the relaxation of this gas. */
bool gg_theory_gaussian_relaxes(const gg_model *model);
void gg_theory_gaussian_start(const gg_model *model, gg_gaussian state[]);
/* Kinetic and collisional stress. */
gg_tensor gg_theory_gaussian_stress(const gg_model *model, const gg_gaussian state[]);

/* The steady state of uniform shear. Returns the largest remaining residual: changes per mean free time; the balance
 * of energy; and that of shear stresses, a thousandth of the relative ones, which small stresses do not hide (NaN:
 * no memory). */
double gg_theory_gaussian_steady(const gg_model *model, gg_gaussian *state);

/* True if any collision of this species changes its spin. */
bool gg_theory_species_spins(const gg_model *model, int species);

#endif
