/* Panels of whole curves, and of how quantities went in time. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "reproduce/panel.h"

enum { MOST_SERIES_POINTS = 100 };
static const char *const engines[] = {"md", "dsmc"};

static double item(const json_t *curve, const char *key, size_t i)
{
  const json_t *x = json_array_get(json_object_get(curve, key), i);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

static const char *text_of(const json_t *curve, const char *key)
{
  const char *text = json_string_value(json_object_get(curve, key));
  return text ? text : "";
}

/* Escaped: names of curves have underscores. */
static void plain(const char *name, char *text, size_t size)
{
  size_t used = 0;
  for (const char *c = name; *c && used + 2 < size; c++) {
    if (*c == '_') text[used++] = '\\';
    text[used++] = *c;
  }
  text[used] = '\0';
}

void gg_reproduce_panel_curve_text(const gg_source *source, int k, const gg_figure_point *point, int engine, char *text,
                                   size_t size)
{
  static const char *const told[] = {"label", "x_name"};
  for (int t = 0; t < 2; t++) {
    const char *mine = text_of(gg_reproduce_figure_curve(point, engine, source->names.text[k]), told[t]);
    bool alone = *mine;
    for (int i = 0; i < source->names.n; i++)
      if (i != k &&
          strcmp(mine, text_of(gg_reproduce_figure_curve(point, engine, source->names.text[i]), told[t])) == 0)
        alone = false;
    snprintf(text, size, "%s", mine);
    if (alone) return;
  }
  plain(source->names.text[k], text, size);
}

static gg_told transformed(const gg_figure_panel *of, double x, gg_told y)
{
  if (!of->source.as.n) return y;
  gg_variables at = {x, y.mean, 0, NAN};
  double slope = gg_reproduce_expression_slope(&of->source.as, at, 'y');
  return (gg_told){gg_reproduce_expression_value(&of->source.as, at), fabs(slope) * y.error, NULL};
}

/* Logarithms of what was never counted say nothing; nor does a point on a logarithmic axis known only to its own size.
 */
static bool is_shown(const gg_figure_panel *of, double x, gg_told raw, gg_told y)
{
  if (!isfinite(x) || !isfinite(y.mean)) return false;
  if (of->x.from < of->x.to && (x < of->x.from || x > of->x.to)) return false;
  bool empty = raw.mean == 0 && !isfinite(raw.error);
  return !empty && (!of->y.log || (y.mean > 0 && !(y.error > 0.67 * y.mean)));
}

static gg_status put_curve(gg_drawn *d, const gg_figure_panel *of, const json_t *curve, gg_error *err)
{
  size_t n = json_array_size(json_object_get(curve, "x")), each = (size_t)of->bins;
  for (size_t i = 0; i + each <= n; i += each) {
    double x = 0, mean = 0, variance = 0;
    for (size_t k = i; k < i + each; k++) {
      x += item(curve, "x", k) / (double)each;
      mean += item(curve, "value", k) / (double)each;
      variance += pow(item(curve, "stderr", k) / (double)each, 2);
    }
    gg_told raw = {mean, sqrt(variance), NULL}, y = transformed(of, gg_reproduce_panel_x(of, x), raw);
    x = gg_reproduce_panel_x(of, x);
    if (is_shown(of, x, raw, y)) GG_TRY(gg_reproduce_drawn_put(d, x, NAN, y.mean, y.error, err));
  }
  return GG_OK;
}

/* The law beside, once. */
static gg_status put_law(gg_drawn_panel *p, const json_t *curve, gg_error *err)
{
  const json_t *law = json_object_get(curve, "reference");
  const char *label = text_of(law, "label");
  if (!law || !p->of->source.beside) return GG_OK;
  for (size_t i = 0; i < p->n; i++)
    if (strcmp(p->drawn[i].method, label) == 0) return GG_OK;
  gg_drawn *d = gg_reproduce_panel_add(p, label, "", GG_CHART_LINE);
  size_t n = json_array_size(json_object_get(curve, "x"));
  for (size_t i = 0; i < n; i++) {
    double x = gg_reproduce_panel_x(p->of, item(curve, "x", i));
    gg_told y = transformed(p->of, x, (gg_told){item(law, "value", i), 0, NULL});
    bool in = !(p->of->y.from < p->of->y.to) || (y.mean >= p->of->y.from && y.mean <= p->of->y.to);
    if (in && is_shown(p->of, x, (gg_told){1, 0, NULL}, y)) GG_TRY(gg_reproduce_drawn_put(d, x, NAN, y.mean, NAN, err));
  }
  return GG_OK;
}

static gg_status curves_of(gg_drawn_panel *p, const gg_figure_point *point, int engine, gg_error *err)
{
  char group[128];
  for (int i = 0; i < p->of->source.names.n; i++) {
    const json_t *curve = gg_reproduce_figure_curve(point, engine, p->of->source.names.text[i]);
    if (!curve) continue;
    const char *label = text_of(curve, "label");
    gg_reproduce_panel_group(p->of, point, *label ? label : p->of->source.names.text[i], group, sizeof group);
    snprintf(p->y_label, sizeof p->y_label, "%s", text_of(curve, "y_name"));
    if (!p->of->source.as.n) snprintf(p->y_unit, sizeof p->y_unit, "%s", text_of(curve, "unit"));
    snprintf(p->x_label, sizeof p->x_label, "%s", text_of(curve, "x_name"));
    if (!p->of->x.as.n) snprintf(p->x_unit, sizeof p->x_unit, "%s", text_of(curve, "x_unit"));
    GG_TRY(put_curve(gg_reproduce_panel_add(p, engines[engine], group, GG_CHART_BAND), p->of, curve, err));
    GG_TRY(put_law(p, curve, err));
  }
  return GG_OK;
}

gg_status gg_reproduce_panel_curves(gg_drawn_panel *p, const gg_figure_points *all, gg_error *err)
{
  for (int engine = 0; engine < 2; engine++)
    for (size_t i = 0; i < all->n; i++)
      if (gg_reproduce_panel_takes(p->of, &all->point[i]) && gg_reproduce_panel_engine(p->of, &all->point[i], engine))
        GG_TRY(curves_of(p, &all->point[i], engine, err));
  return GG_OK;
}

static gg_status put_series(gg_drawn_panel *p, const gg_figure_point *point, int engine, const char *name,
                            gg_error *err)
{
  char group[128], symbol[64];
  const gg_stored_series *s = gg_files_stored_series_find(&point->stored.engine[engine], name);
  if (!s || !s->n) return GG_OK;
  gg_reproduce_panel_group(p->of, point,
                           gg_common_quantity_symbol(gg_common_quantity_find(name), symbol, sizeof symbol), group,
                           sizeof group);
  const char *unit = gg_reproduce_figure_quantity(point, engine, name).unit; /* that of its mean */
  if (unit && !*p->y_unit && !p->of->source.as.n) snprintf(p->y_unit, sizeof p->y_unit, "%s", unit);
  gg_drawn *d = gg_reproduce_panel_add(p, engines[engine], group, GG_CHART_BAND);
  size_t first = 0, last = s->n, step;
  double to = p->of->x.to > p->of->x.from ? p->of->x.to : INFINITY, from = p->of->x.to > 0 ? p->of->x.from : -INFINITY;
  while (first < last && gg_reproduce_panel_x(p->of, s->time[first]) < from) first++;
  while (last > first && gg_reproduce_panel_x(p->of, s->time[last - 1]) > to) last--;
  step = (last - first) / MOST_SERIES_POINTS + 1;
  for (size_t i = first; i < last; i += step) {
    double x = gg_reproduce_panel_x(p->of, s->time[i]);
    gg_told y = transformed(p->of, x, (gg_told){s->value[i], NAN, NULL});
    if (isfinite(y.mean)) GG_TRY(gg_reproduce_drawn_put(d, x, NAN, y.mean, NAN, err));
  }
  return GG_OK;
}

gg_status gg_reproduce_panel_series(gg_drawn_panel *p, const gg_figure_points *all, gg_error *err)
{
  snprintf(p->x_label, sizeof p->x_label, "time");
  for (int engine = 0; engine < 2; engine++)
    for (size_t i = 0; i < all->n; i++)
      for (int k = 0; k < p->of->source.names.n; k++)
        if (gg_reproduce_panel_takes(p->of, &all->point[i]) && gg_reproduce_panel_engine(p->of, &all->point[i], engine))
          GG_TRY(put_series(p, &all->point[i], engine, p->of->source.names.text[k], err));
  return GG_OK;
}
