/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard errors of anything that follows from blocks of samples: leave out one block at a time (the jackknife:
 * Quenouille 1956, Tukey 1958). Blocks that are not much longer than a correlation time depend on their neighbours in
 * time; from the correlation r of neighbouring blocks the variance is taken larger by (1 + r)/(1 - r), as it is for a
 * chain in which correlation fades by the factor r from block to block. Errors have the factor of few blocks that every
 * error has (gg_statistics_student). */
#ifndef GG_JACKKNIFE_H
#define GG_JACKKNIFE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

typedef struct gg_jackknife {
  size_t width, blocks, pairs;
  bool first; /* the next block has no neighbour before it */
  double *now, *before;
  double *sum, *squares, *products, *ends; /* of d, d^2, d d', d + d' over neighbours d, d' */
} gg_jackknife;

gg_status gg_statistics_jackknife_init(gg_jackknife *j, size_t width, gg_error *err);
void gg_statistics_jackknife_clear(gg_jackknife *j);
/* Another run begins: what comes is no neighbour of what came. */
void gg_statistics_jackknife_cut(gg_jackknife *j);
/* Where to put what leaving out the next block changes in each of `width` numbers; then count it. */
double *gg_statistics_jackknife_next(gg_jackknife *j);
void gg_statistics_jackknife_add(gg_jackknife *j);

/* Errors of n numbers from `from` on, points of one curve: correlations are averaged over nine neighbours, for each by
 * itself is uncertain by 1/sqrt(blocks). `memory` (0: not known): the decay time, in blocks, of a slow mode that the
 * numbers may depend on, beside fast noise. Neighbouring blocks are then less correlated than in a chain, but for
 * longer: the correlation tells the share of the mode, its decay the rest. `beside`
 * (NaN: there is none): the mean correlation of the curve that a number is derived from, which counts as two more. NaN
 * with fewer than two blocks. Returns the mean correlation. */
double gg_statistics_jackknife_errors(const gg_jackknife *j, size_t from, size_t n, double memory, double beside,
                                      double *error);

#endif
