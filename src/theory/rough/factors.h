/* SPDX-License-Identifier: GPL-3.0-or-later */
/* W of one direction, k = z, for an isotropic weight: a collision is a product. The normal velocity d_z is
 * independent, d_x couples with the spin p_y, d_y with p_x, and p_z stays. No matrix is stored, so that degrees may
 * be high. */
#ifndef GG_ROUGH_FACTORS_H
#define GG_ROUGH_FACTORS_H

#include "theory/rough/rough_collision.h"

enum { GG_ROUGH_SIDE = GG_ROUGH_MOST_DEGREE + 1 };

typedef struct gg_rough_factors {
  /* 4 pi < g_n Ho_r(d_z') Ho_s(d_z) >, and the same before the collision. */
  double gain[GG_ROUGH_SIDE][GG_ROUGH_SIDE], loss[GG_ROUGH_SIDE][GG_ROUGH_SIDE];
  /* < Ho_a(d') Ho_b(p') Ho_s(d) Ho_t(p) > of both tangents, by a, b, s, t. */
  double along[2][GG_ROUGH_SIDE][GG_ROUGH_SIDE][GG_ROUGH_SIDE][GG_ROUGH_SIDE];
} gg_rough_factors;

gg_status gg_rough_factors_make(gg_rough_factors *factors, const gg_rough_collision *collision, int degree,
                                gg_error *err);

static inline double gg_rough_factored(const gg_rough_factors *f, const gg_rough_index *one, const gg_rough_index *two)
{
  const int *R = one->r, *S = two->r;
  if (R[5] != S[5] || gg_rough_class(*one) != gg_rough_class(*two)) return 0;
  double value = f->gain[R[2]][S[2]] * f->along[0][R[0]][R[4]][S[0]][S[4]] * f->along[1][R[1]][R[3]][S[1]][S[3]];
  if (R[0] == S[0] && R[1] == S[1] && R[3] == S[3] && R[4] == S[4]) value -= f->loss[R[2]][S[2]];
  return value;
}

#endif
