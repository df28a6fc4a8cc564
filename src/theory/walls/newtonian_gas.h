/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A Newtonian gas for flow across a gap: coefficients of the cooling gas at the local density,
 *   eta = c_0 sqrt(T) eta*,  kappa = 15/4 c_0 sqrt(T) kappa*,  n mu = 15/4 c_0 T^(3/2) mu*,
 *   loss = 3/2 n T zeta* n sqrt(T)/c_0,   P = n T Z,   c_0 = 5/(16 sqrt(pi)),
 * reduced as in quantities.md, of garzo_santos_montanero2007, or of enskog_hermite (noise_free_gas.h). The stress is
 * tau = -eta u', P_xx = P_yy = P_zz. */
#ifndef GG_NEWTONIAN_GAS_H
#define GG_NEWTONIAN_GAS_H

#include "theory/theory.h"
#include "theory/walls/gap.h"
#include "theory/walls/noise_free_gas.h"

typedef struct gg_newtonian_gas {
  gg_model model;          /* the cooling gas at a density, */
  gg_theory_answer answer; /* and its reduced coefficients */
  double most;             /* solid fraction up to which the contact value is used */
  bool noise_free;         /* are coefficients those of enskog_hermite? Then */
  gg_noise_free_gas series;
} gg_newtonian_gas;

void gg_theory_newtonian_gas_make(const gg_model *model, gg_newtonian_gas *gas);
void gg_theory_newtonian_gas_set(gg_newtonian_gas *gas, double n);
/* Model and coefficients at the number density n. */
void gg_theory_newtonian_gas_at(gg_newtonian_gas *gas, double n);
/* Model at the density where P = x T; false beyond those of the contact value. */
bool gg_theory_newtonian_gas_find(gg_newtonian_gas *gas, double x);
/* For gg_gap_gas. */
bool gg_theory_newtonian_gas_local(void *gas, double P, double tau, double T, gg_gap_local *at);

#endif
