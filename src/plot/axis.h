/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes of charts: their ends; gnuplot places the tics. */
#ifndef GG_PLOT_AXIS_H
#define GG_PLOT_AXIS_H

#include <stdbool.h>
#include <stdio.h>

#include "plot/chart.h"

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

/* Those of a panel: as given, or around what is drawn. Has the point a place there? */
void gg_plot_axis_of_panel(const gg_chart_panel *panel, gg_axis *x, gg_axis *y);
bool gg_plot_axis_takes(const gg_chart_panel *panel, const gg_chart_series *series, size_t i);

/* Where x stands between its ends, 0 and 1. */
double gg_plot_axis_share(gg_axis axis, double x);

/* Range and tics of axis 'x' or 'y', and about how many characters its longest label has. */
void gg_plot_axis_print(FILE *script, char which, gg_axis axis);
int gg_plot_axis_width(gg_axis axis);

#endif
