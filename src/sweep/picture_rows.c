/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/picture_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "run/z_scores.h"
#include "sweep/grid_view.h"

enum { LINE_POINTS = 25 };

bool gg_sweep_list_has(const char *list, const char *word)
{
  const size_t length = strlen(word);
  for (const char *at = list; (at = strstr(at, word)); at++)
    if ((at == list || at[-1] == ',') && (at[length] == ',' || !at[length])) return true;
  return false;
}

double gg_sweep_axis_value(const gg_sweep *sweep, size_t point, const gg_picture_axis *a)
{
  const gg_varied *v = &sweep->varied[a->varied];
  const char *text = v->value[gg_sweep_row(sweep, point, a->varied) * v->n_keys + a->k];
  char *end;
  double x = strtod(text, &end);
  return *end || end == text || !isfinite(x) ? NAN : x;
}

/* The ends of the axis, on a logarithmic one above 0; false: there is nothing between them. */
static bool find_ends(const gg_sweep *s, const gg_picture_axis *a, double end[2])
{
  end[0] = INFINITY, end[1] = -INFINITY;
  for (size_t i = 0; i < s->n; i++) {
    const double x = gg_sweep_axis_value(s, i, a);
    if (a->log && !(x > 0)) continue;
    end[0] = fmin(end[0], x), end[1] = fmax(end[1], x);
  }
  return end[0] < end[1];
}

/* The values of the axis; keys that stand beside it have one value each. */
static bool fill_values(gg_varied *to, const gg_varied *from, const gg_picture_axis *a, const double end[2])
{
  char text[32];
  const double step = (a->log ? log(end[1] / end[0]) : end[1] - end[0]) / (LINE_POINTS - 1);
  bool whole = true;
  for (size_t i = 0; i < to->n; i++) {
    const double along = (double)i * step;
    snprintf(text, sizeof text, "%.9g", a->log ? end[0] * exp(along) : end[0] + along);
    for (size_t k = 0; k < to->n_keys; k++) {
      char **value = &to->value[i * to->n_keys + k];
      whole &= (*value = strdup(k == a->k ? text : from->value[k])) != NULL;
    }
  }
  return whole;
}

void gg_sweep_lines_free(gg_sweep *lines, const gg_picture_axis *a)
{
  if (!lines) return;
  gg_varied *v = &lines->varied[a->varied];
  for (size_t i = 0; v->value && i < v->n * v->n_keys; i++) free(v->value[i]);
  free(v->value);
  free(lines->point);
  free(lines);
}

/* A key that takes whole numbers alone has none between them, and theories do not depend on it. */
gg_status gg_sweep_lines_make(const gg_sweep *sweep, const gg_picture_axis *a, gg_sweep **made, gg_error *err)
{
  double end[2];
  gg_error none;
  *made = NULL;
  if (!a->alone || sweep->settings.does == GG_DOES_RUN || !find_ends(sweep, a, end)) return GG_OK;
  gg_sweep *lines = gg_base_array_new(1, sizeof *lines, err);
  if (!lines) return GG_FAILED;
  memcpy(lines, sweep, sizeof *lines);
  gg_base_busy_init(&lines->busy, "sweep", NULL, lines);
  lines->settings.does = GG_DOES_THEORY;
  lines->n = 0, lines->point = NULL;
  gg_varied *v = &lines->varied[a->varied];
  v->n = LINE_POINTS;
  v->value = gg_base_array_new(v->n * v->n_keys, sizeof *v->value, err);
  const bool whole = v->value && fill_values(v, &sweep->varied[a->varied], a, end);
  if (whole && gg_sweep_check_points(lines, &none) == GG_OK) {
    *made = lines;
    return GG_OK;
  }
  gg_sweep_lines_free(lines, a);
  return whole ? GG_OK : gg_base_out_of_memory(err);
}

static gg_status add(gg_picture_rows *rows, const gg_picture_row *row, gg_error *err)
{
  if (rows->n == rows->room) {
    const size_t room = 2 * rows->room + 256;
    gg_picture_row *grown = realloc(rows->row, room * sizeof *grown);
    if (!grown) return gg_base_out_of_memory(err);
    rows->row = grown, rows->room = room;
  }
  rows->row[rows->n++] = *row;
  return GG_OK;
}

/* The first point of the sweep with the same values of the other keys, also of a point of its lines. */
static size_t combination_of(const gg_picture_choice *c, const gg_sweep *sweep, size_t i)
{
  size_t number = 0;
  for (size_t f = 0; f < sweep->n_varied; f++)
    number = number * (f == c->axis.varied ? c->axis.n : sweep->varied[f].n) +
             (f == c->axis.varied ? 0 : gg_sweep_row(sweep, i, f));
  return number;
}

static const char *unit_of(const gg_point_row *row)
{
  return row->unit ? row->unit : "";
}

/* Against the method that the picture is relative to; false: it has no number there. */
static bool relate(gg_picture_row *row, const gg_point_row *reference)
{
  if (!reference || strcmp(unit_of(reference), row->unit) != 0) return false;
  const gg_estimate mean = {.mean = row->mean, .error = strcmp(reference->method, row->method) ? row->error : NAN},
                    of = {.mean = reference->mean, .error = isfinite(reference->error) ? reference->error : 0};
  const gg_departure d = gg_run_reference_deviation(gg_common_quantity_find(row->quantity), &mean, &of);
  row->mean = d.difference, row->error = d.error;
  row->share = d.deviation, row->share_error = d.deviation_error;
  return true;
}

/* A row of the table, if the picture has it. */
static gg_status add_row(gg_picture_rows *rows, const gg_grid_view *v, const gg_point_row *from,
                         const gg_picture_choice *c, gg_error *err)
{
  gg_picture_row row = {.method = from->method,
                        .quantity = from->quantity,
                        .unit = unit_of(from),
                        .point = from->point,
                        .combination = combination_of(c, v->sweep, from->point),
                        .x = gg_sweep_axis_value(v->sweep, from->point, &c->axis),
                        .mean = from->mean,
                        .error = from->error,
                        .theory = from->theory,
                        .steady = from->steady};
  if (c->relative_to && !relate(&row, gg_sweep_grid_row(v, row.point, c->relative_to, row.quantity))) return GG_OK;
  return add(rows, &row, err);
}

static bool is_chosen(const gg_point_row *row, const gg_picture_choice *c, const char *quantities)
{
  const bool reference = c->relative_to && strcmp(c->relative_to, row->method) == 0;
  return gg_sweep_list_has(quantities, row->quantity) &&
         (!row->theory || !c->theories || reference || gg_sweep_list_has(c->theories, row->method));
}

static bool is_first(const gg_picture_rows *rows, size_t i)
{
  const gg_picture_row *row = &rows->row[i];
  for (size_t k = 0; k < i; k++) {
    const gg_picture_row *one = &rows->row[k];
    if (one->combination == row->combination && strcmp(one->method, row->method) == 0 &&
        strcmp(one->quantity, row->quantity) == 0 && strcmp(one->unit, row->unit) == 0)
      return false;
  }
  return true;
}

/* What a theory says between the points where row i has it; where it has no answer its line is broken. */
static gg_status add_line(gg_picture_rows *rows, size_t i, const gg_grid_view *lines, const gg_picture_choice *c,
                          gg_error *err)
{
  for (size_t p = 0; p < lines->sweep->n; p++) {
    gg_picture_row row = rows->row[i];
    if (combination_of(c, lines->sweep, p) != row.combination) continue;
    const gg_point_row *found = gg_sweep_grid_row(lines, p, row.method, row.quantity);
    row.x = gg_sweep_axis_value(lines->sweep, p, &c->axis), row.mean = row.share = NAN;
    if (!found)
      GG_TRY(add(rows, &row, err));
    else if (strcmp(unit_of(found), row.unit) == 0)
      GG_TRY(add_row(rows, lines, found, c, err));
  }
  return GG_OK;
}

static gg_status add_lines(gg_picture_rows *rows, const gg_picture_lines *lines, const gg_picture_choice *c,
                           gg_error *err)
{
  gg_grid_view view;
  const size_t own = rows->n;
  GG_TRY(gg_sweep_grid_view_make(&view, &lines->table, lines->sweep, err));
  gg_status status = GG_OK;
  for (size_t i = 0; i < own && status == GG_OK; i++)
    if (rows->row[i].theory && is_first(rows, i)) status = add_line(rows, i, &view, c, err);
  gg_sweep_grid_view_clear(&view);
  return status;
}

gg_status gg_sweep_picture_rows_make(gg_picture_rows *rows, const gg_point_table *t, const gg_sweep *sweep,
                                     const gg_picture_choice *c, const char *quantities, gg_error *err)
{
  gg_grid_view view;
  gg_status status = gg_sweep_grid_view_make(&view, t, sweep, err);
  for (size_t i = 0; i < t->n && status == GG_OK; i++)
    if (is_chosen(&t->row[i], c, quantities)) status = add_row(rows, &view, &t->row[i], c, err);
  gg_sweep_grid_view_clear(&view);
  return status == GG_OK && c->lines ? add_lines(rows, c->lines, c, err) : status;
}
