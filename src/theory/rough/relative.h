/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions as a linear operator on the relative motion (d, p) of a pair, summed over all directions:
 *   W_RS = int dk < g_n [Ho_R(d', p') - Ho_R(d, p)] Ho_S(d, p) >,   g_n > 0,
 * without the frequency of collisions. It contains the whole equation: only the expansion of products of functions
 * of grains 1 and 2 in relative and centre coordinates remains (pairs.h). */
#ifndef GG_ROUGH_RELATIVE_H
#define GG_ROUGH_RELATIVE_H

#include "theory/rough/factors.h"

typedef struct gg_rough_relative {
  gg_rough_functions f;
  double *W;                 /* n x n by rows R; 0 between functions of different parities; NULL if it is a product: */
  gg_rough_factors *factors; /* of one direction */
  double *rate;              /* int dk < g_n Ho_S > */
  double *J[3][3];           /* int dk k_i < g_n J_j Ho_S > */
  const gg_stop *stop;       /* borrowed from the gas */
} gg_rough_relative;

/* one_direction: k = z alone, of weight 4 pi, instead of the sphere. */
gg_status gg_rough_relative_make(gg_rough_relative *relative, const gg_rough_gas *gas, const gg_rough_weight *weight,
                                 int degree, bool one_direction, gg_error *err);

/* For isotropic states one direction is enough: W as a product. */
gg_status gg_rough_relative_isotropic(gg_rough_relative *relative, const gg_rough_gas *gas,
                                      const gg_rough_weight *weight, int degree, gg_error *err);
void gg_rough_relative_clear(gg_rough_relative *relative);

static inline double gg_rough_relative_at(const gg_rough_relative *r, int R, int S)
{
  if (r->W) return r->W[(size_t)R * (size_t)r->f.n + (size_t)S];
  return gg_rough_factored(r->factors, &r->f.function[R], &r->f.function[S]);
}

#endif
