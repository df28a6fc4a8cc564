/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modes that decay most slowly across the gap between walls, over the window of the series of several runs. Times
 * in samples. */
#ifndef GG_SLOW_MODES_H
#define GG_SLOW_MODES_H

#include "measure/wall_modes.h"
#include "statistics/series.h"

typedef struct gg_slow_modes {
  int modes; /* measure/wall_modes.h; 0 without walls */
  double decay[GG_MOST_WALL_MODES];
  double time; /* the longest over which results remember a mode: half its decay time where they follow its square */
  double mean_time; /* mean of these times over all modes; the longest of several estimates is mostly too long */
  /* Walls alike: mean position of the centre of mass, from the middle; the square of that mean over the mean square. */
  double aside, aside_share;
} gg_slow_modes;
/* `channel`: the first of the wall modes in a row. */
gg_status gg_measure_slow_modes(const gg_model *model, const gg_series *const *series, size_t n, size_t channel,
                                gg_slow_modes *w, gg_error *err);

/* Rows of one of the parts into which a window is divided for slow modes. */
size_t gg_measure_slow_rows(const gg_series *series);
/* Error of a quantity's mean from the square of the odd mode of a channel, with that decay time: the scatter of what is
 * proportional to the square, over the window. `response`: blocks of the quantity's response, of that many rows. */
gg_status gg_measure_error_by_square(const gg_series *const *series, size_t n, size_t channel, double decay,
                                     const double *response, double *error, gg_error *err);

#endif
