/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chart with the memory for its panels, numbers and texts: for pages made of result files. */
#ifndef GG_PLOT_SHEET_H
#define GG_PLOT_SHEET_H

#include "common/quantity.h"
#include "plot/chart.h"
#include "plot/plot.h"

enum { GG_SHEET_PANELS = 24, GG_SHEET_SERIES = 32, GG_SHEET_NAMES = GG_N_QUANTITIES + 8 };

typedef struct gg_plot_sheet {
  gg_chart chart;
  gg_chart_panel panel[GG_SHEET_PANELS];
  gg_chart_series series[GG_SHEET_PANELS][GG_SHEET_SERIES];
  const char *name[2][GG_SHEET_NAMES]; /* of categories */
  char title[240], note[80], text[2 * GG_SHEET_NAMES + 2 * GG_SHEET_PANELS][112];
  int n_texts;
  double width; /* of the paper; 0: free */
  bool lacks;   /* memory */
} gg_plot_sheet;

/* A new one under the title of the scene; NULL: out of memory. */
gg_plot_sheet *gg_plot_sheet_new(const gg_stored_result *stored, const gg_plot_paper *paper);
/* Has a stored engine no steady mean? Its symbols are open then, and the text below says so. */
bool gg_plot_is_unsteady(const gg_stored_engine *engine);
/* Draw and free it. */
gg_status gg_plot_sheet_finish(gg_plot_sheet *sheet, const gg_plot_paper *paper, const char *picture, gg_error *err);

/* The next panel; NULL: there are too many. */
gg_chart_panel *gg_plot_sheet_add_panel(gg_plot_sheet *sheet);
/* A series of the last panel with room for so many points, like another; NULL: none can be had. */
gg_chart_series *gg_plot_sheet_add_series(gg_plot_sheet *sheet, gg_chart_series like, size_t room);
/* Take the last one back. */
void gg_plot_sheet_drop_series(gg_plot_sheet *sheet);
void gg_plot_sheet_add_point(gg_chart_series *series, double x, double y, double error);
const char *gg_plot_sheet_add_text(gg_plot_sheet *sheet, const char *format, ...) GG_PRINTF(2, 3);

/* Panels of an engine's relaxation: its temperatures, and its stresses if it has stored some. */
void gg_plot_sheet_add_relaxation(gg_plot_sheet *sheet, const gg_stored_engine *engine, bool stresses, double share);
bool gg_plot_has_stresses(const gg_stored_engine *engine); /* not of gases that cool */
/* md, dsmc and the theories: ratios to md, and the numbers that have no scale to be divided by (N1, N2 ...). */
void gg_plot_sheet_add_comparison(gg_plot_sheet *sheet, const gg_stored_result *stored);
/* One group of curves (one observable), those of the other engine (NULL: none) over them, the theories' as lines. */
void gg_plot_sheet_add_curves(gg_plot_sheet *sheet, const gg_stored_engine *engine, const gg_stored_engine *other,
                              const json_t *theories, const char *group);

#endif
