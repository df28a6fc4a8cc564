/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the series of a chart look: from the names of their methods and groups, the same in all panels of one legend. */
#ifndef GG_CHART_STYLES_H
#define GG_CHART_STYLES_H

#include <stdio.h>

#include "plot/chart.h"

enum { GG_STYLES_MOST = 32 };

typedef struct gg_chart_names {
  int n;
  const gg_chart_series *first[GG_STYLES_MOST]; /* with that name */
  int host[GG_STYLES_MOST];                     /* under which other method it is drawn, since they coincide; -1 */
  bool points[GG_STYLES_MOST];                  /* some with that name are points */
  bool bands;                                   /* some are measured lines, which are drawn through */
} gg_chart_names;

/* In order of their first appearance. */
typedef struct gg_chart_styles {
  gg_chart_names method, group;
  bool own; /* of one panel */
} gg_chart_styles;

/* Of all panels under the common legend, or of one that has its own. */
gg_chart_styles gg_plot_styles_of(const gg_chart *chart, const gg_chart_panel *own);

/* False: another theory says the same. */
bool gg_plot_styles_shows(const gg_chart_styles *styles, const gg_chart_series *series);

/* The style of a series: "pt 7 ps 0.8 ..." or "dt 1 lw ..."; of its open symbols or the others. */
void gg_plot_styles_print(FILE *script, const gg_chart_styles *styles, const gg_chart_series *series, bool open);
const char *gg_plot_styles_colour(const gg_chart_styles *styles, const gg_chart_series *series);

/* The legend: groups by colour and symbol, methods by filling or dash. gnuplot sets it in columns; how many rows there
 * are in a width of so many layout pixels, and its entries for `plot`. */
int gg_plot_styles_legend_rows(const gg_chart_styles *styles, double width);
void gg_plot_styles_legend_print(FILE *script, const gg_chart_styles *styles);

/* The width of text in layout pixels: of what gnuplot makes of it. */
double gg_plot_text_width(const char *text);

#endif
