/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Second moments of a sheared gas that is heated or cooled by a divergence S of its heat flux: the Gaussian closure
 * (gaussian_moments.h) with the third moments of 13-moment theory, Q_ijy = 2/5 (q_i d_jy + q_j d_iy + q_y d_ij). At
 * T = 1, shear rate a, with xi = q_x/q_y,
 *   -(A M + M A^T) + collisions = w S/n,   w_xx = w_zz = 2/5,  w_yy = 6/5,  w_xy = 2/5 xi,   tr M = 3,
 * four equations for M_xx, M_yy, M_xy and S. Heat flux, H. Grad, Commun. Pure Appl. Math. 2 (1949) 331, with fourth
 * moments of a Gaussian: nu_q q_y = -n rho_yy T' - 2/5 a q_x, nu_q q_x = -n rho_xy T' - 7/5 a q_y.
 * Solutions are tabulated over density and shear rate, as Chebyshev series. */
#ifndef GG_GAUSSIAN_TABLE_H
#define GG_GAUSSIAN_TABLE_H

#include "theory/walls/newtonian_gas.h"

enum { GG_TABLE_DENSITIES = 10, GG_TABLE_RATES = 18 };

/* Tabulated: ln P_yy/n, ln(-P_yx/(n a)), S/n^2, M_xx, M_yy, M_xy/a, (P_xx - P_yy)/n, (P_zz - P_yy)/n at T = 1. */
enum {
  GG_TABLE_PRESSURE,
  GG_TABLE_VISCOSITY,
  GG_TABLE_SOURCE,
  GG_TABLE_MXX,
  GG_TABLE_MYY,
  GG_TABLE_MXY,
  GG_TABLE_XX,
  GG_TABLE_ZZ,
  GG_TABLE_FUNCTIONS
};

typedef struct gg_gaussian_table {
  gg_newtonian_gas gas;
  double low, high;                /* densities */
  int densities;                   /* 1 at phi = 0, where n = 1 */
  double most[GG_TABLE_DENSITIES]; /* series of ln of the largest shear rate of a density */
  double series[GG_TABLE_FUNCTIONS][GG_TABLE_DENSITIES][GG_TABLE_RATES];
  double n, a; /* the last state that was found: a start for the next */
} gg_gaussian_table;

/* Tabulate for densities from low to high; reach: 1, or more for shear rates far above that of uniform shear.
 * GG_BAD_INPUT, with the reason, if a state is not found. */
gg_status gg_theory_gaussian_table_make(const gg_model *model, double low, double high, double reach,
                                        gg_gaussian_table *table, gg_error *err);

/* The moments of a density and shear rate, solved for. Returns the remaining residual. */
double gg_theory_gaussian_state(gg_gaussian_table *table, double n, double a, double value[GG_TABLE_FUNCTIONS]);

/* xi = q_x/q_y; W = a/nu_q. */
double gg_theory_heat_ratio(const double M[3], double W);

/* Rate nu_q of the heat flux, at T = 1, and density n. */
double gg_theory_heat_rate(const gg_model *model);

/* For gg_gap_gas. */
bool gg_theory_gaussian_table_local(void *table, double P, double tau, double T, gg_gap_local *at);

#endif
