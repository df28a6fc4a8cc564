/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The long-time tail of a velocity correlation beyond the measured lags, and coefficients that include it.
 *
 * A grain's momentum stays with the gas around it and diffuses away as a vortex, so that <C_a(0)C_a(t)> decays not
 * exponentially but as t^(-3/2) (Alder & Wainwright, Phys. Rev. A 1 (1970) 18); from the modes k of a periodic box
 *     (2/3) (T/M) sum_k exp(-(D + nu) k^2 t),   k /= 0,
 * T the temperature as an energy, M the mass of all grains, nu the kinematic viscosity (Ernst, Hauge & van Leeuwen,
 * Phys. Rev. Lett. 25 (1970) 1254). The sum over k is a product of theta functions. It decays exponentially once the
 * vortex fills the box: D is then below that of an infinite gas. */
#ifndef GG_LONG_TIME_TAIL_H
#define GG_LONG_TIME_TAIL_H

#include "common/model.h"

typedef struct gg_long_time_tail {
  bool driven;                 /* no modes, but strength t^(-3/2) beyond t */
  double strength;             /* (2/3) T/M */
  double rate[3];              /* (D + nu) (2 pi/L)^2 of each edge */
  double amplitude, tolerance; /* expected ratio of the true tail to this one, and its uncertainty */
} gg_long_time_tail;

/* The tail in equilibrium. T: of a grain's velocity component, times its mass. D and nu from Enskog's equation;
 * mixtures as one fluid. Theory gives the amplitude within some tens of per cent. */
gg_long_time_tail gg_measure_long_time_tail_of(const gg_model *model, double T);

/* The tail in a driven gas, where momentum is not conserved or is sheared away, is unknown: the estimate is that
 * `left` remains at the time t, with an uncertainty as large, and decays faster than in equilibrium. */
gg_long_time_tail gg_measure_long_time_tail_driven(double left, double t);

/* The integral of the tail from t to infinity. */
double gg_measure_long_time_tail_beyond(const gg_long_time_tail *tail, double t);

/* Difference of D between an infinite gas in equilibrium and the periodic box of the model: xi T/(6 pi eta L), xi =
 * 2.837 in a cube, T as an energy, eta of Enskog (B. Dunweg & K. Kremer, J. Chem. Phys. 99 (1993) 6983; I.-C. Yeh &
 * G. Hummer, J. Phys. Chem. B 108 (2004) 15873). It is the sum of the tail's modes over all times, with nu in place
 * of D + nu, which agrees with measured D of 500 to 4000 grains. */
double gg_measure_long_time_tail_lacking(const gg_model *model, double T);

/* A coefficient as an integral up to the time t, with the noise that a longer time adds: D(t) - D(t') has the
 * variance noise (t - t'). */
typedef struct gg_running {
  double t, D, noise;
} gg_running;

/* D = D(t_0) + A tail(t_0): A from the growth of D(t) after the first time, and from its expected value where that
 * growth is noise (least squares). `tail`: the second term; `unsure`: the standard error from the expected value
 * alone. */
typedef struct gg_coefficient {
  double D, tail, unsure;
} gg_coefficient;
gg_coefficient gg_measure_long_time_tail_coefficient(const gg_long_time_tail *tail, const gg_running *at, int n);

#endif
