/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tail of a velocity distribution as a stretched exponential, P(x)/P(0) = exp(-gamma x^alpha); Gaussian: alpha = 2,
 * gamma = 1/2. */
#ifndef GG_STRETCHED_TAIL_H
#define GG_STRETCHED_TAIL_H

#include <stddef.h>

typedef struct gg_stretched_tail {
  double alpha, gamma;
} gg_stretched_tail;

/* counts[i] of |x| in the bin [first + i width, first + (i+1) width), and counts at x = 0 for a bin of that width.
 * Only bins with counts enter. */
typedef struct gg_stretched_tail_data {
  const double *counts;
  size_t n;
  double first, width, at_zero;
} gg_stretched_tail_data;

/* Weighted least squares of ln(-ln P) on ln x, weights from Poisson statistics; NaN if fewer than four bins count. */
gg_stretched_tail gg_measure_stretched_tail_double_log(const gg_stretched_tail_data *data);

/* Maximum likelihood of the counts themselves (Poisson, the law integrated over each bin), which also uses bins that
 * are nearly empty. */
gg_stretched_tail gg_measure_stretched_tail_likelihood(const gg_stretched_tail_data *data);

/* Ranges of |x| for the fits of tails in the thesis (sections 3.1.1 and 4.1.2), and the name of a number of such a
 * fit: "alpha_2_4.5". */
enum { GG_TAIL_RANGES = 2 };
extern const double gg_measure_stretched_tail_range[GG_TAIL_RANGES][2];
void gg_measure_stretched_tail_name(char *name, size_t size, const char *number, const double range[2]);

#endif
