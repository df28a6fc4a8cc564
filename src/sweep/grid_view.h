/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of a sweep over two of its keys: cells (x, y), and a panel for each combination of the other keys. */
#ifndef GG_GRID_VIEW_H
#define GG_GRID_VIEW_H

#include "sweep/sweep_table.h"

enum { GG_PANEL_NAME = 120 };

typedef struct gg_grid_key {
  size_t varied, k; /* place of the key among the varied ones */
  const char *key;  /* "phi"; NULL: there is no such axis */
  size_t n;         /* values; 1 without an axis */
} gg_grid_key;

typedef struct gg_grid_view {
  const gg_sweep *sweep;
  const gg_point_table *table;
  gg_grid_key x, y; /* phi and collision.e where they vary, else the keys with most values */
  size_t n_panels;
  size_t *first; /* rows of point i: from first[i] to before first[i + 1] */
} gg_grid_view;

gg_status gg_sweep_grid_view_make(gg_grid_view *view, const gg_point_table *table, const gg_sweep *sweep,
                                  gg_error *err);
void gg_sweep_grid_view_clear(gg_grid_view *view);

size_t gg_sweep_grid_point(const gg_grid_view *view, size_t panel, size_t x, size_t y);
/* The value of an axis, as in YAML; "" without an axis. */
const char *gg_sweep_grid_value(const gg_grid_view *view, const gg_grid_key *axis, size_t i);
/* "beta 0.3, mu 0.1", or enhanced text for pictures: "β = 0.3, μ = 0.1". Infinite values and those without a second
 * value are left out. */
void gg_sweep_grid_panel_name(const gg_grid_view *view, size_t panel, bool enhanced, char name[GG_PANEL_NAME]);
/* The row of a method and a quantity at a point; NULL: none. */
const gg_point_row *gg_sweep_grid_row(const gg_grid_view *view, size_t point, const char *method, const char *quantity);
bool gg_sweep_grid_has(const gg_grid_view *view, size_t point);

#endif
