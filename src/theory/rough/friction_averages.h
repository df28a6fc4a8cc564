/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Averages over the contact velocity g of one direction, for friction.h: sums over the points of friction_points.h.
 *
 * For contacts that stick, y' and delta are linear in y, so that Ho_a(y') delta^l is a sum of Ho_c(y). Only the
 * averages < g_n Ho_c Ho_b > need sums over points. For contacts that slide at one azimuth, delta is g_n times a
 * constant vector, so that one average serves all l of the same degree. Without these two, each of the n functions
 * (a, l) would need a sum over all points. */
#ifndef GG_ROUGH_FRICTION_AVERAGES_H
#define GG_ROUGH_FRICTION_AVERAGES_H

#include "theory/rough/friction_points.h"

typedef struct gg_rough_averages {
  const gg_rough_functions *f;
  int stride;    /* of rows, by b: whole panels of simd/matrix.h */
  double *T;     /* n rows (a, l): < g_n [Ho_a(y') delta^l - 1_(l = 0) Ho_a(y)] Ho_b(y) > */
  double *rate;  /* < g_n Ho_b > */
  double *J[3];  /* < g_n J_j Ho_b >, along x, y, z */
  double *G, *Q; /* < g_n Ho_c Ho_b > where contacts stick; < g_n Ho_a(y') g_n^L Ho_b > where they slide */
  double *left, *right;
  gg_rough_rays *rays;
} gg_rough_averages;

gg_status gg_rough_averages_make(gg_rough_averages *x, const gg_rough_functions *f, gg_error *err);
void gg_rough_averages_clear(gg_rough_averages *x);

/* False if the flow across the contact is too fast beside thermal velocities. */
bool gg_rough_averages_at(gg_rough_averages *x, const gg_rough_frame *frame);

#endif
