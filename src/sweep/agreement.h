/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Do the z-scores of dsmc against Enskog's noise-free solution look like chance? Over all points of a grid. */
#ifndef GG_AGREEMENT_H
#define GG_AGREEMENT_H

#include "sweep/grid_view.h"

enum { GG_AGREEMENT_QUANTITIES = 32 };

/* One main quantity over all points. */
typedef struct gg_agreement_row {
  const char *quantity;
  size_t n;                        /* points */
  double sum, squares;             /* of z */
  double mean, variance, largest;  /* variance about zero; largest |z| */
  double most_mean, most_variance; /* what chance allows; INFINITY: too few points to tell */
  bool fails;
} gg_agreement_row;

typedef struct gg_agreement {
  size_t n_points, n_values; /* that were compared */
  size_t unsteady;           /* points whose dsmc is not steady: left out */
  size_t unanswered;         /* points without a noise-free solution */
  int n;
  gg_agreement_row row[GG_AGREEMENT_QUANTITIES];
  double most; /* |z| that chance allows of any value */
  bool fails;
} gg_agreement;

/* The chance that anything of a grid in perfect order fails. */
#define GG_AGREEMENT_CHANCE 0.001

void gg_sweep_agreement_make(gg_agreement *agreement, const gg_grid_view *view);
/* Is it a row that takes part: of dsmc, steady, of a main quantity, with a z against the solution? */
bool gg_sweep_agreement_counts(const gg_point_row *row);
/* Of the quantities that a picture of a comparison has. */
bool gg_sweep_is_main_quantity(const char *quantity);

#endif
