/* How the series of a chart look: from the names of their methods and groups, the same in all of its panels. */
#ifndef GG_CHART_LOOKS_H
#define GG_CHART_LOOKS_H

#include <stdio.h>

#include "plot/chart.h"

enum { GG_LOOKS_MOST = 32 };

typedef struct gg_chart_names {
  int n;
  const gg_chart_series *first[GG_LOOKS_MOST]; /* with that name */
  bool points[GG_LOOKS_MOST];                  /* some with that name are points */
  bool bands;                                  /* some are measured lines, which are drawn through */
} gg_chart_names;

/* In order of their first appearance. */
typedef struct gg_chart_looks {
  gg_chart_names method, group;
} gg_chart_looks;

void gg_plot_chart_looks_of(const gg_chart *chart, gg_chart_looks *looks);

/* The style of a series: "pt 7 ps 0.8 ..." or "dt 1 lw ...". */
void gg_plot_chart_print_look(FILE *script, const gg_chart_looks *looks, const gg_chart_series *series);
const char *gg_plot_chart_colour(const gg_chart_looks *looks, const gg_chart_series *series);

/* The legend: groups by colour and symbol, methods by filling or dash, in columns. Pixels. */
typedef struct gg_chart_legend {
  int groups, entries, columns, column_width, height;
} gg_chart_legend;
gg_chart_legend gg_plot_chart_legend_in(const gg_chart_looks *looks, int width);
/* `top` pixels below the upper edge of a page of this size; after its panels. */
void gg_plot_chart_print_legend(FILE *script, const gg_chart_looks *looks, const gg_chart_legend *legend, int top,
                                const int page[2]);

#endif
