/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In sums over all grains noise would drown them where gases cool fast. So f1/f0 is followed instead: copies of the
 * grains carry it as weights w, and collide for some time. Two that collide both get w_1 + w_2; a candidate that is
 * rejected, of probability p, takes w_2 p/(1 - p) from w_1, and w_1 p/(1 - p) from w_2. Their average is the linearised
 * collision operator (H.A. Al-Mohssen and N.G. Hadjiconstantinou, J. Comput. Phys. 229 (2010) 4481), but the variance
 * grows with every collision. After some steps f1 is therefore expanded anew, as f0 sum_n s_n b_n, with
 * the moments <b_m f1> that it has; the sources likewise. The b_n, without their momentum: heat_functions.h. Longer
 * lags follow by repetition. What an expansion leaves out has decayed by then: the curves show what they do. */
#ifndef GG_HEAT_COPIES_H
#define GG_HEAT_COPIES_H

#include "base/error.h"
#include "common/rng.h"
#include "measure/grain_snapshot.h"
#include "measure/heat_functions.h"

enum { GG_HEAT_FLUXES = 4, GG_HEAT_STEPS = 6 };
/* Fluxes, of which smooth grains have the first: of energy with grains, and through collisions. */
enum { GG_HEAT_TRANSLATION, GG_HEAT_ROTATION, GG_HEAT_CARRIED_TRANSLATION, GG_HEAT_CARRIED_ROTATION };

/* Where a row has, of n functions b: <C.b>/3, <d/dC . b>/3; averages over pairs, for partners at a distance; energy
 * that is carried so; <b_m b_n>; and a lag. Of a lag u: u, e^(zeta u/2), <b_m(u) b_n>, and the integral of <q b_n> up
 * to u, with e^(zeta u/2) and without. */
typedef struct gg_heat_layout { /* steps: lags of a bin, of which a row has the last */
  int n, fluxes, steps, projected, diverged, distant_T, distant_n, carried, overlap, at_lag, channels;
  int time, fading, kept, flux[2], lag; /* in a lag: flux[0] with e^(zeta u/2); its length */
} gg_heat_layout;
enum {
  GG_HEAT_MOST_LAG = 2 + GG_HEAT_ORDERS * GG_HEAT_ORDERS + 2 * GG_HEAT_FLUXES * GG_HEAT_ORDERS,
  GG_HEAT_MOST = 4 * GG_HEAT_ORDERS + 2 + GG_HEAT_ORDERS * GG_HEAT_ORDERS + GG_HEAT_STEPS * GG_HEAT_MOST_LAG
};

gg_heat_layout gg_measure_heat_layout(const gg_model *model);

typedef struct gg_heat_copies {
  const gg_model *model;
  gg_heat_layout at;
  double *grain;                   /* by grain: C, s, weights for every b_n and component */
  int size;                        /* of a grain */
  double K;                        /* 4I/(m d^2); 0 of smooth ones */
  double momentum[GG_HEAT_ORDERS]; /* of b_n: <C_x b_n> */
} gg_heat_copies;

gg_status gg_measure_heat_copies_make(gg_heat_copies *copies, const gg_model *model, gg_error *err);
void gg_measure_heat_copies_clear(gg_heat_copies *copies);

/* Copies of a snapshot's grains: a row with all lags, one behind the other. */
void gg_measure_heat_copies_follow(gg_heat_copies *copies, const gg_snapshot *s, gg_rng *rng, double *row);

#endif
