/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Maps of relative deviations over two keys: panels of coloured cells, with one colour scale for all pictures. */
#ifndef GG_HEAT_MAP_H
#define GG_HEAT_MAP_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

typedef struct gg_heat_cell {
  double value;    /* 0.05: 5 %; NaN: none */
  double error;    /* standard error; NaN: none. A value below two errors is hatched */
  bool not_steady; /* marked by a cross */
  char structure;  /* of md, by its first letter: 'c'lustered, a triangle; 'k', collapsed, a diamond; 0: none */
} gg_heat_cell;

/* Texts are gnuplot's enhanced text and the caller's. */
typedef struct gg_heat_map {
  const char *title; /* plain text */
  size_t n_x, n_y;   /* cells of a panel */
  const char *x_label, *y_label;
  const char *const *x_value, *const *y_value;
  size_t columns, rows; /* of panels */
  const char *const *column_name, *const *row_name;
  const char *const *panel_note; /* of each panel, in the order of cells; NULL: none, also of one */
  const gg_heat_cell *cell;      /* of panel (row r, column c) at x, y: [((r*columns + c)*n_y + y)*n_x + x] */
} gg_heat_map;

/* The place of a deviation on the colour scale, from -1 to 1: linear below 0.5 %, logarithmic above, up to 100 %. */
double gg_plot_heat_place(double value);
/* Its colour 0xrrggbb: blue below zero, white at zero, brown above, as dark on either side. */
unsigned gg_plot_heat_colour(double value);

/* Draw a map, whole or not at all; width: "86mm", or NULL. */
gg_status gg_plot_heat_map_draw(const gg_heat_map *map, const char *picture, const char *width, gg_error *err);

#endif
