/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text output: paragraphs and tables that fit the terminal, counts and durations. */
#ifndef GG_CLI_PRINT_H
#define GG_CLI_PRINT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Engines in the order of gg_comparison_row and gg_checkpoint_info. */
enum { GG_CLI_ENGINES = 2 };
extern const char *const gg_cli_engines[GG_CLI_ENGINES];

/* Width of the terminal at standard output; otherwise COLUMNS, otherwise 80. At least 40. */
int gg_cli_terminal_width(void);

/* Print a paragraph: `lead` before the first line, as many blanks before further lines. Line ends in `text` stay. */
void gg_cli_print_wrapped(FILE *out, const char *lead, const char *text);
/* Print a paragraph from a format; lines after the first begin with `indent` blanks. */
void gg_cli_print_paragraph(FILE *out, int indent, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Print a file name. On a terminal control characters are replaced; a pipe or file gets the exact name. */
void gg_cli_print_name(FILE *out, const char *before, const char *name, const char *after);

/* A table of text with columns as wide as their content. */
enum { GG_TABLE_COLUMNS = 24, GG_TABLE_ROWS = 96, GG_TABLE_CELL = 64 };

typedef struct gg_table {
  int n_columns, n_rows;
  bool right[GG_TABLE_COLUMNS]; /* numbers are right-aligned */
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
