/* Velocity moments of grains, by species, summed over chunks. */
#ifndef GG_MOMENTS_H
#define GG_MOMENTS_H

#include "common/engine.h"

/* Sums over grains of one species; spins about `mean_spin`. */
typedef struct gg_moments {
  double n;
  double c[3];              /* C_a */
  double cc[3], cxcy;       /* C_a^2, C_x C_y */
  double c4[3];             /* C_a^4 */
  double cccc;              /* (C.C)^2 */
  double speed;             /* |C| */
  double mean_spin[3];      /* <s_a>, from the first pass */
  double s[3];              /* s_a */
  double ww[3], w4[3], w3z; /* Omega_a^2, Omega_a^4, Omega_z^3, surface velocities */
  double cos2;              /* (C.Omega)^2/(C^2 Omega^2) */
} gg_moments;

/* Add the translational moments of n grains; `spins` (may be NULL) adds sum s for the mean. */
void gg_moments_translation(gg_moments *m, size_t n, const double *const c[3]);
void gg_moments_mean_spin(gg_moments *m, size_t n, const double *const s[3]);
/* Second pass, once mean_spin is set. */
void gg_moments_rotation(gg_moments *m, size_t n, const double *const c[3], const double *const s[3]);

#endif
