/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard errors of functions of blocks of samples: leave out one block at a time (the jackknife: Quenouille 1956,
 * Tukey 1958). Blocks that are not much longer than a correlation time are correlated with their neighbours in time.
 * For a correlation r of neighbouring blocks the variance is larger by (1 + r)/(1 - r), as for a chain in which the
 * correlation falls by the factor r from block to block. Errors have the factor for few blocks of all errors
 * (gg_statistics_student). */
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
/* Begin another run: the next block is no neighbour of the previous one. */
void gg_statistics_jackknife_cut(gg_jackknife *j);
/* The row for the changes of `width` numbers when the next block is left out; then count the block. */
double *gg_statistics_jackknife_next(gg_jackknife *j);
void gg_statistics_jackknife_add(gg_jackknife *j);

/* Errors of n numbers from `from` on, points of one curve. Correlations are averaged over nine neighbours, because
 * each alone is uncertain by 1/sqrt(blocks).
 * `memory` (0: unknown): the decay time, in blocks, of a slow mode on which the numbers may depend, beside fast
 * noise. Neighbouring blocks are then less correlated than in a chain, but for longer: the correlation gives the
 * fraction of the mode, its decay time the rest.
 * `beside` (NaN: none): the mean correlation of the curve from which a number is derived; it counts as two more. NaN
 * with fewer than two blocks. Returns the mean correlation. */
double gg_statistics_jackknife_errors(const gg_jackknife *j, size_t from, size_t n, double memory, double beside,
                                      double *error);

#endif
