/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lun's constitutive functions, for the theory and its tests. */
#ifndef GG_LUN1991_H
#define GG_LUN1991_H

#include "theory/answer.h"

/* State of the gas: n d^3 (1 in the Boltzmann limit, where phi = 0), chi, the grains, theta/T. */
typedef struct gg_lun_state {
  double n, phi, chi;
  gg_grain grain;
  double ratio;
} gg_lun_state;

/* p = T f1, mu_s = T^1/2 f2, mu_r = T^1/2 f2r, xi = T^1/2 f3, D = T^3/2 f5, rotational gain = T^3/2 f5r: per volume
 * with m = d = 1; times pi/6 in units of rho_p. */
typedef struct gg_lun_functions {
  double f1, f1_kinetic, f1_transfer; /* the sum and its parts */
  double f2, f2_kinetic, f2_transfer;
  double f2r, f3, f5, f5r;
  double f4[2][2]; /* conductivities T^1/2 f4: of translational and rotational heat along -grad T and -grad theta */
} gg_lun_functions;

gg_lun_functions gg_theory_lun_functions_at(gg_lun_state s);

/* Rates of the heat fluxes of translation and rotation, q_0 and q_1, which decay and couple: dq_i/dt = -nu_0 chi
 * sum_j rate_ij q_j of Maxwellians with a first Sonine term each. `flux` solves (rate - fading) flux = source; false
 * if the matrix is no longer positive. */
typedef struct gg_heat_rates {
  double at[2][2];
} gg_heat_rates;
gg_heat_rates gg_theory_heat_rates(gg_grain g, double ratio);
bool gg_theory_heat_flux(gg_heat_rates rate, double fading, const double source[2], double flux[2]);

/* theta/T at which the spins neither gain nor lose energy: eta_2/(1 - eta_2/K) = K(1+beta)/(1+2K-beta). */
double gg_theory_lun_ratio(gg_grain g);

/* Steady uniform shear with a given contact value. */
gg_status gg_theory_lun_shear(const gg_model *model, double chi, const char *theory, gg_theory_answer *answer,
                              gg_error *err);

#endif
