/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts: series of numbers over an abscissa, measured ones with error bars, theories as lines, in one style for all
 * pictures. Symbols, filling and dashes tell series apart in grey, too. */
#ifndef GG_CHART_H
#define GG_CHART_H

#include "base/text.h"
#include "plot/page.h"

enum { GG_CHART_PANELS = 24, GG_CHART_SERIES = 64, GG_CHART_CATEGORIES = 400 };

/* NaN: no standard error is known. */
typedef struct gg_chart_point {
  double x, y, error, x_error;
  bool open; /* of a run that is not steady */
} gg_chart_point;

typedef struct gg_chart_series {
  const char *method; /* "md", "dsmc", "lun1991": one filling or dash for each; plain text */
  const char *group;  /* "β = 0.5": one symbol and colour for each; NULL: none (enhanced text) */
  gg_look look;       /* the caller sets its style */
  bool hidden;        /* coincides with the line of another theory, which is drawn */
  size_t n, room;
  gg_chart_point *point;
} gg_chart_series;

/* Labels are enhanced text, P_{xy} or n σ^3; units as results have them ("d^2 gamma^2"), NULL or "1": none. */
typedef struct gg_chart_axis {
  const char *label, *unit;
  bool log;
  double from, to; /* equal: chosen by the data */
} gg_chart_axis;

typedef struct gg_chart_panel {
  const char *title; /* enhanced text; may be NULL */
  gg_chart_axis x, y;
  double share;    /* of the page's width; 0: one column */
  bool own_legend; /* the panel has its own legend and looks; lines of theories do not widen its axes */
  double shade[2]; /* interval of x with a grey ground; equal: none */
  double level;    /* a line across categories */
  /* Categories at x = 1, 2, ...: a word (plain) and a symbol (enhanced). The methods of a category are drawn beside
   * each other; a value outside of y is written at the edge. */
  size_t n_categories;
  const char *word[GG_CHART_CATEGORIES], *symbol[GG_CHART_CATEGORIES];
  size_t n;
  gg_chart_series *series[GG_CHART_SERIES];
} gg_chart_panel;

/* A method or group has one look in all panels with the common legend. */
typedef struct gg_chart {
  const char *title, *note; /* above and below all panels; plain text; may be NULL */
  int columns;              /* of panels; 0: chosen by their number */
  size_t n;
  gg_chart_panel *panel[GG_CHART_PANELS];
  gg_string_list texts;
  bool lacks; /* memory */
} gg_chart;

/* NULL: out of memory. */
gg_chart *gg_plot_chart_new(void);
/* The next panel; NULL: there are too many. */
gg_chart_panel *gg_plot_chart_panel(gg_chart *chart);
/* A series of a panel, or of the last panel; NULL: there are too many. */
gg_chart_series *gg_plot_panel_series(gg_chart *chart, gg_chart_panel *panel, const char *method, const char *group,
                                      int style);
gg_chart_series *gg_plot_chart_series(gg_chart *chart, const char *method, const char *group, int style);
/* Add a point to a series (NULL: nothing). A point whose x or y is NaN is not drawn, and breaks a line. */
void gg_plot_chart_point(gg_chart *chart, gg_chart_series *series, gg_chart_point point);
/* A text that lives as long as the chart. */
#define gg_plot_chart_text(chart, ...)                                                                                 \
  (gg_base_string_list_add(&(chart)->texts, __VA_ARGS__), gg_plot_chart_last_text(chart))
const char *gg_plot_chart_last_text(gg_chart *chart);

/* Draw to a picture, whole or not at all, and free the chart. Theories that coincide to the eye are drawn once.
 * GG_FAILED without gnuplot, GG_BAD_FILE if the picture cannot be written. */
gg_status gg_plot_chart_finish(gg_chart *chart, const gg_plot_paper *paper, const char *picture, gg_error *err);
void gg_plot_chart_free(gg_chart *chart);

/* The axes of a panel: as given, or around its points with some room, and from 0 if that is near. */
void gg_plot_axes_choose(gg_chart_panel *panel);
/* Range and tics of axis 'x' or 'y'. */
void gg_plot_axis_print(FILE *script, char which, const gg_chart_axis *axis);
/* Position of a value on an axis, 0 and 1 at its ends. */
double gg_plot_axis_place(const gg_chart_axis *axis, double value);
/* False if a point has no place on the axes. */
bool gg_plot_point_shows(const gg_chart_panel *panel, const gg_chart_point *point);

/* Choose the looks of all series under one legend, that of the panel `own` or (NULL) the common one, hide lines that
 * coincide with others, and list the legend in at most `most` entries. Returns their number. */
int gg_plot_looks_choose(const gg_chart *chart, const gg_chart_panel *own, gg_legend_entry *entry, int most);

/* A scene key on axes and in legends, as enhanced text: "collision.beta" is "β"; a key without a symbol is named as it
 * is. `unit` (may be NULL): of its values, "1" if none. */
void gg_plot_chart_key(const char *key, char *text, size_t size, const char **unit);

/* A method as people write it: "lun1991" is "Lun 1991", "md" stays. Plain text. */
void gg_plot_method_name(const char *method, char *text, size_t size);

#endif
