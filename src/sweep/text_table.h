/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of Markdown with aligned columns, readable in a terminal, too. */
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

/* Begin a row; cells beyond the size of the table are left out. */
void gg_sweep_text_row(gg_text_table *table);
/* Cells of the row, with tabs between them. */
void gg_sweep_text_cells(gg_text_table *table, const char *format, ...) GG_PRINTF(2, 3);
/* Print the table and an empty line, and clear the table. */
void gg_sweep_text_print(gg_text_table *table, FILE *out);

#endif
