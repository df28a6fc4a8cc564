/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A picture of a sweep: quantities over one of its keys. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "common/engine.h"
#include "files/text_format.h"
#include "plot/chart.h"
#include "run/result.h"
#include "run/z_scores.h"
#include "scene/model_of_scene.h"
#include "sweep/grid_view.h"

enum { MOST_PANELS = 6 };

/* A panel for each quantity and unit: phi = 0 has other units than phi > 0. */
typedef struct panel {
  char quantity[64];
  const char *unit;
  bool share; /* the panel has relative deviations, in per cent */
  gg_chart_panel *of;
} panel;

typedef struct drawing {
  const gg_point_table *table;
  const gg_sweep *sweep;
  const gg_picture_choice *choice;
  size_t n;
  panel panel[MOST_PANELS];
  gg_chart *chart;
  bool crowded; /* there are more lines than a panel can have */
} drawing;

static bool is_listed(const char *list, const char *word)
{
  char other[64];
  while (gg_sweep_next_word(&list, other))
    if (strcmp(other, word) == 0) return true;
  return false;
}

static bool has_numbers(const gg_sweep *sweep, const gg_picture_axis *a)
{
  for (size_t i = 0; i < sweep->n; i++)
    if (isnan(gg_sweep_axis_value(sweep, i, a))) return false;
  return true;
}

/* True if no other key changes with that of the axis. In rows and random draws keys may, from one scene to an unrelated
 * one. */
static bool is_alone(const gg_sweep *sweep, const gg_picture_axis *a)
{
  const gg_varied *v = &sweep->varied[a->varied];
  for (size_t i = 1; i < v->n; i++)
    for (size_t k = 0; k < v->n_keys; k++)
      if (k != a->k && strcmp(v->value[i * v->n_keys + k], v->value[k]) != 0) return false;
  return true;
}

static gg_status find_key(const gg_sweep *s, const char *over, gg_picture_axis *axis, gg_error *err)
{
  size_t most = 0;
  for (size_t f = 0; f < s->n_varied; f++)
    for (size_t k = 0; k < s->varied[f].n_keys; k++) {
      const gg_picture_axis a = {.varied = f, .k = k, .n = s->varied[f].n};
      const bool meant = over ? strcmp(over, s->varied[f].key[k]) == 0 : s->varied[f].n > most && has_numbers(s, &a);
      if (meant && over && !has_numbers(s, &a))
        return GG_REFUSE(err, "'%.60s' has values that are not numbers and cannot be an axis", over);
      if (meant) most = s->varied[f].n, *axis = a;
      if (meant && over) return GG_OK;
    }
  if (over) return GG_REFUSE(err, "'%.60s' is not a key that this sweep varies", over);
  return most > 0
             ? GG_OK
             : gg_base_fail(err, GG_FAILED,
                            "no varied key has numbers, which a picture's axis needs (picture none: the tables alone)");
}

gg_status gg_sweep_axis_choose(const gg_sweep *sweep, const char *over, const char *log, gg_picture_axis *axis,
                               gg_error *err)
{
  if (log && !is_listed("x,y,xy,none", log))
    return GG_REFUSE(err, "'%.20s' is not a choice of logarithmic axes; allowed: x, y, xy, none", log);
  GG_TRY(find_key(sweep, over, axis, err));
  axis->alone = is_alone(sweep, axis);
  axis->log = log && *log == 'x';
  return GG_OK;
}

static const char *unit_of(const gg_point_row *row)
{
  return row->unit ? row->unit : "";
}

static panel *panel_of(drawing *d, const gg_point_row *row)
{
  size_t p = 0;
  while (p < d->n && (strcmp(d->panel[p].quantity, row->quantity) != 0 || strcmp(d->panel[p].unit, unit_of(row)) != 0))
    p++;
  return p < d->n ? &d->panel[p] : NULL;
}

static gg_status add_panels(drawing *d, const char *quantity, gg_error *err)
{
  if (!gg_sweep_point_table_has(d->table, NULL, quantity))
    return GG_REFUSE(err, "no point has a quantity '%.60s'", quantity);
  for (size_t i = 0; i < d->table->n; i++) {
    const gg_point_row *row = &d->table->row[i];
    if (strcmp(row->quantity, quantity) != 0 || panel_of(d, row)) continue;
    if (d->n == MOST_PANELS)
      return GG_REFUSE(err, "a picture has at most %d panels, one for each quantity and unit", MOST_PANELS);
    snprintf(d->panel[d->n].quantity, sizeof d->panel->quantity, "%s", quantity);
    d->panel[d->n++].unit = unit_of(row);
  }
  return GG_OK;
}

/* The headline quantities of the first scene; of theories alone the first quantity of the table. */
static gg_status add_default_panels(drawing *d, gg_error *err)
{
  gg_scene scene;
  gg_model model;
  gg_quantity headline[GG_N_QUANTITIES];
  GG_TRY(gg_sweep_resolve(d->sweep, 0, &scene, err));
  GG_TRY(gg_scene_model_for_theories(&scene, &model, err));
  const int n = gg_run_headline_quantities(&model, headline);
  for (int i = 0; i < n && d->n < 4; i++) {
    const char *name = gg_common_quantity_name_in(&model, headline[i]);
    if (gg_sweep_point_table_has(d->table, NULL, name)) GG_TRY(add_panels(d, name, err));
  }
  return d->n || !d->table->n ? GG_OK : add_panels(d, d->table->row[0].quantity, err);
}

static gg_status choose_names(drawing *d, gg_error *err)
{
  const gg_picture_choice *c = d->choice;
  const char *show = c->show, *theories = c->theories;
  char word[64];
  if (!show) GG_TRY(add_default_panels(d, err));
  while (gg_sweep_next_word(&show, word)) GG_TRY(add_panels(d, word, err));
  while (gg_sweep_next_word(&theories, word))
    if (!gg_sweep_point_table_has(d->table, word, NULL)) return GG_REFUSE(err, "no point has a theory '%s'", word);
  if (c->relative_to && !gg_sweep_point_table_has(d->table, c->relative_to, NULL))
    return GG_REFUSE(err, "no point has a method '%.60s'", c->relative_to);
  return GG_OK;
}

gg_status gg_sweep_picture_check(const gg_point_table *t, const gg_sweep *sweep, const gg_picture_choice *choice,
                                 gg_error *err)
{
  drawing d = {.table = t, .sweep = sweep, .choice = choice};
  return choose_names(&d, err);
}

/* Name of the line that a point belongs to: the other keys. Points of the sweep of lines have the same names. */
static void name_line(const drawing *d, const gg_sweep *sweep, size_t point, char name[GG_COMBINATION_NAME])
{
  const gg_picture_axis *a = &d->choice->axis;
  size_t first = 0;
  for (size_t f = 0; f < sweep->n_varied; f++)
    first = first * d->sweep->varied[f].n + (f == a->varied ? 0 : gg_sweep_row(sweep, point, f));
  gg_sweep_line_group_name(d->sweep, first, a->varied, name);
}

/* The series of a method and a line in a panel, a new one if there is none. NULL: there are too many. */
static gg_chart_series *series_of(drawing *d, panel *p, const gg_point_row *row, const char *name)
{
  for (size_t k = 0; k < p->of->n; k++) {
    gg_chart_series *s = p->of->series[k];
    if (strcmp(s->method, row->method) == 0 && strcmp(s->group ? s->group : "", name) == 0) return s;
  }
  const int style = row->theory && d->choice->axis.alone ? GG_CHART_LINE : GG_CHART_POINTS;
  d->crowded |= p->of->n == GG_CHART_SERIES;
  return gg_plot_panel_series(d->chart, p->of, row->method, *name ? gg_plot_chart_text(d->chart, "%s", name) : NULL,
                              style);
}

/* The value of a row, or its deviation from the method that the picture is relative to; false: that has no value. */
static bool find_value(const drawing *d, const gg_grid_view *v, const gg_point_row *row, gg_departure *value)
{
  const char *relative_to = d->choice->relative_to;
  *value = (gg_departure){.difference = row->mean, .error = row->error, .deviation = NAN, .deviation_error = NAN};
  if (!relative_to) return true;
  const gg_point_row *reference = gg_sweep_grid_row(v, row->point, relative_to, row->quantity);
  if (!reference || strcmp(unit_of(reference), unit_of(row)) != 0) return false;
  const gg_estimate mean = {.mean = row->mean, .error = strcmp(relative_to, row->method) ? row->error : NAN},
                    of = {.mean = reference->mean, .error = isfinite(reference->error) ? reference->error : 0};
  *value = gg_run_reference_deviation(gg_common_quantity_find(row->quantity), &mean, &of);
  return true;
}

static bool is_chosen(const drawing *d, const gg_point_row *row)
{
  const gg_picture_choice *c = d->choice;
  return !row->theory || !c->theories || is_listed(c->theories, row->method) ||
         (c->relative_to && strcmp(c->relative_to, row->method) == 0);
}

static void add_point(drawing *d, const gg_grid_view *v, panel *p, gg_chart_series *s, const gg_point_row *row)
{
  gg_departure value;
  if (!find_value(d, v, row, &value)) return;
  const double x = gg_sweep_axis_value(v->sweep, row->point, &d->choice->axis);
  gg_plot_chart_point(d->chart, s,
                      (gg_chart_point){x, p->share ? 100 * value.deviation : value.difference,
                                       p->share ? 100 * value.deviation_error : value.error, NAN, !row->steady});
}

static void add_rows(drawing *d, const gg_grid_view *v)
{
  char name[GG_COMBINATION_NAME];
  gg_departure value;
  for (size_t i = 0; i < d->table->n; i++) {
    panel *p = panel_of(d, &d->table->row[i]);
    if (p && d->choice->relative_to && is_chosen(d, &d->table->row[i]) && find_value(d, v, &d->table->row[i], &value))
      p->share |= isfinite(value.deviation);
  }
  for (size_t i = 0; i < d->table->n; i++) {
    const gg_point_row *row = &d->table->row[i];
    panel *p = panel_of(d, row);
    if (!p || !is_chosen(d, row) || !find_value(d, v, row, &value)) continue;
    name_line(d, d->sweep, row->point, name);
    add_point(d, v, p, series_of(d, p, row, name), row);
  }
}

/* Points of theories between those of the sweep. The line of a theory is broken where it has no answer. */
static void add_lines(drawing *d, const gg_grid_view *v)
{
  char name[GG_COMBINATION_NAME];
  for (size_t i = 0; i < v->sweep->n; i++) {
    name_line(d, v->sweep, i, name);
    for (panel *p = d->panel; p < d->panel + d->n; p++)
      for (size_t k = 0; k < p->of->n; k++) {
        gg_chart_series *s = p->of->series[k];
        if (s->look.style != GG_CHART_LINE || strcmp(s->group ? s->group : "", name) != 0) continue;
        const gg_point_row *row = gg_sweep_grid_row(v, i, s->method, p->quantity);
        if (!row)
          gg_plot_chart_point(
              d->chart, s, (gg_chart_point){gg_sweep_axis_value(v->sweep, i, &d->choice->axis), NAN, NAN, NAN, false});
        else if (strcmp(unit_of(row), p->unit) == 0)
          add_point(d, v, p, s, row);
      }
  }
}

static int by_x(const void *a, const void *b)
{
  const double x = ((const gg_chart_point *)a)->x, y = ((const gg_chart_point *)b)->x;
  return (x > y) - (x < y);
}

/* Lines go from left to right. The axis of y is logarithmic by choice, or for positive numbers over more than a decade
 * and a half. */
static void finish_panel(const drawing *d, gg_chart_panel *p)
{
  double least = INFINITY, most = 0;
  for (size_t k = 0; k < p->n; k++) {
    gg_chart_series *s = p->series[k];
    if (s->n) qsort(s->point, s->n, sizeof *s->point, by_x);
    for (size_t i = 0; i < s->n; i++)
      if (isfinite(s->point[i].y)) least = fmin(least, s->point[i].y), most = fmax(most, s->point[i].y);
  }
  const char *log = d->choice->log;
  p->y.log = log ? strchr(log, 'y') != NULL : !d->choice->relative_to && least > 0 && most > 30 * least;
}

static void label_panel(drawing *d, panel *p, const char *x_label, const char *x_unit)
{
  char symbol[64], method[96];
  const char *relative_to = d->choice->relative_to;
  const gg_quantity q = gg_common_quantity_find(p->quantity);
  if (q < GG_N_QUANTITIES)
    gg_common_quantity_enhanced(q, symbol, sizeof symbol);
  else
    snprintf(symbol, sizeof symbol, "%s", p->quantity);
  gg_plot_method_name(relative_to ? relative_to : "", method, sizeof method);
  p->of->x = (gg_chart_axis){.label = x_label, .unit = x_unit, .log = d->choice->axis.log};
  p->of->y.unit = p->share ? "%" : p->unit;
  p->of->y.label = !relative_to ? gg_plot_chart_text(d->chart, "%s", symbol)
                   : p->share   ? gg_plot_chart_text(d->chart, "%s / %s – 1", symbol, method)
                                : gg_plot_chart_text(d->chart, "%s – %s", symbol, method);
}

static gg_status fill(drawing *d, gg_error *err)
{
  const gg_picture_axis *a = &d->choice->axis;
  const gg_picture_lines *lines = d->choice->lines;
  const char *x_unit;
  char x_label[96];
  gg_grid_view view;
  gg_plot_chart_key(d->sweep->varied[a->varied].key[a->k], x_label, sizeof x_label, &x_unit);
  const char *x_name = gg_plot_chart_text(d->chart, "%s", x_label);
  for (size_t p = 0; p < d->n; p++)
    if (!(d->panel[p].of = gg_plot_chart_panel(d->chart))) return gg_base_out_of_memory(err);
  GG_TRY(gg_sweep_grid_view_make(&view, d->table, d->sweep, err));
  add_rows(d, &view);
  gg_sweep_grid_view_clear(&view);
  if (d->crowded)
    return gg_base_fail(err, GG_FAILED,
                        "the picture would have more than %d lines: another key over, fewer values, or none",
                        GG_CHART_SERIES);
  if (lines) {
    GG_TRY(gg_sweep_grid_view_make(&view, &lines->table, lines->sweep, err));
    add_lines(d, &view);
    gg_sweep_grid_view_clear(&view);
  }
  for (size_t p = 0; p < d->n; p++) label_panel(d, &d->panel[p], x_name, x_unit), finish_panel(d, d->panel[p].of);
  return GG_OK;
}

/* The scene without the varied keys. */
static gg_status write_title(drawing *d, gg_error *err)
{
  gg_scene scene;
  char varied[400] = "", title[240];
  const char *key;
  GG_TRY(gg_sweep_resolve(d->sweep, 0, &scene, err));
  for (size_t k = 0; (key = gg_sweep_column_key(d->sweep, k)); k++)
    gg_base_text_append(varied, sizeof varied, "%s,", key);
  gg_files_scene_title(&scene, varied, title, sizeof title);
  d->chart->title = gg_plot_chart_text(d->chart, "%s", title);
  return GG_OK;
}

/* The first points with an engine that is not steady, by their numbers in the list. */
static void write_note(drawing *d)
{
  enum { NAMED = 20 };
  size_t last = SIZE_MAX, n = 0;
  char list[300] = "";
  for (size_t i = 0; i < d->table->n; i++) {
    const gg_point_row *row = &d->table->row[i];
    if (row->steady || row->point == last) continue;
    if (n < NAMED) gg_base_text_append(list, sizeof list, "%s%zu", n ? ", " : "", row->point + 1);
    last = row->point, n++;
  }
  if (n > NAMED) gg_base_text_append(list, sizeof list, " and %zu more", n - NAMED);
  if (n) d->chart->note = gg_plot_chart_text(d->chart, "Open symbols: not steady, point%s %s", n > 1 ? "s" : "", list);
}

gg_status gg_sweep_point_table_draw(const gg_point_table *t, const gg_sweep *sweep, const gg_picture_choice *choice,
                                    const char *picture, const char *width, gg_error *err)
{
  gg_plot_paper paper;
  drawing d = {.table = t, .sweep = sweep, .choice = choice};
  GG_TRY(gg_plot_paper_choose(&paper, picture, NULL, width, err));
  GG_TRY(choose_names(&d, err));
  d.chart = gg_plot_chart_new();
  if (!d.chart) return gg_base_out_of_memory(err);
  gg_status status = fill(&d, err);
  if (status == GG_OK) status = write_title(&d, err);
  write_note(&d);
  if (status == GG_OK) return gg_plot_chart_finish(d.chart, &paper, picture, err);
  gg_plot_chart_free(d.chart);
  return status;
}
