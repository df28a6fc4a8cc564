/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/grid_view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "plot/chart.h"

/* The key of that name, or with NULL the first key of the group with most rows; never a key of the group `but`. */
static gg_grid_key find_key(const gg_sweep *s, const char *name, const gg_grid_key *but)
{
  gg_grid_key found = {.n = 1};
  for (size_t f = 0; f < s->n_varied; f++) {
    const gg_varied *v = &s->varied[f];
    if (but && but->key && but->varied == f) continue;
    for (size_t k = 0; k < v->n_keys; k++) {
      if (name && strcmp(v->key[k], name) == 0) return (gg_grid_key){f, k, v->key[k], v->n};
      if (!name && k == 0 && v->n > found.n) found = (gg_grid_key){f, k, v->key[k], v->n};
    }
  }
  return found;
}

static bool is_axis(const gg_grid_view *v, size_t varied)
{
  return (v->x.key && v->x.varied == varied) || (v->y.key && v->y.varied == varied);
}

/* Rows of the table are in the order of points. */
static void index_rows(gg_grid_view *v)
{
  size_t row = 0;
  for (size_t i = 0; i < v->sweep->n; i++) {
    v->first[i] = row;
    while (row < v->table->n && v->table->row[row].point == i) row++;
  }
  v->first[v->sweep->n] = row;
}

gg_status gg_sweep_grid_view_make(gg_grid_view *v, const gg_point_table *table, const gg_sweep *sweep, gg_error *err)
{
  *v = (gg_grid_view){.sweep = sweep, .table = table, .n_panels = 1};
  v->x = find_key(sweep, "phi", NULL);
  v->y = find_key(sweep, "collision.e", &v->x);
  if (!v->x.key) v->x = find_key(sweep, NULL, &v->y);
  if (!v->y.key) v->y = find_key(sweep, NULL, &v->x);
  for (size_t f = 0; f < sweep->n_varied; f++)
    if (!is_axis(v, f)) v->n_panels *= sweep->varied[f].n;
  v->first = gg_base_array_new(sweep->n + 1, sizeof *v->first, err);
  if (!v->first) return GG_FAILED;
  index_rows(v);
  return GG_OK;
}

void gg_sweep_grid_view_clear(gg_grid_view *v)
{
  free(v->first);
  *v = (gg_grid_view){0};
}

/* Row of a group that is no axis in a panel; the last group changes fastest. */
static size_t row_of_panel(const gg_grid_view *v, size_t panel, size_t varied)
{
  for (size_t f = v->sweep->n_varied - 1; f > varied; f--)
    if (!is_axis(v, f)) panel /= v->sweep->varied[f].n;
  return panel % v->sweep->varied[varied].n;
}

size_t gg_sweep_grid_point(const gg_grid_view *v, size_t panel, size_t x, size_t y)
{
  size_t point = 0;
  for (size_t f = 0; f < v->sweep->n_varied; f++) {
    const size_t row = v->x.key && f == v->x.varied ? x : v->y.key && f == v->y.varied ? y : row_of_panel(v, panel, f);
    point = point * v->sweep->varied[f].n + row;
  }
  return point;
}

const char *gg_sweep_grid_value(const gg_grid_view *v, const gg_grid_key *axis, size_t i)
{
  if (!axis->key) return "";
  const gg_varied *group = &v->sweep->varied[axis->varied];
  return group->value[i * group->n_keys + axis->k];
}

static bool is_said(const gg_varied *v, size_t row, size_t k)
{
  const char *value = v->value[row * v->n_keys + k];
  bool differs = false;
  for (size_t i = 0; i < v->n; i++) differs |= strcmp(v->value[i * v->n_keys + k], value) != 0;
  return differs && strcmp(value, ".inf") != 0;
}

static void add_value(char name[GG_PANEL_NAME], const gg_varied *v, size_t row, size_t k, bool enhanced)
{
  char symbol[64];
  const char *dot = strrchr(v->key[k], '.'), *value = v->value[row * v->n_keys + k];
  gg_plot_chart_key(v->key[k], symbol, sizeof symbol, NULL);
  gg_base_text_append(name, GG_PANEL_NAME, "%s%s%s%.24s", *name ? ", " : "",
                      enhanced ? symbol
                      : dot    ? dot + 1
                               : v->key[k],
                      enhanced ? " = " : " ", value);
}

void gg_sweep_grid_panel_name(const gg_grid_view *v, size_t panel, bool enhanced, char name[GG_PANEL_NAME])
{
  *name = '\0';
  for (size_t f = 0; f < v->sweep->n_varied; f++) {
    const gg_varied *group = &v->sweep->varied[f];
    const size_t row = is_axis(v, f) ? 0 : row_of_panel(v, panel, f);
    for (size_t k = 0; k < group->n_keys && !is_axis(v, f); k++)
      if (is_said(group, row, k)) add_value(name, group, row, k, enhanced);
  }
}

const gg_point_row *gg_sweep_grid_row(const gg_grid_view *v, size_t point, const char *method, const char *quantity)
{
  for (size_t i = v->first[point]; i < v->first[point + 1]; i++) {
    const gg_point_row *row = &v->table->row[i];
    if (strcmp(row->method, method) == 0 && strcmp(row->quantity, quantity) == 0) return row;
  }
  return NULL;
}

bool gg_sweep_grid_has(const gg_grid_view *v, size_t point)
{
  return v->first[point + 1] > v->first[point];
}
