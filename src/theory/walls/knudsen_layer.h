/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layer at a wall that takes energy of normal and tangential velocities in another ratio than 3:2, the ratio in which
 * the heat flux of 13-moment theory brings it. There the normal temperature T_n = T_yy (1 + w) differs from that of the
 * gas continued to the wall, by w = D exp(-distance/l). Normal velocities carry q_n, and third moments relax at 3/2 of
 * the rate nu of second ones (Maxwell's molecules); P and q do not change across the layer:
 *   q_n' = -1/3 nu n (T_n - T_t),   q_n - 3/5 q = -2/5 P/nu (T_n - T_t)',   3 (T_n - T_yy) = -2 (T_t - T_xx),
 *   l = sqrt(6/5 T)/nu,   s q_n = 3/5 s q - P T_yy D/sqrt(6/5 T)   at the wall.
 * H. Grad, Commun. Pure Appl. Math. 2 (1949) 331, has the equations of third moments. */
#ifndef GG_KNUDSEN_LAYER_H
#define GG_KNUDSEN_LAYER_H

#include "theory/walls/wall_condition.h"

typedef struct gg_knudsen_layer {
  double normal, tangential; /* temperatures at the wall */
  double heat;               /* s q_n there */
  double grains, warmth;     /* per area, beyond the gas continued to the wall: number, and sum of temperatures */
  double velocity;           /* s times the velocity gained across the layer, likewise */
  double loss;               /* energy lost by collisions per area, likewise */
} gg_knudsen_layer;

/* The layer at a wall, of whose arriving energy the share h is carried by the heat flux. None if gas->path is 0. */
gg_knudsen_layer gg_theory_knudsen_layer(const gg_surface *wall, const gg_arrival *arrival, double h);

#endif
