#include "bench/bench_table.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"

gg_bench_sheet *gg_bench_sheet_new(const char *key, const char *caption, int keep, gg_error *err)
{
  gg_bench_sheet *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return NULL;
  s->key = key, s->caption = caption, s->keep = keep;
  s->rows = json_array();
  if (s->rows) return s;
  free(s);
  gg_base_out_of_memory(err);
  return NULL;
}

void gg_bench_sheet_free(gg_bench_sheet *s)
{
  if (!s) return;
  json_decref(s->rows);
  free(s);
}

int gg_bench_sheet_column(gg_bench_sheet *s, bool right, const char *format, ...)
{
  int column = s->n_columns < GG_BENCH_COLUMNS ? s->n_columns++ : GG_BENCH_COLUMNS - 1;
  va_list list;
  va_start(list, format);
  vsnprintf(s->head[column], GG_BENCH_CELL, format, list);
  va_end(list);
  s->right[column] = right;
  return column;
}

int gg_bench_sheet_row(gg_bench_sheet *s)
{
  return s->n_rows < GG_BENCH_ROWS ? s->n_rows++ : GG_BENCH_ROWS - 1;
}

void gg_bench_sheet_put(gg_bench_sheet *s, int row, int column, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  vsnprintf(s->cell[row][column], GG_BENCH_CELL, format, list);
  va_end(list);
}
