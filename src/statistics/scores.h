/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether z-scores are chance: their mean, their mean square and the largest, by Student's t. */
#ifndef GG_SCORES_H
#define GG_SCORES_H

#include <stdbool.h>
#include <stddef.h>

/* Independent z-scores of one quantity. */
typedef struct gg_scores {
  size_t n;
  double sum, squares;             /* of z */
  double mean, variance, largest;  /* variance about zero; largest |z| */
  double most_mean, most_variance; /* what chance allows; INFINITY: too few to tell */
  bool fails;
} gg_scores;

void gg_statistics_scores_add(gg_scores *scores, double z);
/* Largest |z| of so many values that chance allows; `chance` is the probability that any of the three tests fails. */
double gg_statistics_scores_most(double chance, size_t values);
/* Test one of `quantities`, which may depend on each other; true if it fails. */
bool gg_statistics_scores_judge(gg_scores *scores, double chance, int quantities, double most);

#endif
