/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a velocity correlation has left beyond the lags that were measured: its long-time tail, and coefficients that
 * include it.
 *
 * A grain's momentum stays with the gas around it and diffuses away as a vortex, so that <C_a(0)C_a(t)> ends not
 * exponentially but as t^(-3/2) (Alder & Wainwright, Phys. Rev. A 1 (1970) 18); from the modes k of a periodic box
 *     (2/3) (T/M) sum_k exp(-(D + nu) k^2 t),   k /= 0,
 * T the temperature as an energy, M the mass of all grains, nu the kinematic viscosity (Ernst, Hauge & van Leeuwen,
 * Phys. Rev. Lett. 25 (1970) 1254). The sum over k is a product of theta functions. It ends exponentially once the
 * vortex fills the box, where D stays below that of an endless gas. */
#ifndef GG_LONG_TIME_TAIL_H
#define GG_LONG_TIME_TAIL_H

#include "common/model.h"

typedef struct gg_long_time_tail {
  bool driven;                 /* no modes, but strength t^(-3/2) beyond t */
  double strength;             /* (2/3) T/M */
  double rate[3];              /* (D + nu) (2 pi/L)^2 of each edge */
  double amplitude, tolerance; /* what to expect of the tail over this, and how surely */
} gg_long_time_tail;

/* In equilibrium. T: of a grain's velocity component, times its mass. D and nu from Enskog's equation; mixtures as one
 * fluid. Theory gives the amplitude within some tens of per cent. */
gg_long_time_tail gg_measure_long_time_tail_of(const gg_model *model, double T);

/* In a driven gas, where momentum is not conserved or is sheared away, nobody knows: at the time t so much is left,
 * give or take as much, and it ends faster. */
gg_long_time_tail gg_measure_long_time_tail_driven(double left, double t);

/* The integral of the tail from t to infinity. */
double gg_measure_long_time_tail_beyond(const gg_long_time_tail *tail, double t);

/* Difference of D between an infinite gas in equilibrium and the periodic box of the model: xi T/(6 pi eta L), xi =
 * 2.837 in a cube, T as an energy, eta of Enskog (B. Dunweg & K. Kremer, J. Chem. Phys. 99 (1993) 6983; I.-C. Yeh & G.
 * Hummer, J. Phys. Chem. B 108 (2004) 15873). The sum of the tail's modes over all times, with nu in the place of D +
 * nu, which measured D of 500 to 4000 grains want. */
double gg_measure_long_time_tail_lacking(const gg_model *model, double T);

/* A coefficient as an integral up to the time t, with the noise that a time more adds: that of D(t) - D(t') has the
 * variance noise (t - t'). */
typedef struct gg_running {
  double t, D, noise;
} gg_running;

/* D = D(t_0) + A tail(t_0): A from how D(t) rises after the first time, and from what is expected where that is noise
 * (least squares). `tail`: the second term; `unsure`: the standard error from what is expected alone. */
typedef struct gg_coefficient {
  double D, tail, unsure;
} gg_coefficient;
gg_coefficient gg_measure_long_time_tail_coefficient(const gg_long_time_tail *tail, const gg_running *at, int n);

#endif
