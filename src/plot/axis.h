/* Axes of charts: their ends, and tics with short labels at round numbers. */
#ifndef GG_PLOT_AXIS_H
#define GG_PLOT_AXIS_H

#include <stdbool.h>
#include <stdio.h>

typedef struct gg_axis {
  bool log;
  double from, to;
} gg_axis;

/* The numbers that an axis has to show; on a logarithmic one those above 0 alone. Start with GG_NO_EXTENT. */
typedef struct gg_extent {
  double least, most;
} gg_extent;
#define GG_NO_EXTENT ((gg_extent){INFINITY, -INFINITY})
void gg_plot_extent_add(gg_extent *extent, double value, bool log);

/* An axis with some room around them, and from 0 where that is near; of nothing: from 0 to 1. */
gg_axis gg_plot_axis_around(gg_extent extent, bool log);

/* Where x stands between its ends, 0 and 1. */
double gg_plot_axis_share(gg_axis axis, double x);

/* Range and tics of axis 'x' or 'y', and how many characters its longest label has. */
void gg_plot_axis_print(FILE *script, char which, gg_axis axis);
int gg_plot_axis_width(gg_axis axis);

#endif
