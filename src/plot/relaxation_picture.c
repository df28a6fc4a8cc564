/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The relaxation of a run: series from its start to its end, with the averaging window shaded. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "plot/result_panels.h"

enum { MOST_POINTS = 1200 };

static const json_t *result_of(const gg_stored_engine *e, gg_quantity q)
{
  return json_object_get(json_object_get(e->document, "results"), gg_common_quantity_name(q));
}

static const char *unit_of(const gg_stored_engine *e, gg_quantity q)
{
  const char *unit = json_string_value(json_object_get(result_of(e, q), "unit"));
  return unit ? unit : "1";
}

static const char *time_unit(const gg_stored_engine *e)
{
  if (strstr(unit_of(e, GG_Q_TEMPERATURE), "gamma")) return "1/γ";
  return strstr(unit_of(e, GG_Q_MEAN_FREE_PATH), "n d^2") ? "1/(n d^2 v_0)" : "d/v_0";
}

/* Points up to where a cooling gas comes to times beyond all numbers and to a temperature of 0. */
static size_t length_of(const gg_stored_series *d)
{
  size_t finite = d->n, left;
  while (finite > 0 && !isfinite(d->time[finite - 1])) finite--;
  left = finite;
  while (left > 0 && fabs(d->value[left - 1]) < DBL_MIN) left--;
  return left > 0 ? left : finite;
}

/* True with run.duration: there is no averaging window, and results are those at the end. */
static bool is_transient(const gg_stored_engine *e)
{
  const json_t *run = json_object_get(json_object_get(e->document, "scene"), "run");
  return json_is_number(json_object_get(run, "duration"));
}

/* Add the series of a quantity, averaged over blocks so that a picture stays small, and its mean. Returns the last
 * time; 0: there is no series. */
static double add_quantity(gg_chart *c, const gg_stored_engine *e, gg_quantity q, const char *label)
{
  const gg_stored_series *d = gg_files_stored_series_find(e, gg_common_quantity_name(q));
  const size_t n = d ? length_of(d) : 0, block = (n + MOST_POINTS - 1) / MOST_POINTS;
  const double sign = q == GG_Q_P_XY ? -1 : 1;
  if (n < 2) return 0;
  gg_chart_series *series = gg_plot_chart_series(c, NULL, label, GG_CHART_BAND);
  for (size_t i = 0; i < n; i += block) {
    const double m = (double)(n - i < block ? n - i : block);
    double time = 0, value = 0;
    for (size_t k = i; k < n && k < i + block; k++) time += d->time[k] / m, value += sign * d->value[k] / m;
    if (isfinite(value) && isfinite(time))
      gg_plot_chart_point(c, series, (gg_chart_point){time, value, NAN, NAN, false});
  }
  const json_t *mean = json_object_get(result_of(e, q), "mean");
  if (is_transient(e) || !json_is_number(mean)) return d->time[n - 1];
  gg_chart_series *line = gg_plot_chart_series(c, "mean", NULL, GG_CHART_LINE);
  for (int side = 0; side < 2; side++)
    gg_plot_chart_point(c, line, (gg_chart_point){e->window[side], sign * json_number_value(mean), NAN, NAN, false});
  return d->time[n - 1];
}

/* Values over decades are drawn on a logarithmic axis, and times over decades with them, as of gases that cool. */
static void set_axes(gg_chart_panel *p, double end)
{
  double least = INFINITY, most = -INFINITY;
  for (size_t k = 0; k < p->n; k++)
    for (size_t i = 0; i < p->series[k]->n; i++)
      least = fmin(least, p->series[k]->point[i].y), most = fmax(most, p->series[k]->point[i].y);
  const gg_chart_series *first = p->n ? p->series[0] : NULL;
  const double start = first && first->n > 1 ? first->point[first->point[0].x > 0 ? 0 : 1].x : 0;
  p->y.log = least > 0 && most > 30 * least;
  p->x.log = p->y.log && start > 0 && end > 1000 * start;
  p->x.from = p->x.log ? start : 0, p->x.to = end;
  if (!p->y.log && p->n > 2 && least >= 0) p->y.from = 0, p->y.to = 1.05 * most;
}

static void add_panel(gg_chart *c, const gg_stored_engine *e, const char *what, const gg_quantity q[2], int n,
                      double share)
{
  char symbol[24];
  double end = 0;
  gg_chart_panel *p = gg_plot_chart_panel(c);
  if (!p) return;
  for (int k = 0; k < n; k++) {
    gg_common_quantity_enhanced(q[k], symbol, sizeof symbol);
    end = fmax(end, add_quantity(c, e, q[k], gg_plot_chart_text(c, "%s%s", q[k] == GG_Q_P_XY ? "-" : "", symbol)));
  }
  p->own_legend = true, p->share = share;
  p->title = gg_plot_chart_text(c, "%s: %s%s", e->name, what, is_transient(e) ? "" : " (shaded: averaging window)");
  p->x = (gg_chart_axis){.label = "time", .unit = time_unit(e)};
  p->y = (gg_chart_axis){.label = what, .unit = unit_of(e, q[0])};
  set_axes(p, end);
  for (int side = 0; side < 2 && !is_transient(e); side++) p->shade[side] = fmin(e->window[side], end);
}

bool gg_plot_has_stresses(const gg_stored_engine *e)
{
  const gg_stored_series *p = gg_files_stored_series_find(e, gg_common_quantity_name(GG_Q_PRESSURE));
  const gg_stored_series *xy = gg_files_stored_series_find(e, gg_common_quantity_name(GG_Q_P_XY));
  return (p && p->n > 1) || (xy && xy->n > 1);
}

void gg_plot_add_relaxation(gg_chart *c, const gg_stored_engine *e, bool stresses, double share)
{
  static const gg_quantity temperatures[] = {GG_Q_TEMPERATURE, GG_Q_ROTATIONAL_TEMPERATURE};
  static const gg_quantity pressures[] = {GG_Q_PRESSURE, GG_Q_P_XY};
  const bool sheared = strstr(unit_of(e, GG_Q_TEMPERATURE), "gamma") != NULL;
  add_panel(c, e, "temperature", temperatures, 2, share);
  if (stresses) add_panel(c, e, sheared ? "stress" : "pressure", pressures, sheared ? 2 : 1, share);
}
