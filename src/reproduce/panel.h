/* A panel with its numbers: what is drawn, and what goes into tables and files. */
#ifndef GG_FIGURE_PANEL_H
#define GG_FIGURE_PANEL_H

#include "plot/chart.h"
#include "reproduce/points.h"

/* One line of symbols, or one curve. */
typedef struct gg_drawn {
  char method[64], group[128]; /* who says it: an engine, a theory, a law; of which line, "" of none */
  gg_chart_style style;
  size_t n, room;
  double *x, *y, *error, *x_error; /* NaN: none is known */
} gg_drawn;

typedef struct gg_drawn_panel {
  const gg_figure_panel *of;
  char x_label[128], y_label[128], y_unit[64], x_unit[64];
  size_t n;
  gg_drawn *drawn;
} gg_drawn_panel;

/* Everything that the panel shows; owned by `panel`, also after a failure. */
gg_status gg_reproduce_panel_make(gg_drawn_panel *panel, const gg_figure_panel *of, const gg_figure_points *points,
                                  gg_error *err);
void gg_reproduce_panel_clear(gg_drawn_panel *panel);

/* drawn.c: for the parts of a panel (panel_curves.c, panel_theories.c). NULL, GG_FAILED: out of memory. */
gg_drawn *gg_reproduce_panel_add(gg_drawn_panel *panel, const char *method, const char *group, gg_chart_style style);
gg_status gg_reproduce_drawn_put(gg_drawn *drawn, double x, double x_error, double y, double error, gg_error *err);
/* In the order of x. */
void gg_reproduce_drawn_sort(gg_drawn *drawn);
/* Is the point in the panel? Of which line is it, with the name shown where the panel has several. */
bool gg_reproduce_panel_takes(const gg_figure_panel *of, const gg_figure_point *point);
bool gg_reproduce_panel_engine(const gg_figure_panel *of, const gg_figure_point *point, int engine);
void gg_reproduce_panel_group(const gg_figure_panel *of, const gg_figure_point *point, const char *name, char *text,
                              size_t size);
double gg_reproduce_panel_x(const gg_figure_panel *of, double raw);

/* panel_curves.c: the Kth curve of the source in few words: as its file calls it, where that tells it from the others;
 * else its name. */
void gg_reproduce_panel_curve_text(const gg_source *source, int k, const gg_figure_point *point, int engine, char *text,
                                   size_t size);
gg_status gg_reproduce_panel_curves(gg_drawn_panel *panel, const gg_figure_points *points, gg_error *err);
gg_status gg_reproduce_panel_series(gg_drawn_panel *panel, const gg_figure_points *points, gg_error *err);
gg_status gg_reproduce_panel_frames(gg_drawn_panel *panel, const gg_figure_points *points, gg_error *err);
gg_status gg_reproduce_panel_theories(gg_drawn_panel *panel, const gg_figure_points *points, gg_error *err);
gg_status gg_reproduce_panel_guides(gg_drawn_panel *panel, gg_error *err);

#endif
