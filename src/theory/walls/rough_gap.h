/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady flow of one species of rough grains across the gap between flat walls. Beside the balances of gap.h there are
 * those of spin and of rotational energy, theta its temperature and q_r its heat flux:
 *   M' = torque,   R' = gain of rotation,   R = q_r + M omega,
 *   E' = n g_x u + gain of translation,     E = q + tau u.
 * Grains in layers at a wall, beyond those of the gas continued to it, lose spin in contacts as the gas there does: of
 * the couple that the wall gives, the gas takes what is left. In dense gases that is much, since spins relax within a
 * diameter. */
#ifndef GG_ROUGH_GAP_H
#define GG_ROUGH_GAP_H

#include "theory/walls/rough_fluid.h"

/* Unknown functions of y: first those of gap.h. */
enum { GG_ROUGH_LOG_THETA = GG_GAP_FUNCTIONS, GG_ROUGH_OMEGA, GG_ROUGH_R, GG_ROUGH_M, GG_ROUGH_FUNCTIONS };

/* The flow at one height: fluxes along y, of translation and rotation; what profiles call solid fraction. */
typedef struct gg_rough_height {
  gg_rough_state state;
  gg_rough_local local;
  double density, u, heat[2], couple, P_xy;
} gg_rough_height;

gg_rough_height gg_theory_rough_gap_at(const gg_gap_flow *flow, double y);

/* The flow of rough grains of constant beta, as gg_theory_gap_solve; the gas stays with *flow. */
gg_status gg_theory_rough_gap_solve(const gg_model *model, gg_rough_fluid *gas, const char *theory, gg_gap_flow *flow,
                                    gg_error *err);

#endif
