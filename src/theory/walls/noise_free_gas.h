/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transport coefficients of enskog_hermite at all densities, from four of its solutions. With y = phi chi and
 * s = d ln chi/d ln n, Enskog's equation makes reduced coefficients
 *   zeta = chi z,   eta_k = (a + b y)/chi,   kappa_k = (a' + b' y)/chi,   mu_k = (p + q y + r s + t y s)/chi,
 *   eta = eta_k (1 + 4/5 (1+e) y) + 3/5 c phi y,   kappa = kappa_k (1 + 6/5 (1+e) y) + c' phi y,
 *   mu = mu_k (1 + 6/5 (1+e) y). */
#ifndef GG_NOISE_FREE_GAS_H
#define GG_NOISE_FREE_GAS_H

#include "theory/theory.h"

typedef struct gg_noise_free_gas {
  double zeta, eta[2], kappa[2], mu[4]; /* powers of y; mu: 1, y, s, y s */
  double bulk, collisional;             /* 3/5 c, c' */
} gg_noise_free_gas;

/* For the e of a model of smooth grains. */
gg_status gg_theory_noise_free_gas_make(const gg_model *model, gg_noise_free_gas *gas, gg_error *err);

/* Cooling rate, viscosity, conductivities of the model's density. */
void gg_theory_noise_free_gas_at(const gg_noise_free_gas *gas, const gg_model *model, gg_theory_answer *answer);

#endif
