/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/chart.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "plot/axis.h"
#include "plot/chart_styles.h"
#include "plot/plot.h"

/* Layout pixels. */
enum { ONE_WIDE = 600, WIDE = 430, SHARED_WIDE = 550, LEAST_WIDE = 260, TALL = 370, LEAST_TALL = 170 };
enum { TITLE = 34, NO_TITLE = 10, PANEL_TITLE = 22, ROW = 16, ABOVE = 12, BELOW = 66, RIGHT = 22, Y_LABEL = 30 };
static const double letter = 7.4;

enum { MOST_PANELS = 64 };

typedef struct frame {
  double x, wide, top, tall, head; /* of the panel; head: above its frame */
} frame;

typedef struct layout {
  double left, page[2];
  int note_rows;
  gg_chart_styles common, own[MOST_PANELS];
  frame frame[MOST_PANELS];
} layout;

static bool has_text(const char *text)
{
  return text && *text;
}

/* Letters of the longest label of y: panels leave the same room for it, so that their frames are in line. */
static double left_of(const gg_chart *c)
{
  gg_axis x, y;
  int widest = 0;
  for (size_t i = 0; i < c->n; i++) {
    gg_plot_axis_of_panel(&c->panel[i], &x, &y);
    widest = (int)fmax(widest, gg_plot_axis_width(y));
  }
  return Y_LABEL + letter * (widest + 1);
}

static int columns_of(const gg_chart *c)
{
  int columns = c->columns > 0 ? c->columns : c->n == 4 ? 2 : c->n < 3 ? (int)c->n : 3;
  return columns > (int)c->n ? (int)c->n : columns;
}

/* Parts of the page's width for each panel: fewer side by side on a narrow page. */
static void share_width(const gg_chart *c, double width, layout *l)
{
  int columns = columns_of(c);
  double least = 1;
  for (size_t i = 0; i < c->n; i++) least = c->panel[i].share > 0 ? fmin(least, c->panel[i].share) : least;
  bool shared = least < 1;
  l->page[0] = width > 0 ? width : columns * (shared ? SHARED_WIDE : columns == 1 ? ONE_WIDE : WIDE);
  while (columns > 1 && l->page[0] / columns < LEAST_WIDE) columns--;
  for (size_t i = 0; i < c->n; i++)
    l->frame[i].wide = l->page[0] * (!shared || columns == 1           ? 1.0 / columns
                                     : least * l->page[0] < LEAST_WIDE ? 1
                                                                       : c->panel[i].share);
}

static double head_of(const gg_chart_panel *p, const gg_chart_styles *own, double wide)
{
  return ABOVE + (has_text(p->title) ? PANEL_TITLE : 0) +
         (p->own_legend ? ROW * gg_plot_styles_legend_rows(own, wide) : 0);
}

/* Panels of a row are as tall as the narrowest of them asks for. Returns where the row ends. */
static double place_row(const gg_chart *c, layout *l, size_t from, size_t to, double top)
{
  double tall = TALL, head = 0;
  for (size_t i = from; i < to; i++) {
    double wide = l->frame[i].wide - l->left - RIGHT;
    tall = fmin(tall, fmax(0.68 * wide, LEAST_TALL));
    head = fmax(head, head_of(&c->panel[i], &l->own[i], wide));
  }
  for (size_t i = from; i < to; i++) l->frame[i].tall = tall, l->frame[i].head = head, l->frame[i].top = top + head;
  return top + head + tall + BELOW;
}

static double place_rows(const gg_chart *c, layout *l, double top)
{
  size_t from = 0;
  double x = 0;
  for (size_t i = 0; i < c->n; i++) {
    if (x + l->frame[i].wide > 1.001 * l->page[0]) {
      top = place_row(c, l, from, i, top);
      from = i, x = 0;
    }
    l->frame[i].x = x;
    x += l->frame[i].wide;
  }
  return place_row(c, l, from, c->n, top);
}

/* The text below, broken at blanks to fit; returns its rows, and prints them where there is a script. */
static int lay_note(FILE *s, const gg_chart *c, const layout *l)
{
  int rows = 0;
  const size_t most = (size_t)(l->page[0] / letter) - 2;
  for (const char *at = c->note ? c->note : ""; *at; rows++) {
    size_t n = strlen(at);
    if (n > most)
      for (n = most; n > 1 && at[n] != ' ';) n--;
    if (s)
      fprintf(s, "set label %d '%.*s' at screen 0.5,%g center noenhanced tc rgb '#444444'\n", rows + 1, (int)n, at,
              1 - (l->page[1] - 8 - ROW * (l->note_rows - 1 - rows)) / l->page[1]);
    at += n + (at[n] == ' ');
  }
  return rows;
}

static const char *title_of(const gg_chart *c, const layout *l)
{
  return has_text(c->title) && 1.25 * gg_plot_text_width(c->title) < l->page[0] ? c->title : NULL;
}

static layout *lay_out(const gg_chart *c, double width)
{
  layout *l = calloc(1, sizeof *l);
  if (!l) return NULL;
  l->common = gg_plot_styles_of(c, NULL);
  for (size_t i = 0; i < c->n; i++) l->own[i] = c->panel[i].own_legend ? gg_plot_styles_of(c, &c->panel[i]) : l->common;
  l->left = left_of(c);
  share_width(c, width, l);
  int rows = gg_plot_styles_legend_rows(&l->common, l->page[0]);
  l->page[1] = place_rows(c, l, (title_of(c, l) ? TITLE : NO_TITLE) + ROW * rows + (rows ? 6 : 0));
  l->note_rows = lay_note(NULL, c, l);
  l->page[1] += ROW * l->note_rows;
  return l;
}

static gg_panel place_of(const layout *l, const frame *f)
{
  return (gg_panel){(f->x + l->left) / l->page[0], (f->x + f->wide - RIGHT) / l->page[0],
                    1 - (f->top + f->tall) / l->page[1], 1 - f->top / l->page[1]};
}

static double error_of(const double *error, size_t i)
{
  return error && isfinite(error[i]) ? fabs(error[i]) : 0;
}

static bool is_open(const gg_chart_series *c, size_t i)
{
  return c->all_open || (c->open && c->open[i]);
}

/* Has the series some that are open, or some that are not? */
static bool has_such(const gg_chart_series *c, bool open)
{
  for (size_t i = 0; i < c->n; i++)
    if (is_open(c, i) == open) return true;
  return false;
}

/* x, y, ends of the bars of x and of y, and whether it is open; a bar that ends at or below 0 on a logarithmic axis
 * ends at its edge. */
static void print_data(FILE *s, const gg_chart_panel *p, size_t k, double offset, gg_axis x_axis, gg_axis y_axis)
{
  const gg_chart_series *c = &p->series[k];
  fprintf(s, "$series%zu << EOD\n", k);
  for (size_t i = 0; i < c->n; i++) {
    double x = c->x[i] + offset, dx = error_of(c->x_error, i), dy = error_of(c->error, i), low = c->y[i] - dy;
    double left = x - dx;
    if (!gg_plot_axis_takes(p, c, i)) {
      fprintf(s, "\n");
      continue;
    }
    if (y_axis.log && low <= 0) low = fmin(y_axis.from, c->y[i]);
    if (x_axis.log && left <= 0) left = fmin(x_axis.from, c->x[i]);
    fprintf(s, "%.8g %.8g %.8g %.8g %.8g %.8g %d\n", x, c->y[i], left, x + dx, low, c->y[i] + dy, is_open(c, i));
  }
  fprintf(s, "EOD\n");
}

static void print_label(FILE *s, char which, const gg_chart_axis *a)
{
  char unit[96];
  fprintf(s, "set %clabel '", which);
  gg_plot_text_print(s, a->label ? a->label : "");
  if (has_text(a->unit) && strcmp(a->unit, "1") != 0) {
    gg_plot_text_unit(a->unit, unit, sizeof unit);
    fprintf(s, " [");
    gg_plot_text_print(s, unit);
    fprintf(s, "]");
  }
  fprintf(s, "'\n");
}

static void print_series(FILE *s, const gg_chart_styles *styles, const gg_chart_panel *p, size_t k)
{
  const gg_chart_series *c = &p->series[k];
  if (c->style == GG_CHART_BAND && c->error)
    fprintf(s, ", $series%zu using %s fc rgb '%s' fs transparent solid 0.25 noborder notitle", k,
            p->name ? "1:2:($1-0.4):($1+0.4):5:6 with boxxyerror" : "1:5:6 with filledcurves",
            gg_plot_styles_colour(styles, c));
  if (c->style == GG_CHART_BAND && p->name) return;
  if (c->style != GG_CHART_POINTS) {
    fprintf(s, ", $series%zu using 1:2 with lines ", k);
    gg_plot_styles_print(s, styles, c, false);
    fprintf(s, " notitle");
  }
  for (int open = 0; open < 2 && c->style == GG_CHART_POINTS; open++) {
    if (!has_such(c, open)) continue;
    fprintf(s, ", $series%zu using 1:($7==%d?$2:NaN):%s ", k, open,
            c->x_error ? "3:4:5:6 with xyerrorbars" : "5:6 with yerrorbars");
    gg_plot_styles_print(s, styles, c, open);
    fprintf(s, " notitle");
  }
}

/* Bands under lines under points, and the first points over the others; of many points lines go over them. */
static void plot_series(FILE *s, const gg_chart_styles *styles, const gg_chart_panel *p)
{
  static const gg_chart_style orders[][3] = {{GG_CHART_BAND, GG_CHART_LINE, GG_CHART_POINTS},
                                             {GG_CHART_BAND, GG_CHART_POINTS, GG_CHART_LINE}};
  const gg_chart_style *order = orders[p->own_legend];
  for (int pass = 0; pass < 3; pass++)
    for (size_t i = 0; i < p->n; i++) {
      size_t k = order[pass] == GG_CHART_POINTS ? p->n - 1 - i : i;
      const gg_chart_series *c = &p->series[k];
      if (c->style == order[pass] && c->n && gg_plot_styles_shows(styles, c)) print_series(s, styles, p, k);
    }
}

/* Where the k-th series stands beside its category. */
static double offset_of(const gg_chart_panel *p, const gg_chart_styles *styles, size_t k)
{
  int place = 0, n = 0;
  for (size_t i = 0; i < p->n; i++) {
    bool counts = p->series[i].style == GG_CHART_POINTS && gg_plot_styles_shows(styles, &p->series[i]);
    n += counts, place += counts && i < k;
  }
  return p->series[k].style == GG_CHART_POINTS && n ? fmin(0.8 / n, 0.13) * (place - 0.5 * (n - 1)) : 0;
}

static void label_outliers(FILE *s, const gg_chart_series *c, double offset, gg_axis y, const char *colour)
{
  for (size_t i = 0; i < c->n; i++) {
    bool above = c->y[i] > y.to;
    if (!above && !(c->y[i] < y.from)) continue;
    fprintf(s, "set label '%s %.3g' at first %.4f, graph %g rotate by 90 %s tc rgb '%s'\n", above ? "→" : "←", c->y[i],
            c->x[i] + offset, above ? 0.99 : 0.01, above ? "right" : "left", colour);
  }
}

static void print_categories(FILE *s, const gg_chart_panel *p)
{
  fprintf(s, "set xtics (");
  for (size_t i = 0; i < p->n_names; i++) fprintf(s, "%s\"%s\" %zu", i ? ", " : "", p->name[i], i + 1);
  fprintf(s, ") scale 0\nset xrange [0.45:%g]\n", (double)p->n_names + 0.55);
  for (size_t i = 1; i < p->n_names; i++)
    fprintf(s, "set arrow from %g,graph 0 to %g,graph 1 nohead back lc rgb '#eeeeee' lw 0.8\n", (double)i + 0.5,
            (double)i + 0.5);
  fprintf(s, "set arrow from graph 0,first %g to graph 1,first %g nohead back lc rgb '#888888' lw 1\n", p->level,
          p->level);
}

static bool has_legend(const gg_chart_panel *p, const gg_chart_styles *styles, const frame *f)
{
  return p->own_legend && gg_plot_styles_legend_rows(styles, f->wide);
}

/* Above the frame: the title, and under it the legend. */
static void print_head(FILE *s, const gg_chart_panel *p, const gg_chart_styles *styles, const layout *l, const frame *f)
{
  double left = (f->x + l->left) / l->page[0], top = 1 - (f->top - f->head + 10) / l->page[1];
  if (has_text(p->title)) {
    fprintf(s, "set label '");
    gg_plot_text_print(s, p->title);
    fprintf(s, "' at screen %g,%g left\n", left, top);
  }
  if (has_legend(p, styles, f))
    fprintf(s, "set key at screen %g,%g right top horizontal Left reverse samplen 2\n",
            (f->x + f->wide - RIGHT) / l->page[0],
            1 - (f->top - f->head + (has_text(p->title) ? PANEL_TITLE : 4)) / l->page[1]);
}

static void print_axes(FILE *s, const gg_chart_panel *p, gg_axis x, gg_axis y)
{
  print_label(s, 'x', &p->x);
  print_label(s, 'y', &p->y);
  gg_plot_axis_print(s, 'y', y);
  if (p->name)
    print_categories(s, p);
  else
    gg_plot_axis_print(s, 'x', x);
  if (p->shade[1] > p->shade[0])
    fprintf(s, "set object 1 rectangle from %.9g,graph 0 to %.9g,graph 1 behind fc rgb '#eef2f5' fs solid noborder\n",
            p->shade[0], p->shade[1]);
}

static bool is_empty(const gg_chart_panel *p)
{
  size_t n = 0;
  for (size_t k = 0; k < p->n; k++) n += p->series[k].n;
  return p->own_legend && !n;
}

static void draw_panel(FILE *s, const gg_chart_panel *p, const gg_chart_styles *styles, const layout *l, const frame *f)
{
  gg_axis x, y;
  gg_plot_axis_of_panel(p, &x, &y);
  gg_plot_page_place(s, place_of(l, f));
  print_head(s, p, styles, l, f);
  print_axes(s, p, x, y);
  for (size_t k = 0; k < p->n; k++) {
    double offset = p->name ? offset_of(p, styles, k) : 0;
    print_data(s, p, k, offset, x, y);
    if (p->name && gg_plot_styles_shows(styles, &p->series[k]))
      label_outliers(s, &p->series[k], offset, y, gg_plot_styles_colour(styles, &p->series[k]));
  }
  if (is_empty(p)) fprintf(s, "set label 'not enough samples' at graph 0.5,0.5 center textcolor rgb '#666666'\n");
  fprintf(s, "set pointintervalbox 0\nplot NaN notitle");
  plot_series(s, styles, p);
  if (has_legend(p, styles, f)) gg_plot_styles_legend_print(s, styles);
  fprintf(s, "\n");
}

/* A plot over the whole page, whose key has all the width, and the note. */
static void draw_legend(FILE *s, const gg_chart *c, const layout *l, double top)
{
  gg_plot_page_place(s, (gg_panel){0, 1, 0, 1});
  fprintf(s,
          "unset border\nunset xtics\nunset ytics\nunset grid\nunset xlabel\nunset ylabel\nset xrange [0:1]\n"
          "set yrange [0:1]\nset key at screen 0.5,%g center top horizontal Left reverse samplen 2.5\n",
          1 - top / l->page[1]);
  lay_note(s, c, l);
  fprintf(s, "plot NaN notitle");
  gg_plot_styles_legend_print(s, &l->common);
  fprintf(s, "\n");
}

static void print_page(FILE *s, const gg_chart *c, const layout *l, const gg_plot_paper *paper)
{
  const char *title = title_of(c, l);
  gg_plot_page_open(s, title, paper, l->page[0], l->page[1]);
  for (size_t i = 0; i < c->n; i++) draw_panel(s, &c->panel[i], &l->own[i], l, &l->frame[i]);
  if (l->common.method.n + l->common.group.n || l->note_rows) draw_legend(s, c, l, title ? TITLE - 4 : NO_TITLE - 4);
  fprintf(s, "unset multiplot\n");
}

gg_status gg_plot_chart_draw_on(const gg_chart *c, const gg_plot_paper *paper, const char *picture, gg_error *err)
{
  char *script = NULL;
  if (!c->n || c->n > MOST_PANELS) return gg_base_fail(err, GG_BAD_INPUT, "%s: there is nothing to draw", picture);
  layout *l = lay_out(c, paper->width);
  FILE *s = l ? gg_base_memory_stream_open(&script) : NULL;
  if (s) print_page(s, c, l, paper);
  free(l);
  if (!s || !gg_base_memory_stream_close(s, &script)) return gg_base_out_of_memory(err);
  gg_status status = gg_plot_gnuplot_run(script, NULL, picture, err);
  free(script);
  return status;
}

gg_status gg_plot_chart_draw(const gg_chart *c, const char *picture, const char *width, gg_error *err)
{
  gg_plot_paper paper;
  GG_TRY(gg_plot_paper_choose(&paper, picture, NULL, width, err));
  return gg_plot_chart_draw_on(c, &paper, picture, err);
}
