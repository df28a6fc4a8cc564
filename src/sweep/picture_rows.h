/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a picture of a sweep shows: numbers of its table, and theories at forty values of the axis. */
#ifndef GG_PICTURE_ROWS_H
#define GG_PICTURE_ROWS_H

#include "sweep/sweep_table.h"

typedef struct gg_picture_row {
  const char *method, *quantity, *unit;
  size_t point;       /* of its table */
  size_t combination; /* the first point of the sweep with the same values of the other keys */
  double x;
  double mean, error;        /* of a picture relative to a method: the difference */
  double share, share_error; /* ... and over that method's mean; NaN of numbers about zero */
  bool theory, steady;
} gg_picture_row;

typedef struct gg_picture_rows {
  size_t n, room;
  gg_picture_row *row; /* to be freed, also on failure */
} gg_picture_rows;

/* Quantities: with commas. */
gg_status gg_sweep_picture_rows_make(gg_picture_rows *rows, const gg_point_table *table, const gg_sweep *sweep,
                                     const gg_picture_choice *choice, const char *quantities, gg_error *err);

/* The value of the axis at a point; NaN: it is not a number. */
double gg_sweep_axis_value(const gg_sweep *sweep, size_t point, const gg_picture_axis *axis);
/* Is a word in a list with commas? */
bool gg_sweep_list_has(const char *list, const char *word);

#endif
