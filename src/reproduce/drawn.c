/* Lines of a panel: which there are, whose points they take, and the points put into them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "reproduce/panel.h"

static const char *const engines[] = {"md", "dsmc"};

gg_drawn *gg_reproduce_panel_add(gg_drawn_panel *p, const char *method, const char *group, gg_chart_style style)
{
  for (size_t i = 0; i < p->n; i++) {
    gg_drawn *d = &p->drawn[i];
    if (strcmp(d->method, method) == 0 && strcmp(d->group, group) == 0 && style == GG_CHART_POINTS) return d;
  }
  gg_drawn *more = realloc(p->drawn, (p->n + 1) * sizeof *more);
  if (!more) return NULL;
  p->drawn = more;
  gg_drawn *d = &more[p->n++];
  *d = (gg_drawn){.style = style};
  snprintf(d->method, sizeof d->method, "%s", method);
  snprintf(d->group, sizeof d->group, "%s", group);
  return d;
}

gg_status gg_reproduce_drawn_put(gg_drawn *d, double x, double x_error, double y, double error, gg_error *err)
{
  if (d && d->n == d->room) {
    size_t room = d->room ? 2 * d->room : 32;
    double **all[] = {&d->x, &d->y, &d->error, &d->x_error};
    for (int k = 0; k < 4; k++) {
      double *more = realloc(*all[k], room * sizeof *more);
      if (!more) return gg_base_out_of_memory(err);
      *all[k] = more;
    }
    d->room = room;
  }
  if (!d) return gg_base_out_of_memory(err);
  d->x[d->n] = x, d->x_error[d->n] = x_error, d->y[d->n] = y, d->error[d->n++] = error;
  return GG_OK;
}

static void swap(double *a, double *b)
{
  double c = *a;
  *a = *b, *b = c;
}

void gg_reproduce_drawn_sort(gg_drawn *d)
{
  for (size_t i = 1; i < d->n; i++)
    for (size_t k = i; k > 0 && d->x[k] < d->x[k - 1]; k--) {
      swap(&d->x[k], &d->x[k - 1]), swap(&d->y[k], &d->y[k - 1]);
      swap(&d->error[k], &d->error[k - 1]), swap(&d->x_error[k], &d->x_error[k - 1]);
    }
}

bool gg_reproduce_panel_takes(const gg_figure_panel *of, const gg_figure_point *point)
{
  return gg_reproduce_figure_point_of(point, &of->of) && gg_reproduce_scene_meets(&point->scene, &of->where);
}

bool gg_reproduce_panel_engine(const gg_figure_panel *of, const gg_figure_point *point, int engine)
{
  if (!point->stored.engine[engine].document) return false;
  for (int i = 0; i < of->engines.n; i++)
    if (strcmp(of->engines.text[i], engines[engine]) == 0) return true;
  return of->engines.n == 0;
}

/* "m_1/m_2 = 10": the value itself, or what `as` makes of it. */
static void line_text(const gg_figure_panel *of, const gg_figure_point *point, int k, char *text, size_t size)
{
  const char *key = of->lines.text[k];
  char label[64], value[64];
  if (of->line_labels.n)
    snprintf(label, sizeof label, "%s", of->line_labels.text[k]);
  else
    gg_plot_chart_key(key, label, sizeof label, NULL);
  gg_reproduce_key_text(&point->scene, key, value, sizeof value);
  if (of->line_as.n) {
    double v = gg_reproduce_key_number(&point->scene, key);
    snprintf(value, sizeof value, "%.6g", gg_reproduce_expression_value(&of->line_as, (gg_variables){.v = v}));
  }
  if (strcmp(value, "inf") == 0) snprintf(value, sizeof value, "∞");
  snprintf(text, size, *label ? "%s = %s" : "%s%s", label, value);
}

void gg_reproduce_panel_group(const gg_figure_panel *of, const gg_figure_point *point, const char *name, char *text,
                              size_t size)
{
  char line[128];
  size_t used = (size_t)snprintf(text, size, "%s", of->source.names.n > 1 ? name : "");
  for (int k = 0; k < of->lines.n && used < size; k++) {
    line_text(of, point, k, line, sizeof line);
    used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", line);
  }
}

double gg_reproduce_panel_x(const gg_figure_panel *of, double raw)
{
  return of->x.as.n ? gg_reproduce_expression_value(&of->x.as, (gg_variables){.x = raw}) : raw;
}
