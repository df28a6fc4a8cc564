/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of Markdown whose columns stand below each other, so that they read in a terminal, too. */
#ifndef GG_TEXT_TABLE_H
#define GG_TEXT_TABLE_H

#include <stdio.h>

#include "base/error.h"

enum { GG_TEXT_COLUMNS = 32, GG_TEXT_CELL = 160, GG_TEXT_ROWS = 64 };

/* Rows are cells in order; the first one is the head. On the heap: it is large. */
typedef struct gg_text_table {
  int n_rows, n_columns, at; /* at: cells of the last row */
  char cell[GG_TEXT_ROWS][GG_TEXT_COLUMNS][GG_TEXT_CELL];
} gg_text_table;

/* Begin a row; what is beyond the table's size is left out. */
void gg_sweep_text_row(gg_text_table *table);
void gg_sweep_text_cell(gg_text_table *table, const char *format, ...) GG_PRINTF(2, 3);
/* Print, with an empty line behind it, and empty it. */
void gg_sweep_text_print(gg_text_table *table, FILE *out);

#endif
