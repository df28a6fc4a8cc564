/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gas of rough grains for flow across a gap: what closes the balances of rough_gap.h. With the mean spin omega along
 * z, its excess w = omega + u'/2 over rolling with the flow, r = theta/T, m = d = 1, and per volume,
 *   P_yx = -mu_s u' - 2 mu_r w,   M' = -4 mu_r w,   M = -D omega',   mu_r = eta_2 n^2 chi sqrt(pi T)/3,
 *   (q, q_r) = -(kappa) (T', theta'),   gain of rotation f5r T^(3/2), loss of translation f5 T^(3/2),
 * with the coefficients of lun1991. Contacts of grains that do not roll take 4 mu_r w^2 from the mean motion; eta_2 of
 * it heats translation, eta_2/K rotation (exact for Gaussian velocities and spins).
 *
 * The couple stress M = (K/2) n <C_y s_z> is of spins carried: contacts change both spins alike. It decays at the rate
 * nu_s, from averages over contacts of Gaussians (contact_averages.h) to first order in <C_y s_z>:
 *   D = (K/4) n T/nu_s,   nu_s = (4/3) sqrt(pi T) n chi (2 + e + beta),
 * whatever theta is. At the same order dense gases have a source of M from contacts, -16/5 phi chi e eta_2/K times that
 * of D, and a torque -0.4 mu_r omega''. Both are left out: spins relax within a diameter there, and an expansion in
 * gradients would grow without bound. In the limit phi = 0 spins s = omega/2 remain beside velocities, and u' is
 * nothing beside omega. */
#ifndef GG_ROUGH_FLUID_H
#define GG_ROUGH_FLUID_H

#include "theory/lun1991.h"
#include "theory/walls/newtonian_gas.h"

/* State at one height. */
typedef struct gg_rough_state {
  double P, tau, T, theta, omega;
} gg_rough_state;

typedef struct gg_rough_local {
  gg_gap_local gas;  /* n, phi, u', stress and temperatures of arriving grains; no heat flux, no loss */
  double torque;     /* M' */
  double turning;    /* D */
  double heat[2][2]; /* conductivities of (T', theta') */
  double gain[2];    /* of energy of translation and of rotation, mean motion included; work of gravity not */
  double slides[2];  /* heat that translation and rotation gain where grains do not roll */
} gg_rough_local;

typedef struct gg_rough_fluid {
  gg_newtonian_gas density; /* the gas at a density */
  gg_grain grain;
  /* The closure; false outside its densities. */
  bool (*local)(struct gg_rough_fluid *gas, const gg_rough_state *state, gg_rough_local *at);
} gg_rough_fluid;

/* The gas of lun1991. */
void gg_theory_rough_fluid_make(const gg_model *model, gg_rough_fluid *gas);
bool gg_theory_rough_fluid_local(gg_rough_fluid *gas, const gg_rough_state *state, gg_rough_local *at);

/* mu_r, and D where <C_y^2> = Tyy, at the density of the gas. */
double gg_theory_rough_fluid_grip(const gg_rough_fluid *gas, double T);
double gg_theory_rough_fluid_turning(const gg_rough_fluid *gas, double T, double Tyy);

/* For gg_gap_gas: grains that roll, with theta/T of driven translation. */
bool gg_theory_rough_fluid_rolling(void *gas, double P, double tau, double T, gg_gap_local *at);

#endif
