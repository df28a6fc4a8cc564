/* SPDX-License-Identifier: GPL-3.0-or-later */
/* md, dsmc and the theories side by side. Quantities with a scale are shown as ratios to md (to dsmc where md did not
 * run), so that all fit on one axis; those around zero as they are. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "plot/sheet.h"

enum { MOST_OWN = 6, MOST_METHODS = 24 };

typedef struct method {
  const char *name;
  const json_t *results;
  bool unsteady;
} method;

/* A quantity that the program that made the file brought with it. */
static bool is_own(const char *quantity)
{
  return gg_common_quantity_find(quantity) == GG_N_QUANTITIES;
}

static int methods_of(const gg_stored_result *stored, method *methods)
{
  int n = 0;
  const char *name;
  json_t *theory;
  for (int k = 0; k < 2; k++)
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

/* Measured, and different from zero? */
static bool is_measured(const method *engine, const char *name, bool *from_zero)
{
  double mean = number(engine, name, "mean"), error = number(engine, name, "stderr");
  *from_zero = fabs(mean) > 3 * (isfinite(error) ? error : 0);
  return isfinite(mean);
}

/* Has another method than the first a number to be divided by its? */
static bool is_compared(const method *methods, int n, const char *name)
{
  int k = 1;
  while (k < n && !isfinite(number(&methods[k], name, "mean"))) k++;
  return k < n;
}

/* The names of what the first method, an engine, has measured, as ratios what is compared and told from zero; and of
 * some quantities of the program's own. */
static int select_quantities(const method *methods, int n_methods, bool ratio, const char **selected)
{
  const method *engine = methods;
  int n = 0, n_own = 0;
  bool from_zero;
  const char *name;
  json_t *own;
  const unsigned drawn = ratio ? GG_DRAWN_AS_RATIO : GG_DRAWN;
  for (gg_quantity q = gg_common_quantity_next(-1, drawn); q < GG_N_QUANTITIES; q = gg_common_quantity_next(q, drawn)) {
    name = gg_common_quantity_name(q);
    if (!is_measured(engine, name, &from_zero) || (ratio && !(from_zero && is_compared(methods, n_methods, name))))
      continue;
    selected[n++] = name;
  }
  json_object_foreach((json_t *)(uintptr_t)engine->results, name, own)
  {
    if (n_own == MOST_OWN || !is_own(name) || !is_measured(engine, name, &from_zero)) continue;
    if ((from_zero && is_compared(methods, n_methods, name)) != ratio) continue;
    selected[n++] = name, n_own++;
  }
  return n;
}

/* "word\nsymbol", for double quotes; a name of one's own stands as it is: no subscripts in it, and nothing that gnuplot
 * would do. Of many quantities (species have one each) the symbols alone: words would run into each other. */
static const char *label_of(gg_plot_sheet *s, const char *name, bool wordy)
{
  char text[112];
  size_t used = 0;
  gg_quantity q = gg_common_quantity_find(name);
  if (q < GG_N_QUANTITIES) {
    const char *word = gg_common_quantity_word(q);
    gg_common_quantity_enhanced(q, text, sizeof text);
    return gg_plot_sheet_add_text(s, "%s%s%s", wordy ? word : "", wordy && *word ? "\\n" : "", text);
  }
  for (const char *c = name; *c && used + 4 < sizeof text; c++)
    if (*c == '_')
      used += (size_t)snprintf(text + used, sizeof text - used, "\\\\_");
    else
      text[used++] = isalnum((unsigned char)*c) || strchr(" .-+/()", *c) || (*c & 0x80) ? *c : '?';
  text[used] = '\0';
  return gg_plot_sheet_add_text(s, "%s", text);
}

/* How far the axis reaches below and above 1: all that is there, but not to the ends of the world. */
static void set_reach(gg_chart_panel *p)
{
  const double most = 0.75;
  double reach[2] = {0.003, 0.003};
  for (size_t k = 0; k < p->n; k++)
    for (size_t i = 0; i < p->series[k].n; i++) {
      double off = p->series[k].y[i] - 1, error = p->series[k].error[i];
      reach[0] = fmax(reach[0], error - off), reach[1] = fmax(reach[1], error + off);
    }
  for (int side = 0; side < 2; side++) reach[side] = fmin(reach[side], most);
  double margin = 0.08 * (reach[0] + reach[1]);
  p->y.from = 1 - fmin(reach[0] + margin, most), p->y.to = 1 + fmin(reach[1] + margin, most);
}

/* Of ratios the reference is a band of its error about 1. */
static void add_method(gg_plot_sheet *s, const method *m, const method *reference, bool ratio, const char *const *names,
                       int n)
{
  gg_chart_series like = {
      .method = m->name, .style = ratio && m == reference ? GG_CHART_BAND : GG_CHART_POINTS, .all_open = m->unsteady};
  gg_chart_series *series = gg_plot_sheet_add_series(s, like, (size_t)n);
  for (int i = 0; series && i < n; i++) {
    double scale = ratio ? number(reference, names[i], "mean") : 1, mean = number(m, names[i], "mean") / scale;
    double error = fabs(number(m, names[i], "stderr") / scale);
    if (isfinite(mean)) gg_plot_sheet_add_point(series, i + 1, mean, isfinite(error) ? error : 0);
  }
  if (series && !series->n) gg_plot_sheet_drop_series(s);
}

/* Words of quantities side by side, in layout pixels. */
static bool has_room(const gg_plot_sheet *s, const char *const *names, int n, double share)
{
  const double letter = 6, margins = 90, screen = 1100, width = s->width > 0 ? s->width : screen;
  size_t longest = 0;
  for (int i = 0; i < n; i++) {
    gg_quantity q = gg_common_quantity_find(names[i]);
    size_t length = strlen(q < GG_N_QUANTITIES ? gg_common_quantity_word(q) : names[i]);
    if (length > longest) longest = length;
  }
  return letter * (double)longest * n < width * (s->width > 0 && s->width < screen * 0.65 ? 1 : share) - margins;
}

static void add_panel(gg_plot_sheet *s, const method *methods, int n_methods, bool ratio, double share)
{
  const char *selected[GG_SHEET_NAMES];
  int n = select_quantities(methods, n_methods, ratio, selected);
  bool wordy = has_room(s, selected, n, share);
  gg_chart_panel *p = gg_plot_sheet_add_panel(s);
  for (int k = 0; k < n_methods; k++) add_method(s, &methods[k], &methods[0], ratio, selected, n);
  for (int i = 0; i < n; i++) s->name[ratio][i] = label_of(s, selected[i], wordy);
  p->name = s->name[ratio], p->n_names = (size_t)n, p->share = share, p->level = ratio;
  p->y.label = "value";
  if (!ratio) return;
  p->y.label = gg_plot_sheet_add_text(s, "value / %s", methods[0].name);
  p->title = gg_plot_sheet_add_text(s, "shaded: standard error of %s", methods[0].name);
  set_reach(p);
}

void gg_plot_sheet_add_comparison(gg_plot_sheet *s, const gg_stored_result *stored)
{
  method methods[MOST_METHODS];
  const char *selected[GG_SHEET_NAMES];
  int n = methods_of(stored, methods);
  int ratios = n ? select_quantities(methods, n, true, selected) : 0;
  int others = n ? select_quantities(methods, n, false, selected) : 0;
  if (ratios) add_panel(s, methods, n, true, others ? 0.64 : 1);
  if (others) add_panel(s, methods, n, false, ratios ? 0.36 : 1);
}
