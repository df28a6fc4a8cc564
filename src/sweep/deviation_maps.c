/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/deviation_maps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/build.h"
#include "base/memory.h"
#include "common/quantity.h"
#include "graingas.h"
#include "plot/chart.h"
#include "plot/heat_map.h"
#include "plot/plot.h"
#include "scene/scene.h"
#include "sweep/verdict.h"

enum { MOST_CELLS = 24, MOST_COLUMNS = 8, MOST_THEORIES = 6, MOST_ROWS = 3 + MOST_THEORIES };

/* A method against its reference: Enskog's equation, or with `engines` md against dsmc. */
typedef struct map_row {
  char method[64], name[160];
  bool engines;
} map_row;

typedef struct maps {
  const gg_grid_view *view;
  const gg_map_choice *choice;
  size_t n_rows;
  map_row row[MOST_ROWS];
  gg_heat_cell *cell;
  char x_label[96], y_label[96], column[MOST_COLUMNS][GG_PANEL_NAME], title[200];
  const char *note[MOST_ROWS * MOST_COLUMNS];
  const char *x_value[MOST_CELLS], *y_value[MOST_CELLS], *column_name[MOST_COLUMNS], *row_name[MOST_ROWS];
} maps;

static const gg_heat_cell nothing = {NAN, NAN, false, 0};

static char structure_of(const gg_point_row *row)
{
  return !row->structure ? 0 : strcmp(row->structure, "collapsed") == 0 ? 'k' : 'c';
}

/* Deviation of a row of the table from its reference: the noise-free solution, or dsmc where that has no answer. */
static gg_heat_cell against_enskog(const gg_point_row *row)
{
  if (!row || !row->reference) return nothing;
  return (gg_heat_cell){gg_sweep_deviation_of(row), gg_sweep_deviation_error_of(row), !row->steady, structure_of(row)};
}

static gg_heat_cell between_engines(const gg_point_row *md, const gg_point_row *dsmc, bool difference)
{
  if (!md || !dsmc || !(difference || fabs(dsmc->mean) > 3 * dsmc->error)) return nothing;
  const double scale = difference ? 1 : dsmc->mean;
  return (gg_heat_cell){(md->mean - dsmc->mean) / scale, hypot(md->error, dsmc->error) / fabs(scale),
                        !md->steady || !dsmc->steady, structure_of(md)};
}

static void fill(maps *m, const char *quantity, bool difference)
{
  const gg_grid_view *v = m->view;
  gg_heat_cell *cell = m->cell;
  for (size_t r = 0; r < m->n_rows; r++)
    for (size_t p = 0; p < v->n_panels; p++) {
      const char **note = &m->note[r * v->n_panels + p];
      *note = NULL;
      for (size_t i = 0; i < v->x.n * v->y.n; i++) {
        const size_t point = gg_sweep_grid_point(v, p, i % v->x.n, i / v->x.n);
        const gg_point_row *row = gg_sweep_grid_row(v, point, m->row[r].method, quantity);
        const bool engines = m->row[r].engines;
        *cell++ = engines ? between_engines(row, gg_sweep_grid_row(v, point, "dsmc", quantity), difference)
                          : against_enskog(row);
        if (!engines && row && row->reference && strcmp(row->reference, "dsmc") == 0) *note = "against dsmc";
      }
    }
}

static void name_rows(maps *m, bool difference)
{
  for (size_t r = 0; r < m->n_rows; r++) {
    map_row *row = &m->row[r];
    char method[64];
    gg_plot_method_name(row->method, method, sizeof method);
    snprintf(row->name, sizeof row->name, difference ? "%s - %s" : "%s/%s", method, row->engines ? "dsmc" : "Enskog");
    m->row_name[r] = row->name;
  }
}

static gg_status draw_quantity(maps *m, const char *quantity, const char *picture, gg_error *err)
{
  const gg_grid_view *v = m->view;
  const bool difference = gg_sweep_is_difference(quantity);
  fill(m, quantity, difference);
  name_rows(m, difference);
  snprintf(m->title, sizeof m->title, "%s: %s (graingas %s)", quantity,
           difference ? "differences, as a share of the pressure" : "ratios less 1", gg_base_build_version);
  const gg_heat_map map = {.title = m->title,
                           .n_x = v->x.n,
                           .n_y = v->y.n,
                           .x_label = m->x_label,
                           .y_label = m->y_label,
                           .x_value = m->x_value,
                           .y_value = m->y_value,
                           .columns = v->n_panels,
                           .rows = m->n_rows,
                           .column_name = m->column_name,
                           .row_name = m->row_name,
                           .panel_note = m->note,
                           .cell = m->cell};
  return gg_plot_heat_map_draw(&map, picture, m->choice->width, err);
}

static void name_axes(maps *m)
{
  const gg_grid_view *v = m->view;
  if (v->x.key) gg_plot_chart_key(v->x.key, m->x_label, sizeof m->x_label, NULL);
  if (v->y.key) gg_plot_chart_key(v->y.key, m->y_label, sizeof m->y_label, NULL);
  for (size_t i = 0; i < v->x.n; i++) m->x_value[i] = gg_sweep_grid_value(v, &v->x, i);
  for (size_t i = 0; i < v->y.n; i++) m->y_value[i] = gg_sweep_grid_value(v, &v->y, i);
  for (size_t p = 0; p < v->n_panels; p++) {
    gg_sweep_grid_panel_name(v, p, true, m->column[p]);
    m->column_name[p] = m->column[p];
  }
}

/* The default theories: Lun's, and those of the sweep's own file. */
static void list_theories(const maps *m, char *list, size_t size)
{
  const gg_extension *own = m->view->sweep->base->extension;
  snprintf(list, size, "lun1991");
  for (int i = 0; i < gg_common_extension_theories(own) && i + 1 < MOST_THEORIES; i++)
    gg_base_text_append(list, size, ",%s", gg_common_extension_theory(own, i)->name);
}

static gg_status choose_rows(maps *m, gg_error *err)
{
  char chosen[64 * MOST_THEORIES], word[64];
  const char *theories = m->choice->theories ? m->choice->theories : chosen;
  list_theories(m, chosen, sizeof chosen);
  m->row[m->n_rows++] = (map_row){.method = "dsmc"};
  m->row[m->n_rows++] = (map_row){.method = "md"};
  m->row[m->n_rows++] = (map_row){.method = "md", .engines = true};
  while (gg_sweep_next_word(&theories, word)) {
    if (!gg_sweep_point_table_has(m->view->table, word, NULL) && m->choice->theories)
      return GG_REFUSE(err, "no point has a theory '%s'", word);
    if (m->n_rows == MOST_ROWS) return GG_REFUSE(err, "a map has at most %d theories", MOST_THEORIES);
    if (gg_sweep_point_table_has(m->view->table, word, NULL)) memcpy(m->row[m->n_rows++].method, word, sizeof word);
  }
  return GG_OK;
}

static gg_status draw_all(maps *m, void (*drawn)(void *, const char *, const char *), void *context, gg_error *err)
{
  const char *show = m->choice->show ? m->choice->show : "temperature,temperature_ratio,pressure,shear_viscosity,N1,N2";
  char word[64];
  gg_plot_paper paper;
  GG_TRY(gg_plot_paper_choose(&paper, m->choice->picture, NULL, m->choice->width, err));
  while (gg_sweep_next_word(&show, word)) {
    const gg_point_table *t = m->view->table;
    const bool has = gg_sweep_point_table_has(t, "md", word) || gg_sweep_point_table_has(t, "dsmc", word);
    if (!has && m->choice->show) return GG_REFUSE(err, "no point has a quantity '%s'", word);
    if (!has) continue;
    GG_TRY(gg_stop_check(m->choice->stop, err));
    GG_FREED char *picture = gg_plot_page_name(m->choice->picture, "", word, &paper);
    if (!picture) return gg_base_out_of_memory(err);
    GG_TRY(draw_quantity(m, word, picture, err));
    if (drawn) drawn(context, picture, word);
  }
  return GG_OK;
}

gg_status gg_sweep_deviation_maps_draw(const gg_grid_view *v, const gg_map_choice *choice,
                                       void (*drawn)(void *context, const char *picture, const char *quantity),
                                       void *context, gg_error *err)
{
  if (v->x.n > MOST_CELLS || v->y.n > MOST_CELLS || v->n_panels > MOST_COLUMNS)
    return GG_REFUSE(err, "no maps: they have room for %d values of two keys and %d combinations of the others",
                     MOST_CELLS, MOST_COLUMNS);
  GG_FREED maps *m = gg_base_array_new(1, sizeof *m, err);
  GG_FREED gg_heat_cell *cell = gg_base_array_new(MOST_ROWS * v->n_panels * v->x.n * v->y.n, sizeof *cell, err);
  if (!m || !cell) return GG_FAILED;
  *m = (maps){.view = v, .choice = choice, .cell = cell};
  GG_TRY(choose_rows(m, err));
  name_axes(m);
  return draw_all(m, drawn, context, err);
}
