#include "reproduce/panel.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const char *const engines[] = {"md", "dsmc"};

/* A quantity's symbol, or the name of a curve as it is. */
static void name_text(const gg_source *s, const char *name, char *text, size_t size)
{
  if (s->kind == GG_OF_QUANTITY || s->kind == GG_OF_SERIES)
    gg_common_quantity_symbol(gg_common_quantity_find(name), text, size);
  else
    snprintf(text, size, "%s", name);
}

static gg_status points_of(gg_drawn_panel *p, const gg_figure_points *all, const gg_figure_point *point, int engine,
                           gg_error *err)
{
  const gg_figure_panel *of = p->of;
  char group[128], name[64];
  for (int i = 0; i < of->source.names.n; i++) {
    gg_asked asked = {.points = all, .source = &of->source, .name = of->source.names.text[i], .engine = engine};
    double raw = of->key ? gg_reproduce_key_number(&point->scene, of->key) : NAN, x_error = NAN;
    if (of->number) {
      gg_told over = gg_reproduce_figure_curve_number(point, engine, asked.name, of->number, (double[2]){0, 0});
      raw = over.mean, x_error = over.error;
      if (of->x.as.n) x_error *= fabs(gg_reproduce_expression_slope(&of->x.as, (gg_variables){.x = raw}, 'x'));
    }
    double x = gg_reproduce_panel_x(of, raw);
    gg_told y = gg_reproduce_figure_value(&asked, point, x);
    if (of->source.kind == GG_OF_NUMBER)
      gg_reproduce_panel_curve_text(&of->source, i, point, engine, name, sizeof name);
    else
      name_text(&of->source, asked.name, name, sizeof name);
    gg_reproduce_panel_group(of, point, of->number ? "" : name, group, sizeof group); /* one line over all its curves */
    if (y.unit && !*p->y_unit && !of->source.as.n && !of->source.relative_to.n && !of->source.relative_theory)
      snprintf(p->y_unit, sizeof p->y_unit, "%s", y.unit);
    if (!isfinite(y.mean) || !isfinite(x)) continue;
    gg_drawn *d = gg_reproduce_panel_add(p, engines[engine], group, GG_CHART_POINTS);
    GG_TRY(gg_reproduce_drawn_put(d, x, x_error, y.mean, y.error, err));
  }
  return GG_OK;
}

static gg_status over_points(gg_drawn_panel *p, const gg_figure_points *all, gg_error *err)
{
  for (int engine = 0; engine < 2; engine++)
    for (size_t i = 0; i < all->n; i++)
      if (gg_reproduce_panel_takes(p->of, &all->point[i]) && gg_reproduce_panel_engine(p->of, &all->point[i], engine))
        GG_TRY(points_of(p, all, &all->point[i], engine, err));
  for (size_t i = 0; i < p->n; i++) gg_reproduce_drawn_sort(&p->drawn[i]);
  return gg_reproduce_panel_theories(p, all, err);
}

static void label_axes(gg_drawn_panel *p)
{
  const gg_figure_panel *of = p->of;
  const char *unit = "";
  if (of->x.label)
    snprintf(p->x_label, sizeof p->x_label, "%s", of->x.label);
  else if (of->key) {
    gg_plot_chart_key(of->key, p->x_label, sizeof p->x_label, &unit);
    snprintf(p->x_unit, sizeof p->x_unit, "%s", unit ? unit : "");
  } else if (of->number)
    snprintf(p->x_label, sizeof p->x_label, "%s", of->number);
  if (of->y.label)
    snprintf(p->y_label, sizeof p->y_label, "%s", of->y.label);
  else if (!*p->y_label)
    name_text(&of->source, of->source.names.text[0], p->y_label, sizeof p->y_label);
  if (!of->y.label && of->source.kind == GG_OF_NUMBER) snprintf(p->y_label, sizeof p->y_label, "%s", of->source.number);
}

gg_status gg_reproduce_panel_make(gg_drawn_panel *p, const gg_figure_panel *of, const gg_figure_points *points,
                                  gg_error *err)
{
  gg_status status = GG_OK;
  *p = (gg_drawn_panel){.of = of};
  switch (of->source.kind) {
  case GG_OF_QUANTITY:
  case GG_OF_NUMBER: status = over_points(p, points, err); break;
  case GG_OF_CURVE: status = gg_reproduce_panel_curves(p, points, err); break;
  case GG_OF_SERIES: status = gg_reproduce_panel_series(p, points, err); break;
  case GG_OF_FRAMES: status = gg_reproduce_panel_frames(p, points, err); break;
  case GG_OF_SNAPSHOT: break;
  }
  if (status == GG_OK) status = gg_reproduce_panel_guides(p, err);
  label_axes(p);
  return status;
}

void gg_reproduce_panel_clear(gg_drawn_panel *p)
{
  for (size_t i = 0; i < p->n; i++) {
    free(p->drawn[i].x);
    free(p->drawn[i].y);
    free(p->drawn[i].error);
    free(p->drawn[i].x_error);
  }
  free(p->drawn);
  *p = (gg_drawn_panel){0};
}
