/* Velocity moments of grains, by species, summed over chunks. */
#ifndef GG_MOMENTS_H
#define GG_MOMENTS_H

#include "common/engine.h"

/* Sums over grains of one species; spins about `mean_spin`. */
typedef struct gg_moments {
  double n;
  double c[3];         /* C_a */
  double cc[3], cxcy;  /* C_a^2, C_x C_y */
  double c4[3];        /* C_a^4 */
  double cccc;         /* (C.C)^2 */
  double speed;        /* |C| */
  double mean_spin[3]; /* about which spins are taken; <s_a> once settled */
  double w[3];         /* sums of powers of Omega_a = s_a - mean_spin, surface velocities */
  double ww[3], w3[3], w4[3];
  double cos2; /* (C.Omega)^2/(C^2 Omega^2) */
} gg_moments;

/* Add the moments of n grains. */
void gg_moments_translation(gg_moments *m, size_t n, const double *const c[3]);
/* Of spins about m->mean_spin, any guess of their mean. */
void gg_moments_rotation(gg_moments *m, size_t n, const double *const c[3], const double *const s[3]);
/* All grains are in: mean_spin becomes their mean, and the powers of Omega are about it. */
void gg_moments_settle(gg_moments *m);

#endif
