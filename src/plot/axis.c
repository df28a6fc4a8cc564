/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes of charts: their ends and tics. */
#include <float.h>
#include <math.h>

#include "plot/chart.h"

/* Numbers that an axis has to show; on a logarithmic axis only those above 0. */
typedef struct extent {
  double least, most;
} extent;

static void extend(extent *e, double value, bool log)
{
  if (!isfinite(value) || (log && value <= 0)) return;
  e->least = fmin(e->least, value), e->most = fmax(e->most, value);
}

/* Ends with some room around the numbers; of no numbers: from 0 to 1. */
static void set_ends(gg_chart_axis *a, extent e)
{
  if (a->from != a->to && !(a->log && a->from <= 0)) return;
  if (!(e.least <= e.most)) e = a->log ? (extent){0.1, 1} : (extent){0, 1};
  if (a->log) {
    const double room = fmax(pow(e.most, 0.05) / pow(e.least, 0.05), 1.05);
    a->from = fmax(e.least / room, DBL_MIN), a->to = fmin(e.most * room, DBL_MAX);
    return;
  }
  const double size = fmax(fabs(e.least), fabs(e.most));
  double room = fmax(0.05 * (e.most - e.least), 1e-3 * size);
  if (e.most == e.least) room = 0.05 * size; /* one value: tics as far apart as those of others */
  if (room < 1e-290) room = 1;               /* gnuplot makes no tics of numbers that small */
  a->from = e.least >= 0 && e.least < 0.3 * e.most ? 0 : e.least - room;
  a->to = e.most <= 0 && e.most > 0.3 * e.least ? 0 : e.most + room;
}

bool gg_plot_point_shows(const gg_chart_panel *p, const gg_chart_point *at)
{
  return isfinite(at->x) && isfinite(at->y) && !(p->x.log && at->x <= 0) && !(p->y.log && at->y <= 0);
}

/* Error bars count, except for one that alone would reach below 0, or is most of a number on a logarithmic axis. */
static void add_point(const gg_chart_panel *p, const gg_chart_point *at, extent *x, extent *y)
{
  const double dx = isfinite(at->x_error) ? fabs(at->x_error) : 0, dy = isfinite(at->error) ? fabs(at->error) : 0;
  const bool inside = p->x.from == p->x.to || (at->x >= p->x.from && at->x <= p->x.to);
  if (!inside || !gg_plot_point_shows(p, at)) return;
  extend(x, at->x - dx, p->x.log), extend(x, at->x + dx, p->x.log);
  extend(y, at->y, p->y.log), extend(y, at->y + dy, p->y.log);
  if (p->y.log ? at->y > 1.5 * dy : at->y > dy || at->y < 0) extend(y, at->y - dy, p->y.log);
}

/* Lines beside points of curves extend the axis of values by half of the points' span at most. */
void gg_plot_axes_choose(gg_chart_panel *p)
{
  const extent none = {INFINITY, -INFINITY};
  extent x[2] = {none, none}, y[2] = {none, none};
  for (size_t k = 0; k < p->n; k++) {
    const int line = p->own_legend && p->series[k]->look.style == GG_CHART_LINE;
    for (size_t i = 0; i < p->series[k]->n; i++) add_point(p, &p->series[k]->point[i], &x[line], &y[line]);
  }
  const bool points = x[0].least <= x[0].most;
  const double room = p->y.log ? 0 : 0.5 * (y[0].most - y[0].least);
  y[0].least = fmin(y[0].least, fmax(y[1].least, y[0].least - room));
  y[0].most = fmax(y[0].most, fmin(y[1].most, y[0].most + room));
  set_ends(&p->x, x[!points]), set_ends(&p->y, y[!points]);
}

/* The quotient of the ends may be more than a double holds. */
static double decades_of(const gg_chart_axis *a)
{
  return a->log ? log10(a->to) - log10(a->from) : 0;
}

double gg_plot_axis_place(const gg_chart_axis *a, double x)
{
  return a->log ? (log10(x) - log10(a->from)) / decades_of(a) : (x - a->from) / (a->to - a->from);
}

/* gnuplot labels whole decades alone: of few decades also their double and fivefold, and below one the tics of a linear
 * axis, in steps of 1, 2 or 5. */
static void add_tics(FILE *s, char which, const gg_chart_axis *a)
{
  const double raw = (a->to - a->from) / 6, decade = pow(10, floor(log10(raw))), r = raw / decade;
  const double step = decade * (r <= 1.4 ? 1 : r <= 3 ? 2 : r <= 7 ? 5 : 10);
  if (decades_of(a) < 0.7)
    for (double x = step * ceil(a->from / step); x <= a->to; x += step) fprintf(s, "set %ctics add (%.9g)\n", which, x);
  else if (decades_of(a) <= 2.2)
    for (int k = (int)floor(log10(a->from)); k <= (int)log10(a->to); k++)
      fprintf(s, "set %ctics add (%.12g, %.12g)\n", which, 2 * pow(10, k), 5 * pow(10, k));
}

void gg_plot_axis_print(FILE *s, char which, const gg_chart_axis *a)
{
  fprintf(s, "set %crange [%.12g:%.12g]\n", which, a->from, a->to);
  if (!a->log) return;
  const bool powers = decades_of(a) > 2.2 && (a->from < 0.9e-3 || a->to > 1.1e4);
  fprintf(s, "set logscale %c\nset format %c '%s'\n", which, which, powers ? "10^{%T}" : "%h");
  add_tics(s, which, a);
}
