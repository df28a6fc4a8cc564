/* SPDX-License-Identifier: GPL-3.0-or-later */
/* md, dsmc and the theories side by side. Quantities with a scale are drawn as ratios to md (to dsmc if md did not
 * run), so that all fit on one axis; quantities about zero as they are. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "plot/result_panels.h"

enum { MOST_OWN = 6, MOST_METHODS = 24 };

typedef struct method {
  const char *name;
  const json_t *results;
  bool unsteady;
} method;

/* The engines come first, and the first method is the reference. */
static int list_methods(const gg_stored_result *stored, method *methods)
{
  int n = 0;
  const char *name;
  json_t *theory;
  for (int k = 0; k < GG_N_ENGINES; k++)
    if (stored->engine[k].name)
      methods[n++] = (method){stored->engine[k].name, json_object_get(stored->engine[k].document, "results"),
                              gg_plot_is_unsteady(&stored->engine[k])};
  json_object_foreach(json_object_get(stored->document, "theory"), name, theory)
  {
    if (n < MOST_METHODS) methods[n++] = (method){name, theory, false};
  }
  return n;
}

static double number(const method *m, const char *quantity, const char *member)
{
  const json_t *x = json_object_get(json_object_get(m->results, quantity), member);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

/* A ratio needs a mean of the reference that differs from zero, and a second method with a number. */
static bool has_ratio(const method *m, int n, const char *name)
{
  const double error = number(m, name, "stderr");
  bool compared = false;
  for (int k = 1; k < n; k++) compared |= isfinite(number(&m[k], name, "mean"));
  return compared && fabs(number(m, name, "mean")) > 3 * (isfinite(error) ? error : 0);
}

/* Names of the quantities in the panel of ratios or in that of values: those of graingas, and some that the program
 * which made the file has registered. */
static int select_quantities(const method *m, int n_methods, bool ratio, const char **selected)
{
  int n = 0, n_own = 0;
  const char *name;
  json_t *own;
  const unsigned drawn = ratio ? GG_DRAWN_AS_RATIO : GG_DRAWN;
  for (gg_quantity q = gg_common_quantity_next(-1, drawn); q < GG_N_QUANTITIES; q = gg_common_quantity_next(q, drawn)) {
    name = gg_common_quantity_name(q);
    if (isfinite(number(m, name, "mean")) && (!ratio || has_ratio(m, n_methods, name))) selected[n++] = name;
  }
  json_object_foreach((json_t *)(uintptr_t)m->results, name, own)
  {
    if (n_own < MOST_OWN && n < GG_CHART_CATEGORIES && gg_common_quantity_find(name) == GG_N_QUANTITIES &&
        isfinite(number(m, name, "mean")) && has_ratio(m, n_methods, name) == ratio)
      selected[n++] = name, n_own++;
  }
  return n;
}

static void name_category(gg_chart *c, gg_chart_panel *p, const char *name)
{
  char symbol[112];
  const gg_quantity q = gg_common_quantity_find(name);
  if (q < GG_N_QUANTITIES)
    gg_common_quantity_enhanced(q, symbol, sizeof symbol);
  else
    gg_plot_text_escape(name, symbol, sizeof symbol);
  p->word[p->n_categories] = q < GG_N_QUANTITIES ? gg_common_quantity_word(q) : "";
  p->symbol[p->n_categories++] = gg_plot_chart_text(c, "%s", symbol);
}

/* Ends of the axis of ratios: all values, but at most 0.75 below and above 1. */
static void set_ends(gg_chart_panel *p)
{
  const double most = 0.75;
  double reach[2] = {0.003, 0.003};
  for (size_t k = 0; k < p->n; k++)
    for (size_t i = 0; i < p->series[k]->n; i++) {
      const double off = p->series[k]->point[i].y - 1, error = p->series[k]->point[i].error;
      reach[0] = fmin(fmax(reach[0], error - off), most), reach[1] = fmin(fmax(reach[1], error + off), most);
    }
  const double margin = 0.08 * (reach[0] + reach[1]);
  p->y.from = 1 - fmin(reach[0] + margin, most), p->y.to = 1 + fmin(reach[1] + margin, most);
}

/* The reference of ratios is a band of its error about 1. */
static void add_panel(gg_chart *c, const method *methods, int n_methods, bool ratio, double share)
{
  const char *name[GG_CHART_CATEGORIES];
  const int n = select_quantities(methods, n_methods, ratio, name);
  gg_chart_panel *p = n ? gg_plot_chart_panel(c) : NULL;
  if (!p) return;
  for (int i = 0; i < n; i++) name_category(c, p, name[i]);
  for (const method *m = methods; m < methods + n_methods; m++) {
    gg_chart_series *s =
        gg_plot_chart_series(c, m->name, NULL, ratio && m == methods ? GG_CHART_BAND : GG_CHART_POINTS);
    for (int i = 0; i < n; i++) {
      const double scale = ratio ? number(methods, name[i], "mean") : 1, mean = number(m, name[i], "mean") / scale;
      const double error = fabs(number(m, name[i], "stderr") / scale);
      if (isfinite(mean))
        gg_plot_chart_point(c, s, (gg_chart_point){i + 1, mean, isfinite(error) ? error : 0, NAN, m->unsteady});
    }
  }
  p->share = share, p->level = ratio;
  p->y.label = ratio ? gg_plot_chart_text(c, "value / %s", methods[0].name) : "value";
  if (!ratio) return;
  p->title = gg_plot_chart_text(c, "shaded: standard error of %s", methods[0].name);
  set_ends(p);
}

void gg_plot_add_comparison(gg_chart *c, const gg_stored_result *stored)
{
  method methods[MOST_METHODS];
  const char *selected[GG_CHART_CATEGORIES];
  const int n = list_methods(stored, methods);
  if (!n) return;
  const bool both = select_quantities(methods, n, true, selected) && select_quantities(methods, n, false, selected);
  add_panel(c, methods, n, true, both ? 0.64 : 1);
  add_panel(c, methods, n, false, both ? 0.36 : 1);
}
