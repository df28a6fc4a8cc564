/* A figure as a picture. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "reproduce/figures.h"

bool gg_reproduce_figure_has(const gg_figure *f, bool snapshots)
{
  for (int i = 0; i < f->entry->n_panels; i++)
    if ((f->entry->panel[i].source.kind == GG_OF_SNAPSHOT) == snapshots) return true;
  return false;
}

/* Lines without a point are left out. */
static gg_status series_of(const gg_drawn_panel *p, gg_chart_panel *chart, gg_error *err)
{
  gg_chart_series *series = gg_base_array_new(p->n ? p->n : 1, sizeof *series, err);
  if (!series) return GG_FAILED;
  for (size_t i = 0; i < p->n; i++) {
    const gg_drawn *d = &p->drawn[i];
    if (!d->n) continue;
    series[chart->n++] = (gg_chart_series){.method = d->method,
                                           .group = *d->group ? d->group : NULL,
                                           .style = d->style,
                                           .n = d->n,
                                           .x = d->x,
                                           .y = d->y,
                                           .error = d->error,
                                           .x_error = d->style == GG_CHART_POINTS ? d->x_error : NULL};
  }
  chart->series = series;
  return GG_OK;
}

static gg_status panel_of(const gg_drawn_panel *p, gg_chart_panel *chart, gg_error *err)
{
  const gg_figure_panel *of = p->of;
  *chart = (gg_chart_panel){.title = of->title,
                            .x = {p->x_label, p->x_unit, of->x.log, of->x.from, of->x.to},
                            .y = {p->y_label, p->y_unit, of->y.log, of->y.from, of->y.to}};
  return series_of(p, chart, err);
}

gg_status gg_reproduce_figure_draw(const gg_figure *f, const gg_figure_points *points, const char *picture,
                                   gg_error *err)
{
  gg_chart_panel panels[GG_MOST_PANELS];
  char title[80];
  gg_chart chart = {.title = title, .panel = panels};
  gg_status status = GG_OK;
  if (!gg_reproduce_figure_has(f, false)) return gg_reproduce_figure_draw_snapshots(f, points, picture, err);
  snprintf(title, sizeof title, "%s%s", f->entry->figure, f->quick ? " (quick)" : "");
  for (int i = 0; i < f->entry->n_panels && status == GG_OK; i++) {
    if (f->entry->panel[i].source.kind == GG_OF_SNAPSHOT) continue;
    status = panel_of(&f->panel[i], &panels[chart.n++], err);
  }
  if (status == GG_OK) status = gg_plot_chart_draw(&chart, picture, NULL, err);
  for (size_t i = 0; i < chart.n; i++) free((void *)(uintptr_t)panels[i].series);
  return status;
}
