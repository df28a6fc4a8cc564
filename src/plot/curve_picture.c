/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of curves: one page an observable, one panel for curves that belong together, shaded bands of one standard
 * error; where a theory has them, too, points with error bars, and the theory as a line. */
#include <math.h>
#include <string.h>

#include "io/checked_json.h"
#include "files/curve_table.h"
#include "plot/sheet.h"

enum { MOST_IN_PANEL = 8 };

int gg_plot_curve_groups(const json_t *document, const char **names, int most)
{
  int n = 0, k;
  const char *name;
  json_t *curve;
  json_object_foreach(json_object_get(document, "curves"), name, curve)
  {
    const char *group = gg_io_json_string(curve, "group");
    for (k = 0; k < n && strcmp(names[k], group) != 0; k++) continue;
    if (k == n && n < most) names[n++] = group;
  }
  return n;
}

static double at(const json_t *curve, const char *key, size_t i)
{
  const json_t *x = json_array_get(json_object_get(curve, key), i);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

static size_t size_of(const json_t *curve)
{
  return json_array_size(json_object_get(curve, "x"));
}

/* The part of a curve between its first and last points other than zero: histograms have empty ends. */
static void find_ends(const json_t *curve, size_t *from, size_t *to)
{
  *from = 0, *to = size_of(curve);
  while (*from < *to && at(curve, "value", *from) == 0) ++*from;
  while (*to > *from && at(curve, "value", *to - 1) == 0) --*to;
}

/* On a logarithmic axis a point that is not known within two thirds of itself says little, and hides other curves. */
static void add_measured(gg_plot_sheet *s, const gg_chart_panel *p, gg_chart_series like, const json_t *curve)
{
  size_t from, to;
  find_ends(curve, &from, &to);
  gg_chart_series *series = gg_plot_sheet_add_series(s, like, to - from);
  for (size_t i = from; series && i < to; i++) {
    double y = at(curve, "value", i), error = at(curve, "stderr", i);
    if (isfinite(y) && !(p->y.log && error > 0.67 * y))
      gg_plot_sheet_add_point(series, at(curve, "x", i), y, isfinite(error) ? error : 0);
  }
}

static void add_line(gg_plot_sheet *s, gg_chart_series like, const json_t *abscissae, const json_t *values)
{
  size_t n = size_of(abscissae);
  gg_chart_series *series = gg_plot_sheet_add_series(s, like, n);
  for (size_t i = 0; series && i < n; i++)
    gg_plot_sheet_add_point(series, at(abscissae, "x", i), at(values, "value", i), NAN);
  if (series) series->error = NULL;
}

/* A panel as it comes to be: the curves in it, and the theory whose lines it has. */
typedef struct group {
  const json_t *curve[MOST_IN_PANEL], *theory[MOST_IN_PANEL];
  const char *name[MOST_IN_PANEL], *title, *theory_name;
  int n, more; /* curves for which there is no room: those of many species are too many to be distinguished */
} group;

/* The first theory that has a curve of this name: lines of several would be too many. */
static void add_curve(group *g, const char *name, const json_t *curve, const json_t *theories)
{
  const char *theory;
  json_t *curves;
  g->name[g->n] = name, g->curve[g->n] = curve, g->theory[g->n] = NULL;
  json_object_foreach((json_t *)(uintptr_t)theories, theory, curves)
  {
    const json_t *one = json_object_get(curves, name);
    if (!one || (g->theory_name && strcmp(g->theory_name, theory) != 0)) continue;
    g->theory[g->n] = one, g->theory_name = theory;
    break;
  }
  g->n++;
}

static int groups_of(const json_t *document, const json_t *theories, const char *name, group *groups)
{
  int n = 0, k;
  const char *key;
  json_t *curve;
  json_object_foreach(json_object_get(document, "curves"), key, curve)
  {
    const char *title = gg_io_json_string(curve, "panel");
    if (strcmp(gg_io_json_string(curve, "group"), name) != 0) continue;
    for (k = 0; k < n && strcmp(groups[k].title, title) != 0; k++) continue;
    if (k == n && n < GG_SHEET_PANELS) groups[n++] = (group){.title = title};
    if (k == n) continue;
    if (groups[k].n == MOST_IN_PANEL)
      groups[k].more++;
    else
      add_curve(&groups[k], key, curve, theories);
  }
  return n;
}

/* One law beside all curves is drawn once, without a colour of theirs. */
static void add_laws(gg_plot_sheet *s, const group *g, const char *const *labels)
{
  int n = 0;
  const json_t *law[MOST_IN_PANEL];
  for (int k = 0; k < g->n; k++) {
    law[k] = json_object_get(g->curve[k], "reference");
    if (k && law[k] && json_equal(law[k], json_object_get(g->curve[k - 1], "reference"))) law[k] = NULL;
    n += law[k] != NULL;
  }
  for (int k = 0; k < g->n; k++) {
    gg_chart_series like = {.method = gg_io_json_string(law[k], "label"), .style = GG_CHART_LINE};
    if (n > 1) like.group = labels[k];
    if (law[k]) add_line(s, like, g->curve[k], law[k]);
  }
}

/* Chi^2 a point and the largest z between the first curve of a panel and the other engine's. */
static const char *verdict(gg_plot_sheet *s, const group *g, const json_t *other)
{
  double squares = 0, most = 0;
  int n = 0;
  for (size_t i = 0; i < size_of(other) && g->n == 1; i++) {
    const double z = (at(g->curve[0], "value", i) - at(other, "value", i)) /
                     hypot(at(g->curve[0], "stderr", i), at(other, "stderr", i));
    if (!isfinite(z)) continue;
    squares += z * z, n++;
    if (fabs(z) > fabs(most)) most = z;
  }
  return n ? gg_plot_sheet_add_text(s, "%s: chi^2/points %.3g, largest z %+.1f", g->title, squares / n, most)
           : g->title;
}

/* The same curves of the other engine, at the same places. */
static void add_other(gg_plot_sheet *s, gg_chart_panel *p, const group *g, const gg_stored_engine *other,
                      const char *const *labels)
{
  const json_t *curves = json_object_get(other->document, "curves");
  for (int k = 0; k < g->n; k++) {
    const json_t *curve = json_object_get(curves, g->name[k]);
    if (!curve || size_of(curve) != size_of(g->curve[k])) continue;
    add_measured(
        s, p,
        (gg_chart_series){
            .method = other->name, .group = labels[k], .style = GG_CHART_BAND, .all_open = gg_plot_is_unsteady(other)},
        curve);
    if (k == 0) p->title = verdict(s, g, curve);
  }
}

static void fill_panel(gg_plot_sheet *s, gg_chart_panel *p, const group *g, const gg_stored_engine *engine,
                       const gg_stored_engine *other)
{
  const char *labels[MOST_IN_PANEL];
  for (int k = 0; k < g->n; k++) {
    const char *label = gg_io_json_string(g->curve[k], "label");
    labels[k] = *label ? label : NULL;
    gg_chart_series like = {.method = engine->name,
                            .group = labels[k],
                            .style = other || g->theory[k] ? GG_CHART_POINTS : GG_CHART_BAND,
                            .all_open = gg_plot_is_unsteady(engine)};
    add_measured(s, p, like, g->curve[k]);
  }
  if (other) add_other(s, p, g, other, labels);
  for (int k = 0; k < g->n; k++)
    if (g->theory[k])
      add_line(s, (gg_chart_series){.method = g->theory_name, .group = labels[k], .style = GG_CHART_LINE}, g->theory[k],
               g->theory[k]);
  add_laws(s, g, labels);
}

void gg_plot_sheet_add_curves(gg_plot_sheet *s, const gg_stored_engine *engine, const gg_stored_engine *other,
                              const json_t *theories, const char *name)
{
  group groups[GG_SHEET_PANELS];
  int n = groups_of(engine->document, theories, name, groups);
  for (int i = 0; i < n; i++) {
    const group *g = &groups[i];
    const json_t *first = g->curve[0];
    gg_chart_panel *p = gg_plot_sheet_add_panel(s);
    p->title =
        g->more ? gg_plot_sheet_add_text(s, "%s: the first %d of %d curves", g->title, g->n, g->n + g->more) : g->title;
    p->own_legend = true;
    p->x = (gg_chart_axis){gg_io_json_string(first, "x_name"), gg_io_json_string(first, "x_unit"),
                           json_is_true(json_object_get(first, "log_x")), 0, 0};
    p->y = (gg_chart_axis){gg_io_json_string(first, "y_name"), gg_io_json_string(first, "unit"),
                           json_is_true(json_object_get(first, "log_y")), 0, 0};
    fill_panel(s, p, g, engine, other);
  }
}
