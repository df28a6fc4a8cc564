/* A straight line through points of their own errors. */
#ifndef GG_FIGURE_STRAIGHT_H
#define GG_FIGURE_STRAIGHT_H

#include <stdbool.h>
#include <stddef.h>

/* Least squares of y on x with weights 1/error^2: y = a + b x; n points with finite numbers. False: fewer than two. */
typedef struct gg_straight {
  double a, b, a_error, b_error;
} gg_straight;
bool gg_reproduce_straight_fit(size_t n, const double *x, const double *y, const double *error, gg_straight *line);

#endif
