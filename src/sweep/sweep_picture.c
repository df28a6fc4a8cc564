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
#include "sweep/picture_rows.h"

enum { MOST_PANELS = 6, MOST_SERIES = 64 };

/* All of the panels' numbers, each series a stretch of them. */
typedef struct drawing {
  const gg_point_table *table;
  const gg_sweep *sweep;
  const gg_picture_choice *choice;
  gg_picture_rows rows;
  double *x, *y, *error; /* room for every row */
  bool *open;
  size_t used;
  gg_chart_series series[MOST_PANELS][MOST_SERIES];
  size_t combination[MOST_PANELS][MOST_SERIES]; /* what tells series apart; names are for the legend */
  char group[MOST_PANELS][MOST_SERIES][GG_COMBINATION_NAME];
  gg_chart_panel panel[MOST_PANELS];
  char quantity[MOST_PANELS][64], label[MOST_PANELS][200], x_label[96], title[240], note[400];
  const char *unit[MOST_PANELS]; /* of its numbers: phi = 0 has other units than phi > 0 */
  bool share[MOST_PANELS];       /* deviations over the method that the picture is relative to */
  size_t n;
} drawing;

static bool has_numbers(const gg_sweep *sweep, const gg_picture_axis *a)
{
  for (size_t i = 0; i < sweep->n; i++)
    if (isnan(gg_sweep_axis_value(sweep, i, a))) return false;
  return true;
}

/* Rows and random draws: other keys may change with that of the axis, from one scene to an unrelated one. */
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
        return gg_base_fail(err, GG_BAD_INPUT, "'%.60s' has values that are not numbers and cannot be an axis", over);
      if (meant) most = s->varied[f].n, *axis = a;
      if (meant && over) return GG_OK;
    }
  if (over) return gg_base_fail(err, GG_BAD_INPUT, "'%.60s' is not a key that this sweep varies", over);
  return most > 0
             ? GG_OK
             : gg_base_fail(err, GG_FAILED,
                            "no varied key has numbers, which a picture's axis needs (picture none: the tables alone)");
}

gg_status gg_sweep_axis_choose(const gg_sweep *sweep, const char *over, const char *log, gg_picture_axis *axis,
                               gg_error *err)
{
  if (log && !gg_sweep_list_has("x,y,xy,none", log))
    return gg_base_fail(err, GG_BAD_INPUT, "'%.20s' is not a choice of logarithmic axes; allowed: x, y, xy, none", log);
  GG_TRY(find_key(sweep, over, axis, err));
  axis->alone = is_alone(sweep, axis);
  axis->log = log && *log == 'x';
  return GG_OK;
}

static bool has_rows(const gg_point_table *t, const char *quantity)
{
  for (size_t i = 0; i < t->n; i++)
    if (strcmp(t->row[i].quantity, quantity) == 0) return true;
  return false;
}

static bool has_method(const gg_point_table *t, const char *method)
{
  for (size_t i = 0; i < t->n; i++)
    if (strcmp(t->row[i].method, method) == 0) return true;
  return false;
}

static const char *unit_of(const gg_point_row *row)
{
  return row->unit ? row->unit : "";
}

/* Is this a row of panel p? */
static bool belongs(const drawing *d, size_t p, const char *quantity, const char *unit)
{
  return strcmp(quantity, d->quantity[p]) == 0 && strcmp(unit, d->unit[p]) == 0;
}

static bool is_shown(const drawing *d, const gg_point_row *row)
{
  for (size_t p = 0; p < d->n; p++)
    if (belongs(d, p, row->quantity, unit_of(row))) return true;
  return false;
}

/* A panel for each unit that the quantity has at some point. */
static gg_status add_panels(drawing *d, const char *quantity, gg_error *err)
{
  if (!has_rows(d->table, quantity))
    return gg_base_fail(err, GG_BAD_INPUT, "no point has a quantity '%.60s'", quantity);
  for (size_t i = 0; i < d->table->n; i++) {
    const gg_point_row *row = &d->table->row[i];
    if (strcmp(row->quantity, quantity) != 0 || is_shown(d, row)) continue;
    if (d->n == MOST_PANELS)
      return gg_base_fail(err, GG_BAD_INPUT, "a picture has at most %d panels, one for each quantity and unit",
                          MOST_PANELS);
    snprintf(d->quantity[d->n], sizeof d->quantity[0], "%s", quantity);
    d->unit[d->n++] = unit_of(row);
  }
  return GG_OK;
}

static gg_status add_named(drawing *d, const char *show, gg_error *err)
{
  while (*show) {
    char word[64];
    size_t length = strcspn(show, ",");
    snprintf(word, sizeof word, "%.*s", (int)length, show);
    GG_TRY(add_panels(d, word, err));
    show += length + (show[length] == ',');
  }
  return GG_OK;
}

/* The headline quantities of the first scene; else, of theories alone, whatever comes first. */
static gg_status choose_quantities(drawing *d, gg_error *err)
{
  gg_scene scene;
  gg_model model;
  gg_quantity headline[GG_N_QUANTITIES];
  GG_TRY(gg_sweep_resolve(d->sweep, 0, &scene, err));
  GG_TRY(gg_common_model_for_theories(&scene, &model, err));
  int n = gg_run_headline_quantities(&model, headline);
  for (int i = 0; i < n && d->n < 4; i++) {
    const char *name = gg_common_quantity_name_in(&model, headline[i]);
    if (has_rows(d->table, name)) GG_TRY(add_panels(d, name, err));
  }
  return d->n || !d->table->n ? GG_OK : add_panels(d, d->table->row[0].quantity, err);
}

static gg_chart_series *series_for(drawing *d, size_t p, const gg_picture_row *row)
{
  const size_t n = d->panel[p].n;
  for (size_t k = 0; k < n; k++)
    if (d->combination[p][k] == row->combination && strcmp(d->series[p][k].method, row->method) == 0)
      return &d->series[p][k];
  if (n == MOST_SERIES) return NULL;
  d->panel[p].n++;
  d->combination[p][n] = row->combination;
  gg_sweep_line_group_name(d->sweep, row->combination, d->choice->axis.varied, d->group[p][n]);
  d->series[p][n] = (gg_chart_series){.method = row->method,
                                      .group = *d->group[p][n] ? d->group[p][n] : NULL,
                                      .style = row->theory && d->choice->axis.alone ? GG_CHART_LINE : GG_CHART_POINTS};
  return &d->series[p][n];
}

static gg_status count_rows(drawing *d, size_t p, gg_error *err)
{
  for (size_t i = 0; i < d->rows.n; i++) {
    const gg_picture_row *row = &d->rows.row[i];
    if (!belongs(d, p, row->quantity, row->unit)) continue;
    gg_chart_series *s = series_for(d, p, row);
    if (!s)
      return gg_base_fail(err, GG_FAILED,
                          "the picture would have more than %d lines: another key over, fewer values, or none",
                          MOST_SERIES);
    s->n++;
    d->share[p] |= isfinite(row->share) && d->choice->relative_to;
  }
  return GG_OK;
}

/* Each series has its stretch, counted before. */
static void fill_panel(drawing *d, size_t p)
{
  for (size_t k = 0; k < d->panel[p].n; k++) {
    gg_chart_series *s = &d->series[p][k];
    s->x = d->x + d->used, s->y = d->y + d->used, s->error = d->error + d->used, s->open = d->open + d->used;
    d->used += s->n;
    s->n = 0;
  }
  for (size_t i = 0; i < d->rows.n; i++) {
    const gg_picture_row *row = &d->rows.row[i];
    if (!belongs(d, p, row->quantity, row->unit)) continue;
    gg_chart_series *s = series_for(d, p, row);
    const size_t at = (size_t)(s->x - d->x) + s->n++;
    d->x[at] = row->x;
    d->y[at] = d->share[p] ? 100 * row->share : row->mean;
    d->error[at] = d->share[p] ? 100 * row->share_error : row->error;
    d->open[at] = !row->steady;
  }
}

static int by_x(const void *a, const void *b)
{
  const gg_picture_row *one = a, *two = b;
  return one->x < two->x ? -1 : one->x > two->x ? 1 : one->point < two->point ? -1 : one->point > two->point;
}

/* Of positive numbers, more than a decade and a half. */
static bool spans_decades(const gg_chart_panel *p)
{
  double least = INFINITY, most = 0;
  for (size_t k = 0; k < p->n; k++)
    for (size_t i = 0; i < p->series[k].n; i++) {
      const double y = p->series[k].y[i];
      if (isfinite(y)) least = fmin(least, y), most = fmax(most, y);
    }
  return least > 0 && most > 30 * least;
}

static bool is_log_y(const drawing *d, const gg_chart_panel *p)
{
  const char *log = d->choice->log;
  return log ? strchr(log, 'y') != NULL : !d->choice->relative_to && spans_decades(p);
}

static void name_y(drawing *d, size_t p)
{
  char symbol[64], method[96];
  const gg_quantity q = gg_common_quantity_find(d->quantity[p]);
  if (q < GG_N_QUANTITIES)
    gg_common_quantity_enhanced(q, symbol, sizeof symbol);
  else
    snprintf(symbol, sizeof symbol, "%s", d->quantity[p]);
  gg_plot_method_name(d->choice->relative_to ? d->choice->relative_to : "", method, sizeof method);
  if (d->choice->relative_to)
    snprintf(d->label[p], sizeof d->label[p], "%s %s %s%s", symbol, d->share[p] ? "/" : "–", method,
             d->share[p] ? " – 1" : "");
  else
    snprintf(d->label[p], sizeof d->label[p], "%s", symbol);
}

static gg_status fill(drawing *d, gg_error *err)
{
  const gg_picture_axis *a = &d->choice->axis;
  const char *x_unit;
  gg_plot_chart_key(d->sweep->varied[a->varied].key[a->k], d->x_label, sizeof d->x_label, &x_unit);
  for (size_t p = 0; p < d->n; p++) {
    gg_chart_panel *panel = &d->panel[p];
    *panel = (gg_chart_panel){.x = {.label = d->x_label, .unit = x_unit, .log = a->log}, .series = d->series[p]};
    GG_TRY(count_rows(d, p, err));
    fill_panel(d, p);
    name_y(d, p);
    panel->y = (gg_chart_axis){.label = d->label[p], .unit = d->share[p] ? "%" : d->unit[p]};
    panel->y.log = is_log_y(d, panel);
  }
  return GG_OK;
}

/* The scene without what is varied. */
static gg_status write_title(drawing *d, gg_error *err)
{
  gg_scene scene;
  char varied[400] = "";
  const char *key;
  GG_TRY(gg_sweep_resolve(d->sweep, 0, &scene, err));
  for (size_t k = 0; (key = gg_sweep_key(d->sweep, k)); k++) gg_base_text_append(varied, sizeof varied, "%s,", key);
  gg_files_scene_title(&scene, varied, d->title, sizeof d->title);
  return GG_OK;
}

/* Points with an engine that is not steady, by their numbers in the list, as many as a line has room for. */
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
  if (n) snprintf(d->note, sizeof d->note, "Open symbols: not steady, point%s %s", n > 1 ? "s" : "", list);
}

/* Words of a list that name no method of the table. */
static gg_status check_theories(const drawing *d, gg_error *err)
{
  char word[64];
  for (const char *at = d->choice->theories; at && *at;) {
    const size_t length = strcspn(at, ",");
    snprintf(word, sizeof word, "%.*s", (int)length, at);
    if (!has_method(d->table, word)) return gg_base_fail(err, GG_BAD_INPUT, "no point has a theory '%s'", word);
    at += length + (at[length] == ',');
  }
  return GG_OK;
}

static gg_status choose_names(drawing *d, gg_error *err)
{
  const gg_picture_choice *c = d->choice;
  GG_TRY(c->show ? add_named(d, c->show, err) : choose_quantities(d, err));
  GG_TRY(check_theories(d, err));
  if (c->relative_to && !has_method(d->table, c->relative_to))
    return gg_base_fail(err, GG_BAD_INPUT, "no point has a method '%.60s'", c->relative_to);
  return GG_OK;
}

gg_status gg_sweep_picture_check(const gg_point_table *t, const gg_sweep *sweep, const gg_picture_choice *choice,
                                 gg_error *err)
{
  drawing *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return GG_FAILED;
  d->table = t, d->sweep = sweep, d->choice = choice;
  gg_status status = choose_names(d, err);
  free(d);
  return status;
}

static gg_status choose_rows(drawing *d, gg_error *err)
{
  char quantities[MOST_PANELS * 65] = "";
  GG_TRY(choose_names(d, err));
  for (size_t p = 0; p < d->n; p++) gg_base_text_append(quantities, sizeof quantities, "%s,", d->quantity[p]);
  GG_TRY(gg_sweep_picture_rows_make(&d->rows, d->table, d->sweep, d->choice, quantities, err));
  qsort(d->rows.row, d->rows.n, sizeof *d->rows.row, by_x); /* lines go from left to right */
  return GG_OK;
}

static gg_status draw(drawing *d, const char *picture, const char *width, gg_error *err)
{
  GG_TRY(choose_rows(d, err));
  const size_t room = d->rows.n;
  d->x = gg_base_array_new(room, sizeof *d->x, err);
  d->y = gg_base_array_new(room, sizeof *d->y, err);
  d->error = gg_base_array_new(room, sizeof *d->error, err);
  d->open = gg_base_array_new(room, sizeof *d->open, err);
  if (!d->x || !d->y || !d->error || !d->open) return GG_FAILED;
  GG_TRY(fill(d, err));
  GG_TRY(write_title(d, err));
  write_note(d);
  const gg_chart chart = {.title = d->title, .note = d->note, .n = d->n, .panel = d->panel};
  return gg_plot_chart_draw(&chart, picture, width, err);
}

gg_status gg_sweep_point_table_draw(const gg_point_table *t, const gg_sweep *sweep, const gg_picture_choice *choice,
                                    const char *picture, const char *width, gg_error *err)
{
  drawing *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return GG_FAILED;
  d->table = t, d->sweep = sweep, d->choice = choice;
  gg_status status = draw(d, picture, width, err);
  free(d->x);
  free(d->y);
  free(d->error);
  free(d->open);
  free(d->rows.row);
  free(d);
  return status;
}
