/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a run relaxed: series from its start to its end, with the averaging window shaded. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "plot/axis.h"
#include "plot/sheet.h"

enum { MOST_POINTS = 1200 };

static const json_t *result_of(const gg_stored_engine *e, const char *name)
{
  return json_object_get(json_object_get(e->document, "results"), name);
}

static const char *unit_of(const gg_stored_engine *e, gg_quantity q)
{
  const char *unit = json_string_value(json_object_get(result_of(e, gg_common_quantity_name(q)), "unit"));
  return unit ? unit : "1";
}

/* The unit of time that goes with a unit of temperature. */
static const char *time_unit(const gg_stored_engine *e)
{
  if (strstr(unit_of(e, GG_Q_TEMPERATURE), "gamma")) return "1/γ";
  return strstr(unit_of(e, GG_Q_MEAN_FREE_PATH), "n d^2") ? "1/(n d^2 v_0)" : "d/v_0";
}

/* A gas that cools for ever comes to times beyond all numbers and to a temperature of 0: drawn up to there. */
static size_t length_of(const gg_stored_series *d)
{
  size_t finite = d->n, left;
  while (finite > 0 && !isfinite(d->time[finite - 1])) finite--;
  left = finite;
  while (left > 0 && fabs(d->value[left - 1]) < DBL_MIN) left--;
  return left > 0 ? left : finite;
}

/* Long series are averaged over blocks, so that a picture stays small. */
static void add_blocks(gg_chart_series *to, const gg_stored_series *d, size_t n, double sign)
{
  size_t block = (n + MOST_POINTS - 1) / MOST_POINTS;
  for (size_t i = 0; i < n; i += block) {
    double time = 0, value = 0;
    size_t k = 0;
    for (; k < block && i + k < n; k++) time += d->time[i + k], value += d->value[i + k];
    if (isfinite(value) && isfinite(time)) gg_plot_sheet_add_point(to, time / (double)k, sign * value / (double)k, NAN);
  }
}

/* For run.duration: there is no averaging window, and results are those at the end. */
static bool is_followed(const gg_stored_engine *e)
{
  const json_t *run = json_object_get(json_object_get(e->document, "scene"), "run");
  return json_is_number(json_object_get(run, "duration"));
}

static void add_mean(gg_plot_sheet *s, const gg_stored_engine *e, gg_quantity q, gg_chart_series like)
{
  const json_t *mean = json_object_get(result_of(e, gg_common_quantity_name(q)), "mean");
  like.method = "mean", like.group = NULL, like.style = GG_CHART_LINE;
  gg_chart_series *line = json_is_number(mean) ? gg_plot_sheet_add_series(s, like, 2) : NULL;
  double y = json_number_value(mean) * (q == GG_Q_P_XY ? -1 : 1);
  for (int side = 0; line && side < 2; side++) gg_plot_sheet_add_point(line, e->window[side], y, NAN);
}

/* Returns the last time, 0: there is no series. */
static double add_quantity(gg_plot_sheet *s, const gg_stored_engine *e, gg_quantity q, const char *label)
{
  const gg_stored_series *d = gg_files_stored_series_find(e, gg_common_quantity_name(q));
  size_t n = d ? length_of(d) : 0;
  gg_chart_series like = {.group = label, .style = GG_CHART_BAND};
  gg_chart_series *series = n > 1 ? gg_plot_sheet_add_series(s, like, MOST_POINTS) : NULL;
  if (!series) return 0;
  add_blocks(series, d, n, q == GG_Q_P_XY ? -1 : 1);
  series->error = NULL;
  if (!is_followed(e)) add_mean(s, e, q, like);
  return d->time[n - 1];
}

/* Decades of value are drawn on a logarithmic axis, and those of time with them, as of gases that cool. */
static void set_axes(gg_chart_panel *p, double end)
{
  gg_extent all = GG_NO_EXTENT;
  for (size_t k = 0; k < p->n; k++)
    for (size_t i = 0; i < p->series[k].n; i++) gg_plot_extent_add(&all, p->series[k].y[i], false);
  p->y.log = all.least > 0 && all.most > 30 * all.least;
  const double start = p->n && p->series[0].n > 1 ? p->series[0].x[p->series[0].x[0] > 0 ? 0 : 1] : 0;
  p->x.log = p->y.log && start > 0 && end > 1000 * start;
  p->x.from = p->x.log ? start : 0, p->x.to = end;
  if (p->y.log || p->n < 3 || all.least < 0) return;
  p->y.from = 0, p->y.to = 1.05 * all.most;
}

static void add_panel(gg_plot_sheet *s, const gg_stored_engine *e, const char *what, const gg_quantity q[2], int n,
                      double share)
{
  char symbol[24];
  const char *label[2];
  double end = 0;
  gg_chart_panel *p = gg_plot_sheet_add_panel(s);
  if (!p) return;
  for (int k = 0; k < n; k++) {
    gg_common_quantity_enhanced(q[k], symbol, sizeof symbol);
    label[k] = gg_plot_sheet_add_text(s, "%s%s", q[k] == GG_Q_P_XY ? "-" : "", symbol);
    end = fmax(end, add_quantity(s, e, q[k], label[k]));
  }
  p->own_legend = true, p->share = share;
  const bool followed = is_followed(e);
  p->title = gg_plot_sheet_add_text(s, "%s: %s%s", e->name, what, followed ? "" : " (shaded: averaging window)");
  p->x = (gg_chart_axis){.label = "time", .unit = time_unit(e)};
  p->y = (gg_chart_axis){.label = what, .unit = unit_of(e, q[0])};
  set_axes(p, end);
  for (int side = 0; side < 2 && !followed; side++) p->shade[side] = fmin(e->window[side], end);
}

bool gg_plot_has_stresses(const gg_stored_engine *e)
{
  const gg_quantity stresses[] = {GG_Q_PRESSURE, GG_Q_P_XY};
  bool any = false;
  for (int k = 0; k < 2; k++) {
    const gg_stored_series *series = gg_files_stored_series_find(e, gg_common_quantity_name(stresses[k]));
    any |= series && series->n > 1;
  }
  return any;
}

void gg_plot_sheet_add_relaxation(gg_plot_sheet *s, const gg_stored_engine *e, bool stresses, double share)
{
  static const gg_quantity temperatures[] = {GG_Q_TEMPERATURE, GG_Q_ROTATIONAL_TEMPERATURE};
  static const gg_quantity pressures[] = {GG_Q_PRESSURE, GG_Q_P_XY};
  bool sheared = strstr(unit_of(e, GG_Q_TEMPERATURE), "gamma") != NULL;
  add_panel(s, e, "temperature", temperatures, 2, share);
  if (stresses) add_panel(s, e, sheared ? "stress" : "pressure", pressures, sheared ? 2 : 1, share);
}
