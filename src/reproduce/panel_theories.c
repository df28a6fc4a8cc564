/* Theories as lines, and lines drawn by a formula. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "reproduce/panel.h"
#include "scene/scene_reader.h"

enum { FINE = 33 };

/* What a theory's line asks at each of its values of x. */
typedef struct line {
  gg_drawn_panel *panel;
  const gg_figure_points *all;
  const char *theory, *name;
  const char *group;
  double ends[2]; /* of the key */
  const gg_figure_point *first;
  bool solved;   /* numerically: it stays at the points */
  bool sections; /* other keys change with this one */
} line;

static gg_asked asked_of(const line *l)
{
  return (gg_asked){
      .points = l->all, .source = &l->panel->of->source, .name = l->name, .engine = -1, .theory = l->theory};
}

/* Do the points of the line differ in the key alone? */
static bool differ_in(const gg_figure_point *a, const gg_figure_point *b, const char *key)
{
  gg_scene other = a->scene;
  char text[256];
  gg_reproduce_key_text(&b->scene, key, text, sizeof text);
  if (gg_scene_override(&other, key, text, NULL) != GG_OK) return false;
  for (size_t k = 0; k < a->n_varied; k++) {
    char of_a[512], of_b[512];
    gg_reproduce_key_text(&other, a->varied[k], of_a, sizeof of_a);
    gg_reproduce_key_text(&b->scene, a->varied[k], of_b, sizeof of_b);
    if (strcmp(of_a, of_b) != 0) return false;
  }
  return true;
}

static gg_status at_points(line *l, gg_drawn *d, gg_error *err)
{
  const gg_figure_panel *of = l->panel->of;
  char group[128], symbol[64];
  gg_asked asked = asked_of(l);
  for (size_t i = 0; i < l->all->n; i++) {
    const gg_figure_point *p = &l->all->point[i];
    if (!gg_reproduce_panel_takes(of, p)) continue;
    gg_common_quantity_symbol(gg_common_quantity_find(l->name), symbol, sizeof symbol);
    gg_reproduce_panel_group(of, p, symbol, group, sizeof group);
    if (strcmp(group, l->group) != 0) continue;
    double key = gg_reproduce_key_number(&p->scene, of->key), x = gg_reproduce_panel_x(of, key);
    gg_told y = gg_reproduce_figure_value(&asked, p, x);
    l->solved |= y.error > 0;
    if (!l->first) l->first = p;
    l->sections |= !differ_in(l->first, p, of->key);
    if (isfinite(key)) l->ends[0] = fmin(l->ends[0], key), l->ends[1] = fmax(l->ends[1], key);
    if (isfinite(x) && isfinite(y.mean))
      GG_TRY(gg_reproduce_drawn_put(d, x, NAN, y.mean, y.error > 0 ? y.error : NAN, err));
  }
  return GG_OK;
}

static double between(const line *l, int i)
{
  const gg_figure_panel *of = l->panel->of;
  double u = (double)i / (FINE - 1);
  if (of->x.log && l->ends[0] > 0) return l->ends[0] * pow(l->ends[1] / l->ends[0], u);
  return l->ends[0] + u * (l->ends[1] - l->ends[0]);
}

/* A closed form costs nothing: smooth, or where the entry says. */
static gg_status finely(line *l, gg_drawn *d, gg_error *err)
{
  const gg_figure_panel *of = l->panel->of;
  gg_asked asked = asked_of(l);
  int n = of->theories_over.n ? of->theories_over.n : FINE;
  bool listed = of->theories_over.n > 0;
  if (!l->first || l->sections || (l->solved && !listed) || !(listed || l->ends[0] < l->ends[1])) return GG_OK;
  d->n = 0;
  asked.key = of->key;
  for (int i = 0; i < n; i++) {
    asked.at = listed ? strtod(of->theories_over.text[i], NULL) : between(l, i);
    double x = gg_reproduce_panel_x(of, asked.at);
    gg_told y = gg_reproduce_figure_value(&asked, l->first, x);
    if (isfinite(y.mean)) GG_TRY(gg_reproduce_drawn_put(d, x, NAN, y.mean, y.error > 0 ? y.error : NAN, err));
  }
  return GG_OK;
}

static gg_status draw_line(gg_drawn_panel *p, const gg_figure_points *all, const char *theory, const char *name,
                           const char *group, gg_error *err)
{
  const bool solved =
      strncmp(theory, "enskog_hermite", strlen("enskog_hermite")) == 0; /* also where it tells no error */
  line l = {.solved = solved,
            .panel = p,
            .all = all,
            .theory = theory,
            .name = name,
            .group = group,
            .ends = {INFINITY, -INFINITY}};
  gg_drawn *d = gg_reproduce_panel_add(p, theory, group, GG_CHART_LINE);
  if (!d) return gg_base_out_of_memory(err);
  GG_TRY(at_points(&l, d, err));
  GG_TRY(finely(&l, d, err));
  gg_reproduce_drawn_sort(d);
  return GG_OK;
}

/* Every group of the panel once, in the order of its points. */
static gg_status groups(gg_drawn_panel *p, const gg_figure_points *all, const char *theory, const char *name,
                        gg_error *err)
{
  char group[128], symbol[64];
  for (size_t i = 0; i < all->n; i++) {
    if (!gg_reproduce_panel_takes(p->of, &all->point[i])) continue;
    gg_common_quantity_symbol(gg_common_quantity_find(name), symbol, sizeof symbol);
    gg_reproduce_panel_group(p->of, &all->point[i], symbol, group, sizeof group);
    bool drawn = false;
    for (size_t k = 0; k < p->n; k++)
      drawn |= strcmp(p->drawn[k].method, theory) == 0 && strcmp(p->drawn[k].group, group) == 0;
    if (!drawn) GG_TRY(draw_line(p, all, theory, name, group, err));
  }
  return GG_OK;
}

gg_status gg_reproduce_panel_theories(gg_drawn_panel *p, const gg_figure_points *all, gg_error *err)
{
  for (int t = 0; t < p->of->theories.n; t++)
    for (int i = 0; i < p->of->source.names.n; i++)
      GG_TRY(groups(p, all, p->of->theories.text[t], p->of->source.names.text[i], err));
  return GG_OK;
}

/* From end to end of the axis, or of what is drawn. */
gg_status gg_reproduce_panel_guides(gg_drawn_panel *p, gg_error *err)
{
  double from = p->of->x.from, to = p->of->x.to;
  if (!(from < to)) {
    from = INFINITY, to = -INFINITY;
    for (size_t i = 0; i < p->n; i++)
      for (size_t k = 0; k < p->drawn[i].n; k++) from = fmin(from, p->drawn[i].x[k]), to = fmax(to, p->drawn[i].x[k]);
  }
  for (int g = 0; g < p->of->n_guides && from < to; g++) {
    gg_drawn *d = gg_reproduce_panel_add(p, p->of->guide[g].label, "", GG_CHART_LINE);
    for (int i = 0; i < FINE; i++) {
      double u = (double)i / (FINE - 1),
             x = p->of->x.log && from > 0 ? from * pow(to / from, u) : from + u * (to - from);
      double y = gg_reproduce_expression_value(&p->of->guide[g].as, (gg_variables){.x = x});
      if (isfinite(y)) GG_TRY(gg_reproduce_drawn_put(d, x, NAN, y, NAN, err));
    }
  }
  return GG_OK;
}
