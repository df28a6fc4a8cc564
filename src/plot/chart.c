#include "plot/chart.h"

#include <math.h>
#include <stdlib.h>

#include "base/c_locale.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "plot/axis.h"
#include "plot/chart_styles.h"
#include "plot/plot.h"

/* Pixels. */
enum { ONE_WIDE = 520, ONE_TALL = 370, WIDE = 340, TALL = 250 };
enum { TITLE = 34, NO_TITLE = 10, PANEL_TITLE = 24, ABOVE = 12, BELOW = 62, RIGHT = 22, Y_LABEL = 42 };
static const double letter = 7.6; /* the mean width of one */

typedef struct layout {
  int columns, rows, wide, tall, head, page[2];
  gg_chart_legend legend;
  double left, above; /* of each panel: for tics and label, for its title */
} layout;

static double error_of(const double *error, size_t i)
{
  return error && isfinite(error[i]) ? fabs(error[i]) : 0;
}

static bool is_there(const gg_chart_panel *p, const gg_chart_series *s, size_t i)
{
  return isfinite(s->x[i]) && isfinite(s->y[i]) && !(p->x.log && s->x[i] <= 0) && !(p->y.log && s->y[i] <= 0);
}

static bool is_inside(const gg_chart_axis *a, double x)
{
  return a->from == a->to || (x >= a->from && x <= a->to);
}

/* What is drawn, with its error bars; on a logarithmic axis only bars that end above 0. */
static void find_extents(const gg_chart_panel *p, gg_extent *x, gg_extent *y)
{
  *x = *y = GG_NO_EXTENT;
  for (size_t k = 0; k < p->n; k++) {
    const gg_chart_series *s = &p->series[k];
    for (size_t i = 0; i < s->n; i++) {
      if (!is_there(p, s, i) || !is_inside(&p->x, s->x[i])) continue;
      double dx = error_of(s->x_error, i), dy = error_of(s->error, i);
      gg_plot_extent_add(x, s->x[i] - dx, p->x.log), gg_plot_extent_add(x, s->x[i] + dx, p->x.log);
      gg_plot_extent_add(y, s->y[i], p->y.log), gg_plot_extent_add(y, s->y[i] + dy, p->y.log);
      if (!p->y.log || s->y[i] > 1.5 * dy) gg_plot_extent_add(y, s->y[i] - dy, p->y.log);
    }
  }
}

static gg_axis axis_of(const gg_chart_axis *a, gg_extent extent)
{
  bool given = a->from != a->to && !(a->log && a->from <= 0);
  return given ? (gg_axis){a->log, a->from, a->to} : gg_plot_axis_around(extent, a->log);
}

static void axes_of(const gg_chart_panel *p, gg_axis *x, gg_axis *y)
{
  gg_extent of_x, of_y;
  find_extents(p, &of_x, &of_y);
  *x = axis_of(&p->x, of_x), *y = axis_of(&p->y, of_y);
}

static int title_of(const gg_chart *c)
{
  return c->title && *c->title ? TITLE : NO_TITLE;
}

/* Panels of a page have the same room on the left, that of the longest label, so that their frames are in line. */
static layout lay_out(const gg_chart *c, const gg_chart_looks *looks)
{
  layout l = {.columns = c->columns > 0 ? c->columns : c->n == 4 ? 2 : c->n < 3 ? (int)c->n : 3};
  if (l.columns > (int)c->n) l.columns = (int)c->n;
  if (l.columns < 1) l.columns = 1;
  l.rows = c->n ? ((int)c->n + l.columns - 1) / l.columns : 1;
  l.wide = l.columns == 1 ? ONE_WIDE : WIDE, l.tall = c->n == 1 ? ONE_TALL : TALL;
  int widest = 0;
  for (size_t p = 0; p < c->n; p++) {
    gg_axis x, y;
    axes_of(&c->panel[p], &x, &y);
    int width = gg_plot_axis_width(y);
    if (width > widest) widest = width;
    if (c->panel[p].title && *c->panel[p].title) l.above = PANEL_TITLE;
  }
  l.left = Y_LABEL + letter * (widest + 1), l.above += ABOVE;
  l.page[0] = (int)(l.columns * (l.left + l.wide + RIGHT));
  l.legend = gg_plot_chart_legend_in(looks, l.page[0]);
  l.head = title_of(c) + l.legend.height;
  l.page[1] = (int)(l.head + l.rows * (l.above + l.tall + BELOW));
  return l;
}

static gg_panel place_of(const layout *l, int i)
{
  double left = (i % l->columns) * (l->left + l->wide + RIGHT) + l->left;
  double top = l->head + (i / l->columns) * (l->above + l->tall + BELOW) + l->above;
  double width = l->page[0], height = l->page[1];
  return (gg_panel){left / width, (left + l->wide) / width, 1 - (top + l->tall) / height, 1 - top / height};
}

/* x, y, ends of the bars of x and of y; a bar that ends at or below 0 on a logarithmic axis ends at its edge. */
static void print_data(FILE *s, const gg_chart_panel *p, size_t k, gg_axis x_axis, gg_axis y_axis)
{
  const gg_chart_series *c = &p->series[k];
  fprintf(s, "$series%zu << EOD\n", k);
  for (size_t i = 0; i < c->n; i++) {
    double dx = error_of(c->x_error, i), dy = error_of(c->error, i), low = c->y[i] - dy, left = c->x[i] - dx;
    if (!is_there(p, c, i)) {
      fprintf(s, "\n");
      continue;
    }
    if (y_axis.log && low <= 0) low = fmin(y_axis.from, c->y[i]);
    if (x_axis.log && left <= 0) left = fmin(x_axis.from, c->x[i]);
    fprintf(s, "%.8g %.8g %.8g %.8g %.8g %.8g\n", c->x[i], c->y[i], left, c->x[i] + dx, low, c->y[i] + dy);
  }
  fprintf(s, "EOD\n");
}

static void print_label(FILE *s, char which, const gg_chart_axis *a)
{
  char unit[96];
  fprintf(s, "set %clabel '", which);
  gg_plot_text(s, a->label ? a->label : "");
  if (a->unit && *a->unit && !(a->unit[0] == '1' && !a->unit[1])) {
    gg_plot_unit(a->unit, unit, sizeof unit);
    fprintf(s, " [");
    gg_plot_text(s, unit);
    fprintf(s, "]");
  }
  fprintf(s, "'\n");
}

static void print_series(FILE *s, const gg_chart_looks *looks, const gg_chart_series *c, size_t k)
{
  if (c->style == GG_CHART_BAND)
    fprintf(s, ", $series%zu using 1:5:6 with filledcurves fc rgb '%s' fs transparent solid 0.25 noborder notitle", k,
            gg_plot_chart_colour(looks, c));
  fprintf(s, ", $series%zu using %s ", k,
          c->style != GG_CHART_POINTS ? "1:2 with lines"
          : c->x_error                ? "1:2:3:4:5:6 with xyerrorbars"
                                      : "1:2:5:6 with yerrorbars");
  gg_plot_chart_print_look(s, looks, c);
  fprintf(s, " notitle");
}

/* Bands under lines under points, and the first points over the others. */
static void plot_series(FILE *s, const gg_chart_looks *looks, const gg_chart_panel *p)
{
  static const gg_chart_style order[] = {GG_CHART_BAND, GG_CHART_LINE, GG_CHART_POINTS};
  for (int pass = 0; pass < 3; pass++)
    for (size_t i = 0; i < p->n; i++) {
      size_t k = order[pass] == GG_CHART_POINTS ? p->n - 1 - i : i;
      if (p->series[k].style == order[pass] && p->series[k].n) print_series(s, looks, &p->series[k], k);
    }
}

static void draw_panel(FILE *s, const gg_chart *c, int i, const gg_chart_looks *looks, const layout *l)
{
  const gg_chart_panel *p = &c->panel[i];
  gg_axis x, y;
  axes_of(p, &x, &y);
  gg_plot_place(s, place_of(l, i));
  for (size_t k = 0; k < p->n; k++) print_data(s, p, k, x, y);
  if (p->title && *p->title) {
    fprintf(s, "set label '");
    gg_plot_text(s, p->title);
    fprintf(s, "' at graph 0,1 left offset 0,0.8\n");
  }
  print_label(s, 'x', &p->x);
  print_label(s, 'y', &p->y);
  gg_plot_axis_print(s, 'x', x);
  gg_plot_axis_print(s, 'y', y);
  fprintf(s, "unset key\nset pointintervalbox 0\n");
  fprintf(s, "plot NaN notitle");
  plot_series(s, looks, p);
  fprintf(s, "\n");
}

gg_status gg_plot_chart_draw(const gg_chart *c, const char *picture, const char *format, gg_error *err)
{
  bool png;
  char *script = NULL;
  GG_TRY(gg_plot_format(picture, format, &png, err));
  if (!c->n) return gg_base_fail(err, GG_BAD_INPUT, "%s: there is nothing to draw", picture);
  FILE *s = gg_base_memory_stream_open(&script);
  if (!s) return gg_base_out_of_memory(err);
  locale_t before = gg_base_c_locale_enter();
  gg_chart_looks looks;
  gg_plot_chart_looks_of(c, &looks);
  layout l = lay_out(c, &looks);
  gg_plot_open_page(s, c->title, png, l.page[0], l.page[1]);
  for (size_t i = 0; i < c->n; i++) draw_panel(s, c, (int)i, &looks, &l);
  gg_plot_chart_print_legend(s, &looks, &l.legend, title_of(c), l.page);
  fprintf(s, "unset multiplot\n");
  gg_base_c_locale_leave(before);
  gg_status status = gg_base_memory_stream_close(s, &script) ? GG_OK : gg_base_out_of_memory(err);
  if (status == GG_OK) status = gg_plot_gnuplot_run(script, NULL, picture, err);
  free(script);
  return status;
}
