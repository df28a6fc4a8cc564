/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smooth binary mixtures: collision rates of moments at partial temperatures T_i, as functions of a_i = T_i/m_i. */
#ifndef GG_MIXTURE_H
#define GG_MIXTURE_H

#include "theory/answer.h"

enum { GG_BINARY = 2 }; /* number of species in these theories */

/* Value for Maxwellians and its slope in the fourth cumulants c_1, c_2. */
typedef struct gg_linear {
  double at0, slope[GG_BINARY];
} gg_linear;

/* d<v^2>_i/dt and d<v^4>_i/dt by collisions. */
gg_linear gg_theory_rate_v2(const gg_model *model, int i, const double a[GG_BINARY]);
gg_linear gg_theory_rate_v4(const gg_model *model, int i, const double a[GG_BINARY]);

/* Cooling rate of T_i: zeta_i = -d<v^2>_i/dt / (3 a_i). */
gg_linear gg_theory_zeta(const gg_model *model, int i, const double a[GG_BINARY]);

/* Relaxation of the traceless part Pi_i = <V V>_i - a_i: d Pi_i/dt = -sum_j A_ij Pi_j. */
void gg_theory_stress_relaxation(const gg_model *model, const double a[GG_BINARY], double A[GG_BINARY][GG_BINARY]);

/* a_i of a mixture at T = sum x_i T_i with T_1/T_2 = ratio. */
void gg_theory_partial_spreads(const gg_model *model, double T, double ratio, double a[GG_BINARY]);

/* Solve A x = b, 2 x 2. */
void gg_theory_solve2(double A[GG_BINARY][GG_BINARY], const double b[GG_BINARY], double x[GG_BINARY]);

/* Root of f in T_1/T_2, nearest to equipartition; NaN if none between 1e-6 and 1e6. */
double gg_theory_solve_ratio(double (*f)(double ratio, void *params), void *params);

/* T, T_1, T_2, T_1/T_2 and collisions. */
void gg_theory_answer_partial_temperatures(const gg_model *model, const double a[GG_BINARY], gg_theory_answer *answer);

#endif
