/* A sheet of `graingas bench`: a table of text, and the same rows as JSON. Subjects fill it, the command prints it. */
#ifndef GG_BENCH_SHEET_H
#define GG_BENCH_SHEET_H

#include <jansson.h>
#include <stdbool.h>

#include "base/error.h"

enum { GG_BENCH_COLUMNS = 16, GG_BENCH_ROWS = 64, GG_BENCH_CELL = 64 };

typedef struct gg_bench_sheet {
  const char *key;     /* of the rows in the JSON document; a literal, as the caption is */
  const char *caption; /* above the table: what was measured, and how */
  int keep;            /* columns that are repeated where the table is too wide */
  json_t *rows;        /* an array of objects */
  int n_columns, n_rows;
  bool right[GG_BENCH_COLUMNS]; /* numbers stand right */
  char head[GG_BENCH_COLUMNS][GG_BENCH_CELL];
  char cell[GG_BENCH_ROWS][GG_BENCH_COLUMNS][GG_BENCH_CELL];
} gg_bench_sheet;

/* NULL with the message if out of memory. */
gg_bench_sheet *gg_bench_sheet_new(const char *key, const char *caption, int keep, gg_error *err);
void gg_bench_sheet_free(gg_bench_sheet *sheet);

/* A new column, a new row; return their number. */
int gg_bench_sheet_column(gg_bench_sheet *sheet, bool right, const char *format, ...) GG_PRINTF(3, 4);
int gg_bench_sheet_row(gg_bench_sheet *sheet);
void gg_bench_sheet_put(gg_bench_sheet *sheet, int row, int column, const char *format, ...) GG_PRINTF(4, 5);

#endif
