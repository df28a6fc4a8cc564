/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Copies of the grains that carry f1/f0 as weights. In sums over all grains noise would hide the correlations of
 * gases that cool fast. So f1/f0 is followed instead: copies of the grains carry it as weights w, and collide for
 * some time. Two that collide both get w_1 + w_2; a candidate that is rejected, of probability p, subtracts w_2 p/(1
 * - p) from w_1, and w_1 p/(1 - p) from w_2. The average is the linearised collision operator (H.A. Al-Mohssen and
 * N.G. Hadjiconstantinou, J. Comput. Phys. 229 (2010) 4481), but the variance grows with every collision. After some
 * steps f1 is therefore expanded again, as f0 sum_n s_n b_n, with its moments <b_m f1>; the sources likewise. The
 * b_n, without their momentum: heat_functions.h. Longer lags follow by repetition. The part that an expansion omits
 * has decayed by then: the curves show its effect. */
#ifndef GG_HEAT_COPIES_H
#define GG_HEAT_COPIES_H

#include "base/error.h"
#include "common/rng.h"
#include "measure/grain_snapshot.h"
#include "measure/heat_functions.h"

enum { GG_HEAT_FLUXES = 4, GG_HEAT_STEPS = 6 };
/* Fluxes, of which smooth grains have the first: of energy with grains, and through collisions. */
enum { GG_HEAT_TRANSLATION, GG_HEAT_ROTATION, GG_HEAT_CARRIED_TRANSLATION, GG_HEAT_CARRIED_ROTATION };

/* Layout of a row, for n functions b: <C.b>/3, <d/dC . b>/3; averages over pairs, for partners at a distance; energy
 * transferred by collisions; <b_m b_n>; and a lag. For a lag u: u, e^(zeta u/2), <b_m(u) b_n>, and the integral of
 * <q b_n> up to u, with e^(zeta u/2) and without. */
typedef struct gg_heat_layout { /* steps: number of lags of a bin; a row has the last one */
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
  int size;                        /* doubles per grain */
  double K;                        /* 4I/(m d^2); 0 for smooth grains */
  double momentum[GG_HEAT_ORDERS]; /* of b_n: <C_x b_n> */
} gg_heat_copies;

gg_status gg_measure_heat_copies_make(gg_heat_copies *copies, const gg_model *model, gg_error *err);
void gg_measure_heat_copies_clear(gg_heat_copies *copies);

/* Copy a snapshot's grains and follow them: a row with all lags, one after the other. */
void gg_measure_heat_copies_follow(gg_heat_copies *copies, const gg_snapshot *s, gg_rng *rng, double *row);

#endif
