/* The tail of a velocity distribution, P/P(0) = exp(-gamma x^alpha), fitted over a range of one's own. */
#ifndef GG_FIGURE_TAIL_H
#define GG_FIGURE_TAIL_H

#include "reproduce/points.h"

/* alpha, or gamma, by weighted least squares of ln(-ln P) on ln|x|. Errors take the points as independent. */
gg_told gg_tail_fit(const json_t *curve, const double range[2], bool alpha);

/* Least squares of y on x with weights 1/error^2: y = a + b x; n points with finite numbers. False: fewer than two. */
typedef struct gg_straight {
  double a, b, a_error, b_error;
} gg_straight;
bool gg_straight_fit(size_t n, const double *x, const double *y, const double *error, gg_straight *line);

#endif
