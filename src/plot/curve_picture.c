/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of curves: one page an observable, one panel for curves that belong together. Curves are bands of one
 * standard error, or points with error bars if a theory, drawn as a line, has them, too. */
#include <math.h>
#include <string.h>

#include "files/curve_table.h"
#include "io/checked_json.h"
#include "plot/result_panels.h"

enum {
  MOST_IN_PANEL = 8, /* more curves would not be distinguishable */
  MOST_POINTS = 60   /* of a single curve that is drawn as points */
};

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

/* A measured curve without its empty ends, which histograms have. On a logarithmic axis a point whose error is above
 * two thirds of its value says little, and hides other curves. */
static void add_measured(gg_chart *c, gg_chart_series *s, bool log, const json_t *curve, bool unsteady)
{
  size_t from = 0, to = size_of(curve);
  while (from < to && at(curve, "value", from) == 0) from++;
  while (to > from && at(curve, "value", to - 1) == 0) to--;
  for (size_t i = from; i < to; i++) {
    const double y = at(curve, "value", i), error = at(curve, "stderr", i);
    if (isfinite(y) && !(log && error > 0.67 * y))
      gg_plot_chart_point(c, s, (gg_chart_point){at(curve, "x", i), y, isfinite(error) ? error : 0, NAN, unsteady});
  }
}

static void add_line(gg_chart *c, const char *method, const char *group, const json_t *abscissae, const json_t *values)
{
  gg_chart_series *s = gg_plot_chart_series(c, method, group, GG_CHART_LINE);
  for (size_t i = 0; i < size_of(abscissae); i++)
    gg_plot_chart_point(c, s, (gg_chart_point){at(abscissae, "x", i), at(values, "value", i), NAN, NAN, false});
}

typedef struct group {
  const json_t *curve[MOST_IN_PANEL], *theories;
  const char *name[MOST_IN_PANEL], *label[MOST_IN_PANEL], *title;
  int n, n_left_out;
} group;

/* Lines of theories: of all beside a single curve; beside several curves those of the first theories up to the second
 * line, since more could not be told apart. Returns whether there are any; a chart of NULL draws none. */
static bool add_theories(gg_chart *c, const group *g)
{
  int n = 0;
  const char *theory;
  json_t *curves;
  json_object_foreach((json_t *)(uintptr_t)g->theories, theory, curves)
  {
    if (n > 1 && g->n > 1) break;
    for (int k = 0; k < g->n; k++) {
      const json_t *one = json_object_get(curves, g->name[k]);
      if (one && c) add_line(c, theory, g->label[k], one, one);
      n += one != NULL;
    }
  }
  return n > 0;
}

static int list_groups(const json_t *document, const json_t *theories, const char *name, group *groups)
{
  int n = 0, k;
  const char *key;
  json_t *curve;
  json_object_foreach(json_object_get(document, "curves"), key, curve)
  {
    const char *title = gg_io_json_string(curve, "panel");
    if (strcmp(gg_io_json_string(curve, "group"), name) != 0) continue;
    for (k = 0; k < n && strcmp(groups[k].title, title) != 0; k++) continue;
    if (k == n && n < GG_CHART_PANELS) groups[n++] = (group){.title = title, .theories = theories};
    if (k == n) continue;
    group *g = &groups[k];
    const char *label = gg_io_json_string(curve, "label");
    if (g->n == MOST_IN_PANEL)
      g->n_left_out++;
    else
      g->name[g->n] = key, g->label[g->n] = *label ? label : NULL, g->curve[g->n++] = curve;
  }
  return n;
}

/* Laws beside the curves. One law of all curves is drawn once, without a colour of theirs. */
static void add_laws(gg_chart *c, const group *g)
{
  int n = 0;
  const json_t *law[MOST_IN_PANEL];
  for (int k = 0; k < g->n; k++) {
    law[k] = json_object_get(g->curve[k], "reference");
    if (k && law[k] && json_equal(law[k], json_object_get(g->curve[k - 1], "reference"))) law[k] = NULL;
    n += law[k] != NULL;
  }
  for (int k = 0; k < g->n; k++)
    if (law[k]) add_line(c, gg_io_json_string(law[k], "label"), n > 1 ? g->label[k] : NULL, g->curve[k], law[k]);
}

/* Chi^2 a point and the largest z between the only curve of a panel and the other engine's. */
static const char *agreement(gg_chart *c, const group *g, const json_t *other)
{
  double squares = 0, most = 0;
  int n = 0;
  for (size_t i = 0; i < size_of(other); i++) {
    const double z = (at(g->curve[0], "value", i) - at(other, "value", i)) /
                     hypot(at(g->curve[0], "stderr", i), at(other, "stderr", i));
    if (!isfinite(z) || at(g->curve[0], "x", i) != at(other, "x", i)) continue;
    squares += z * z, n++;
    if (fabs(z) > fabs(most)) most = z;
  }
  return n ? gg_plot_chart_text(c, "%s: chi^2/points %.3g, largest z %+.1f", g->title, squares / n, most) : g->title;
}

/* Points beside another engine or a theory; a band where points would hide these. A single curve has the colour of its
 * engine, several curves one colour each. */
static void fill_panel(gg_chart *c, gg_chart_panel *p, group *g, const gg_stored_engine *engine,
                       const gg_stored_engine *other)
{
  const bool beside = other || add_theories(NULL, g), dense = g->n == 1 && size_of(g->curve[0]) > MOST_POINTS;
  if (other && g->n == 1) g->label[0] = NULL;
  for (int k = 0; k < g->n; k++)
    add_measured(c,
                 gg_plot_chart_series(c, engine->name, g->label[k], beside && !dense ? GG_CHART_POINTS : GG_CHART_BAND),
                 p->y.log, g->curve[k], gg_plot_is_unsteady(engine) && !dense);
  for (int k = 0; k < g->n && other; k++) {
    const json_t *curve = json_object_get(json_object_get(other->document, "curves"), g->name[k]);
    if (!curve || size_of(curve) != size_of(g->curve[k])) continue;
    add_measured(c, gg_plot_chart_series(c, other->name, g->label[k], GG_CHART_BAND), p->y.log, curve,
                 gg_plot_is_unsteady(other) && !dense);
    if (g->n == 1) p->title = agreement(c, g, curve);
  }
  add_theories(c, g);
  add_laws(c, g);
}

static gg_chart_axis axis_of(const json_t *curve, const char *name, const char *unit, const char *log)
{
  return (gg_chart_axis){gg_io_json_string(curve, name), gg_io_json_string(curve, unit),
                         json_is_true(json_object_get(curve, log)), 0, 0};
}

void gg_plot_add_curves(gg_chart *c, const gg_stored_engine *engine, const gg_stored_engine *other,
                        const json_t *theories, const char *name)
{
  group groups[GG_CHART_PANELS];
  const int n = list_groups(engine->document, theories, name, groups);
  for (group *g = groups; g < groups + n; g++) {
    gg_chart_panel *p = gg_plot_chart_panel(c);
    if (!p) return;
    p->title = g->n_left_out
                   ? gg_plot_chart_text(c, "%s: the first %d of %d curves", g->title, g->n, g->n + g->n_left_out)
                   : g->title;
    p->own_legend = true;
    p->x = axis_of(g->curve[0], "x_name", "x_unit", "log_x"), p->y = axis_of(g->curve[0], "y_name", "unit", "log_y");
    fill_panel(c, p, g, engine, other);
  }
}
