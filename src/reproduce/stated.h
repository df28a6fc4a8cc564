/* The explicit numbers of a paper beside ours. */
#ifndef GG_FIGURE_STATED_H
#define GG_FIGURE_STATED_H

#include "reproduce/points.h"

typedef struct gg_stated_row {
  const gg_stated *of;
  gg_told engine[2];             /* by gg_engine_kind; NaN: none */
  double z[2];                   /* (ours - paper's) over both errors */
  gg_told theory[GG_MOST_NAMES]; /* of->theories */
} gg_stated_row;

/* For each number of the entry a row. */
gg_status gg_reproduce_stated_rows(const gg_figure_entry *entry, const gg_figure_points *points, gg_stated_row *rows,
                                   gg_error *err);

/* Where y vanishes first, where it is least (or largest), and y = A x^B: of n points in the order of x. NaN: nowhere.
 */
gg_told gg_reproduce_find_zero(size_t n, const double *x, const double *y, const double *error);
gg_told gg_reproduce_find_extreme(size_t n, const double *x, const double *y, const double *error, bool least);
gg_told gg_reproduce_find_power(size_t n, const double *x, const double *y, const double *error, bool exponent);

#endif
