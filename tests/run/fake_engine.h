/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An engine whose answer is known: temperature and spin relax exponentially, with noise of known size, towards planted
 * values. It takes the place of the real ones in tests of the run layer (linked before the library). */
#ifndef FAKE_ENGINE_H
#define FAKE_ENGINE_H

#include "common/engine.h"
#include "scene/scene.h"

typedef struct fake_plan {
  double T, theta;   /* steady values */
  double start;      /* relative departure of theta at the start */
  double relaxation; /* of theta, collisions per grain */
  double noise;      /* relative, of T and theta: autoregressive over 10 collisions per grain */
  double trend;      /* relative growth of T per collision per grain */
  double treated;    /* share of collisions under the contact-time rule */
  double unpaid;     /* share of the work of shear that collisions do not lose */
  double seconds;    /* wall time that an advance takes */
  bool counted;      /* collisions are counts, Poisson's, that the rate is the mean of */
} fake_plan;

extern fake_plan fake;

/* A scene of 512 grains, and a criteria for it: T = 2, theta = 0.5, relaxed after 10 collisions a grain, noise of 2 %.
 */
gg_scene planted_scene(double beta);

#endif
