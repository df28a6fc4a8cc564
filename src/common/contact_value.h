/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact value chi of the pair correlation function, and equations of state of elastic hard spheres. */
#ifndef GG_CONTACT_VALUE_H
#define GG_CONTACT_VALUE_H

#include "common/kinds.h"

/* One species. Carnahan & Starling, J. Chem. Phys. 51 (1969) 635: (1 - phi/2)/(1-phi)^3;
 * Lun & Savage 1987: (1 - phi/0.64)^(-1.6); Kolafa, Labik & Malijevsky 2004 in the refit of Pieprzyk et al. 2019.
 *
 * Two are fits to simulations of sheared dissipative spheres and diverge at their densest packing, phi = 0.636:
 *   D. Vescovi, D. Berzi, P. Richard & N. Brodu, Phys. Fluids 26 (2014) 053305: (1 - w) CS + 2w/(0.636 - phi),
 *     w = ((phi - 0.4)/0.236)^2 above phi = 0.4, else 0;
 *   S. Chialvo & S. Sundaresan, Phys. Fluids 25 (2013) 070603: CS + 0.58 phi^2/(0.636 - phi)^(3/2). */
double gg_common_contact_value_of(gg_contact_value kind, double phi);

/* Largest phi for which a formula is used: higher scenes are rejected, fuller cells between walls count as this full.
 * Kolafa's fit bends down there, and is negative at 0.6; the others have 0.63, below their divergence. */
double gg_common_contact_value_limit(gg_contact_value kind);

/* Boublik-Mansoori-Carnahan-Starling-Leland value for additive mixtures (Grundke & Henderson 1972; Montanero's review,
 * eq. 3): phi_hat = (pi n/6) sum x_i d_i^2, d_red = d_i d_j/sigma_ij. */
double gg_common_contact_value_mixture(double phi, double phi_hat, double d_red);

/* Compressibility factor Z = p/(nT) of the elastic fluid: 1 + 4 phi chi, for Kolafa the fit. */
double gg_common_compressibility(gg_contact_value kind, double phi);

#endif
