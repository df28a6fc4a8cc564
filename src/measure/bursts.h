/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bursts of observed collisions. Engines report collisions always, or in bursts: dsmc is some thirty times slower
 * meanwhile, so that bursts of one sample in a hundred add a third to the time. Errors need sixteen bursts however
 * short the run is. So bursts are close together at first, then further and further apart. Their samples depend on the
 * window alone: a resumed run has the same bursts. */
#ifndef GG_BURSTS_H
#define GG_BURSTS_H

#include "common/model.h"

/* Numbers of samples: length of a burst; first: period of the first bursts; apart: period from sample `regular_from` of
 * the window on. */
typedef struct gg_bursts {
  uint64_t length, first, apart, regular_from;
} gg_bursts;
gg_bursts gg_measure_bursts_of(const gg_model *model);

/* Samples since the last burst began. */
uint64_t gg_measure_since_burst(const gg_bursts *bursts, uint64_t sample);

#endif
