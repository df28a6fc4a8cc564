/* A table of text: columns as wide as what they hold. */
#ifndef GG_CLI_TABLE_H
#define GG_CLI_TABLE_H

#include <stdbool.h>
#include <stdio.h>

enum { GG_TABLE_COLUMNS = 24, GG_TABLE_ROWS = 96, GG_TABLE_CELL = 64 };

typedef struct gg_table {
  int n_columns, n_rows;
  bool right[GG_TABLE_COLUMNS]; /* numbers stand right */
  char head[GG_TABLE_COLUMNS][GG_TABLE_CELL];
  char cell[GG_TABLE_ROWS][GG_TABLE_COLUMNS][GG_TABLE_CELL];
} gg_table;

/* A new, empty table; free() it. NULL if out of memory. */
gg_table *gg_cli_table_new(void);
int gg_cli_table_column(gg_table *table, const char *head, bool right);
/* The cell to write into: GG_TABLE_CELL bytes. */
char *gg_cli_table_cell(gg_table *table, int row, int column);
int gg_cli_table_row(gg_table *table);
/* Columns that do not fit into the terminal follow in further blocks, which repeat the first `keep` columns. */
void gg_cli_table_print(const gg_table *table, FILE *out, int keep);

#endif
