/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test over all points of a grid whether the z-scores of dsmc against Enskog's noise-free solution are chance. */
#ifndef GG_AGREEMENT_H
#define GG_AGREEMENT_H

#include "statistics/scores.h"
#include "sweep/grid_view.h"

enum { GG_AGREEMENT_QUANTITIES = 32 };

/* One main quantity over all points. */
typedef struct gg_agreement_row {
  const char *quantity;
  gg_scores scores; /* one a point */
} gg_agreement_row;

typedef struct gg_agreement {
  size_t n_points, n_values; /* compared */
  size_t unsteady;           /* points whose dsmc is not steady: left out */
  size_t unanswered;         /* points without a noise-free solution */
  int n;
  gg_agreement_row row[GG_AGREEMENT_QUANTITIES];
  double most; /* largest |z| that chance allows */
  bool fails;
} gg_agreement;

/* Probability that a test fails on a grid without errors. */
#define GG_AGREEMENT_CHANCE 0.001

void gg_sweep_agreement_make(gg_agreement *agreement, const gg_grid_view *view);
/* True for the rows that are tested: dsmc, steady, a main quantity, with a z against the solution. */
bool gg_sweep_agreement_counts(const gg_point_row *row);
/* True for the quantities in the picture of a comparison. */
bool gg_sweep_is_main_quantity(const char *quantity);

#endif
