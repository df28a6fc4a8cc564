/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A page of a picture, as a script for gnuplot. Panels, texts and legends have fixed places, in layout pixels from the
 * left upper corner: terminals of gnuplot differ in how wide they think a text is, so nothing is left to their guess.
 */
#ifndef GG_PLOT_PAGE_H
#define GG_PLOT_PAGE_H

#include <stdio.h>

#include "plot/plot.h"

enum { GG_ROW = 17 }; /* height of a row of text */
#define GG_LETTER 7.5 /* room for a letter of 12 pixels */

typedef struct gg_page {
  const gg_plot_paper *paper;
  double size[2];
  FILE *script, *over; /* over: SVG that is put over the page of gnuplot, a format SVG only */
  char *text, *over_text;
} gg_page;

typedef struct gg_box {
  double left, top, wide, tall;
} gg_box;

/* How a series is drawn: its symbols or lines, and its sample in the legend. */
typedef struct gg_look {
  enum { GG_CHART_POINTS, GG_CHART_LINE, GG_CHART_BAND } style;
  unsigned colour;  /* 0xrrggbb */
  int symbol, open; /* gnuplot's point types of steady runs and of others */
  double size;
  const char *dash;
  bool shaded; /* a band with errors */
  bool hollow; /* all symbols are open */
} gg_look;

typedef struct gg_legend_entry {
  char name[1280]; /* enhanced text */
  gg_look look;
} gg_legend_entry;

/* False: out of memory. */
bool gg_plot_page_open(gg_page *page, const gg_plot_paper *paper, double width, double height);
/* Draw the page to a picture, whole or not at all, and free it. `whole`: false if memory was short meanwhile. */
gg_status gg_plot_page_finish(gg_page *page, bool whole, const char *picture, gg_error *err);
/* Size of a layout pixel in units of the terminal. */
double gg_plot_page_scale(const gg_plot_paper *paper);

/* Begin a panel with this frame: four sides, or axes on the left and below with a grid. Texts and legends that follow
 * are drawn with it. */
void gg_plot_page_panel(const gg_page *page, gg_box frame, bool four_sides);

/* A text in one row, centred vertically at y. `style`: what gnuplot takes after the place of a label. */
void gg_plot_page_text(const gg_page *page, double x, double y, const char *style, const char *text);
/* The same in small letters. */
void gg_plot_page_small_text(const gg_page *page, double x, double y, const char *style, const char *text);
/* A text in up to six rows, broken at blanks and then cut, below `top`. Returns the height of the rows; with page
 * NULL nothing is drawn. */
double gg_plot_page_rows(const gg_page *page, double x, double top, double wide, const char *style, const char *text);
/* A legend in a box of that width: columns of equal width, the names in rows. Returns its height; page NULL: as above.
 */
double gg_plot_page_legend(const gg_page *page, double left, double top, double wide, const gg_legend_entry *entry,
                           int n);
/* "pt 7 ps 1 lw 1.2 lc rgb ..." of the symbols, or "lw 1.5 dt ..." of the line. */
void gg_plot_page_look(const gg_page *page, const gg_look *look, bool open);

#endif
