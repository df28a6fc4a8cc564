/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The operator of relative.h with Coulomb friction: the impulse depends on the contact velocity g alone,
 * J = eta1 g_n k + j g_t with j = eta2 where eta2 |g_t| <= mu eta1 g_n (the contact sticks), else j = mu eta1 g_n/|g_t|
 * (it slides). So z' is no longer a polynomial in z, and the integrals over g are quadratures.
 *
 * For each direction k there are orthonormal coordinates y = Y z. The first three make the contact velocity,
 * g = R y + m with R lower triangular. A collision changes these three by a function of g, and shifts y4, y5, y6 by
 * delta, another function of g.
 *
 * Indices are pairs: (a, l) stands for Ho_a of y1, y2, y3 times Ho_l of y4, y5, y6. The averages over y1, y2, y3,
 *   T_(a,l),b = < g_n [Ho_a(y') delta^l - 1_(l = 0) Ho_a(y)] Ho_b(y) >,
 * give the columns (b, 0) of the operator, W_(a,l),(b,0) = T_(a,l),b/sqrt(l!). Rotations of planes turn their rows from
 * y to z. The columns (b, Q) follow from these by creation operators, and rotations turn the columns last. */
#ifndef GG_ROUGH_FRICTION_H
#define GG_ROUGH_FRICTION_H

#include "theory/rough/rough_collision.h"

/* Sums over directions, each of n functions. Those of J: int dk k_i < g_n J_j Ho_S >. */
typedef struct gg_rough_sums {
  double *W, *rate, *(*J)[3];
} gg_rough_sums;

typedef struct gg_rough_friction gg_rough_friction;

/* `alone`: one direction is all, and its memory is that of the sums. */
gg_status gg_rough_friction_make(gg_rough_friction **friction, const gg_rough_functions *f, bool alone, gg_error *err);
void gg_rough_friction_free(gg_rough_friction *friction);
gg_status gg_rough_friction_add(gg_rough_friction *friction, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                const double k[3], double solid_angle, gg_rough_sums *sums, gg_error *err);

#endif
