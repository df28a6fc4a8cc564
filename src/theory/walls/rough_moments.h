/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gas of rough grains whose stress is that of Gaussian velocities at the local shear rate, as gaussian_table.h has it
 * for smooth grains: <CC> at T = 1 obeys
 *   -(A M + M A^T) + contacts = w S/n,   w_xx = w_zz = 2/5,  w_yy = 6/5,  w_xy = 2/5 xi,   xi = q_x/q_y = -7/5 a/nu_q,
 * with the production of rough_contacts.h at the local n, shear rate and theta/T. S is the divergence of the heat flux
 * of translation. Spins are isotropic; where they do not roll, and for their couple stress, rough_fluid.h holds with
 * <C_y^2>. Heat fluxes are those of lun1991. The factors that gaussian_table.h has on them are left out: where shear
 * heats the gas they change numbers by up to 3 %. */
#ifndef GG_ROUGH_MOMENTS_H
#define GG_ROUGH_MOMENTS_H

#include "theory/walls/band_matrix.h"
#include "theory/walls/rough_contacts.h"
#include "theory/walls/rough_fluid.h"

/* Unknowns: ln n, the shear rate at T = 1, and the deviator of <CC>. */
enum { GG_ROUGH_LOG_N, GG_ROUGH_SHEAR, GG_ROUGH_XX, GG_ROUGH_YY, GG_ROUGH_XY, GG_ROUGH_UNKNOWNS };

typedef struct gg_rough_moments {
  gg_rough_fluid gas; /* first: `local` is handed the gas */
  gg_rough_contacts contacts;
  gg_contact_series series;    /* at the last theta/T */
  double heat_rate;            /* of the translational heat flux there, over nu_0 chi */
  double x[GG_ROUGH_UNKNOWNS]; /* the last solution, a start for the next, and its derivatives */
  bool known;
  int pivot[GG_ROUGH_UNKNOWNS];
  double cell[GG_ROUGH_UNKNOWNS * (3 * GG_ROUGH_UNKNOWNS - 2)];
} gg_rough_moments;

gg_status gg_theory_rough_moments_make(const gg_model *model, gg_rough_moments *gas, gg_error *err);

#endif
