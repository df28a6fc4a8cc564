/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts: series of numbers over an abscissa, measured ones with error bars, theories as lines, in one style for all
 * that draws such pictures. Told apart by symbols, filling and dashes, also in grey. */
#ifndef GG_CHART_H
#define GG_CHART_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

typedef enum gg_chart_style {
  GG_CHART_POINTS, /* measured: symbols with error bars */
  GG_CHART_LINE,   /* theory */
  GG_CHART_BAND    /* measured at many points: a line in a band of one standard error */
} gg_chart_style;

/* Everything a chart points to stays the caller's. A point whose x or y is NaN is left out, and breaks a line. */
typedef struct gg_chart_series {
  const char *method; /* who says it: "md", "dsmc", "lun1991". One filling or dash for each; plain text */
  const char *group;  /* of which line: "β = 0.5". One symbol and colour for each; NULL: of none (enhanced text) */
  gg_chart_style style;
  size_t n;
  const double *x, *y;
  const double *error, *x_error; /* standard errors; NULL, and NaN: none is known */
  const bool *open;              /* symbols that are drawn open: of runs that are not steady; NULL: none */
  bool all_open;                 /* all of them are */
} gg_chart_series;

/* Labels are gnuplot's enhanced text, P_{xy} or n σ^3; units as results have them ("d^2 gamma^2"), NULL or "1": none.
 */
typedef struct gg_chart_axis {
  const char *label, *unit;
  bool log;
  double from, to; /* equal: by the data */
} gg_chart_axis;

typedef struct gg_chart_panel {
  const char *title; /* over it (enhanced text); may be NULL */
  gg_chart_axis x, y;
  size_t n;
  const gg_chart_series *series;
  double share;            /* of the page's width; 0: one column */
  bool own_legend;         /* its names and looks are its own; lines of theories do not widen its axes */
  double shade[2];         /* of x; equal: none */
  double level;            /* of a line across it, where there are categories */
  const char *const *name; /* categories at x = 1, 2, ...: their labels; methods stand beside each other, what lies
                            * outside of y is named at the edge. NULL: numbers */
  size_t n_names;
} gg_chart_panel;

/* Methods and groups look the same in all panels, and one legend over them names each once. */
typedef struct gg_chart {
  const char *title, *note; /* over all, and below; plain text; may be NULL */
  size_t n;
  const gg_chart_panel *panel;
  int columns; /* of panels; 0: chosen by their number */
} gg_chart;

/* Draw to a picture, whole or not at all. width: "86mm", or NULL. Theories that coincide to the eye are drawn once.
 * GG_BAD_INPUT if the name is no picture's, GG_FAILED without gnuplot, GG_BAD_FILE if it cannot be written. */
gg_status gg_plot_chart_draw(const gg_chart *chart, const char *picture, const char *width, gg_error *err);
struct gg_plot_paper;
gg_status gg_plot_chart_draw_on(const gg_chart *chart, const struct gg_plot_paper *paper, const char *picture,
                                gg_error *err);

/* What a scene's key is called on axes and in legends, as enhanced text: "collision.beta" is "β"; a key without a
 * symbol is named as it is. `unit` (may be NULL): that of its values, "1" if none. */
void gg_plot_chart_key(const char *key, char *text, size_t size, const char **unit);

/* A method as people write it: "lun1991" is "Lun 1991", "md" stays. Plain text. */
void gg_plot_method_name(const char *method, char *text, size_t size);

#endif
