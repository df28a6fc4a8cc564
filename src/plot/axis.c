/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/axis.h"

#include <float.h>
#include <math.h>
#include <string.h>

void gg_plot_extent_add(gg_extent *e, double value, bool log)
{
  if (!isfinite(value) || (log && value <= 0)) return;
  e->least = fmin(e->least, value), e->most = fmax(e->most, value);
}

gg_axis gg_plot_axis_around(gg_extent e, bool log)
{
  if (!(e.least <= e.most)) return log ? (gg_axis){true, 0.1, 1} : (gg_axis){false, 0, 1};
  if (log) {
    double room = fmax(pow(e.most, 0.05) / pow(e.least, 0.05), 1.05);
    return (gg_axis){true, fmax(e.least / room, DBL_MIN), fmin(e.most * room, DBL_MAX)};
  }
  double size = fmax(fabs(e.least), fabs(e.most)), room = fmax(0.05 * (e.most - e.least), 1e-3 * size);
  if (e.most == e.least) room = 0.05 * size; /* one value: tics as far apart as those of others */
  if (room < 1e-290) room = 1; /* gnuplot makes no tics of numbers that small */
  gg_axis a = {false, e.least - room, e.most + room};
  if (e.least >= 0 && e.least < 0.3 * e.most) a.from = 0;
  if (e.most <= 0 && e.most > 0.3 * e.least) a.to = 0;
  return a;
}

bool gg_plot_axis_takes(const gg_chart_panel *p, const gg_chart_series *s, size_t i)
{
  return isfinite(s->x[i]) && isfinite(s->y[i]) && !(p->x.log && s->x[i] <= 0) && !(p->y.log && s->y[i] <= 0);
}

static bool is_inside(const gg_chart_axis *a, double x)
{
  return a->from == a->to || (x >= a->from && x <= a->to);
}

static double error_of(const double *error, size_t i)
{
  return error && isfinite(error[i]) ? fabs(error[i]) : 0;
}

/* With error bars; on a logarithmic axis only those that end above 0. A bar alone does not reach below 0. */
static void add_point(const gg_chart_panel *p, const gg_chart_series *s, size_t i, gg_extent *x, gg_extent *y)
{
  double dx = error_of(s->x_error, i), dy = error_of(s->error, i), low = s->y[i] - dy;
  if (!gg_plot_axis_takes(p, s, i) || !is_inside(&p->x, s->x[i])) return;
  gg_plot_extent_add(x, s->x[i] - dx, p->x.log), gg_plot_extent_add(x, s->x[i] + dx, p->x.log);
  gg_plot_extent_add(y, s->y[i], p->y.log), gg_plot_extent_add(y, s->y[i] + dy, p->y.log);
  if (p->y.log ? s->y[i] > 1.5 * dy : low > 0 || s->y[i] < 0) gg_plot_extent_add(y, low, p->y.log);
}

static gg_axis axis_of(const gg_chart_axis *a, gg_extent extent)
{
  bool given = a->from != a->to && !(a->log && a->from <= 0);
  return given ? (gg_axis){a->log, a->from, a->to} : gg_plot_axis_around(extent, a->log);
}

void gg_plot_axis_of_panel(const gg_chart_panel *p, gg_axis *x, gg_axis *y)
{
  gg_extent of_x = GG_NO_EXTENT, of_y = GG_NO_EXTENT;
  for (int lines = 0; lines < 2 && !(of_x.least <= of_x.most); lines++)
    for (size_t k = 0; k < p->n; k++)
      for (size_t i = 0; i < p->series[k].n && (!p->own_legend || lines || p->series[k].style != GG_CHART_LINE); i++)
        add_point(p, &p->series[k], i, &of_x, &of_y);
  *x = axis_of(&p->x, of_x), *y = axis_of(&p->y, of_y);
}

/* The quotient of its ends may be more than a number holds. */
static double decades_of(gg_axis a)
{
  return log10(a.to) - log10(a.from);
}

double gg_plot_axis_share(gg_axis a, double x)
{
  if (!a.log) return (x - a.from) / (a.to - a.from);
  return (log10(x) - log10(a.from)) / decades_of(a);
}

static bool has_powers(gg_axis a)
{
  return a.log && decades_of(a) > 2.2 && (a.from < 0.9e-3 || a.to > 1.1e4);
}

/* Steps of 1, 2 or 5. */
static double round_step(double span)
{
  double raw = span / 6, decade = pow(10, floor(log10(raw))), r = raw / decade;
  return decade * (r <= 1.4 ? 1 : r <= 3 ? 2 : r <= 7 ? 5 : 10);
}

/* gnuplot names whole decades alone: of few also their double and fivefold, below one those of a linear axis. */
static void add_tics(FILE *s, char which, gg_axis a)
{
  double step = round_step(a.to - a.from);
  if (decades_of(a) > 2.2) return;
  for (double x = step * ceil(a.from / step); decades_of(a) < 0.7 && x <= a.to; x += step)
    fprintf(s, "set %ctics add (%.9g)\n", which, x);
  if (decades_of(a) < 0.7) return;
  for (int k = (int)floor(log10(a.from)); k <= (int)log10(a.to); k++)
    fprintf(s, "set %ctics add (%.12g, %.12g)\n", which, 2 * pow(10, k), 5 * pow(10, k));
}

void gg_plot_axis_print(FILE *s, char which, gg_axis a)
{
  fprintf(s, "set %crange [%.12g:%.12g]\n%s logscale %c\nset format %c '%s'\n", which, a.from, a.to,
          a.log ? "set" : "unset", which, which, has_powers(a) ? "10^{%T}" : "%h");
  if (a.log) add_tics(s, which, a);
}

static int width_of(double x)
{
  char text[32];
  return fabs(x) < DBL_MIN ? 1 : snprintf(text, sizeof text, "%.10g", x);
}

/* Tics are at some fifth of the axis, in round steps. */
int gg_plot_axis_width(gg_axis a)
{
  if (has_powers(a)) return 5;
  double step = pow(10, floor(log10((a.to - a.from) / 5)));
  if (a.log) return (int)fmax(width_of(pow(10, round(log10(a.from)))), width_of(pow(10, round(log10(a.to)))));
  double first = step * ceil(a.from / step), last = step * floor(a.to / step);
  return (int)fmin(10, fmax(width_of(first), width_of(last)));
}
