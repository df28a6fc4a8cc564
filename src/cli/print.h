/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text for people: paragraphs and tables as wide as their terminal, counts and durations as they read them. */
#ifndef GG_CLI_PRINT_H
#define GG_CLI_PRINT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Columns of the terminal that standard output is; else what COLUMNS says, else 80. At least 40. */
int gg_cli_terminal_width(void);

/* A paragraph: `lead` before the first line, as much space before the others. Line ends in `text` stay. */
void gg_cli_print_wrapped(FILE *out, const char *lead, const char *text);
/* The same from a format; lines after the first begin with `indent` blanks, the
 * first with those of the text. */
void gg_cli_print_paragraph(FILE *out, int indent, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The name of a file. A terminal acts on nothing in it; a script that reads standard output gets the name as it is. */
void gg_cli_print_name(FILE *out, const char *before, const char *name, const char *after);

/* A table of text: columns as wide as what they hold. */
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

/* A count with a unit prefix: "12.3 M". */
void gg_cli_format_count(double count, char *text, size_t size);
/* "0.8 s", "1:05", "2:03:04". */
void gg_cli_format_duration(double seconds, char *text, size_t size);

#endif
