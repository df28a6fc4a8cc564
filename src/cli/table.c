#include "cli/table.h"

#include <stdlib.h>
#include <string.h>

#include "cli/wrap.h"

enum { GAP = 2 };

gg_table *gg_cli_table_new(void)
{
  return calloc(1, sizeof(gg_table));
}

int gg_cli_table_column(gg_table *t, const char *head, bool right)
{
  int c = t->n_columns < GG_TABLE_COLUMNS ? t->n_columns++ : GG_TABLE_COLUMNS - 1;
  snprintf(t->head[c], GG_TABLE_CELL, "%s", head);
  t->right[c] = right;
  return c;
}

int gg_cli_table_row(gg_table *t)
{
  return t->n_rows < GG_TABLE_ROWS ? t->n_rows++ : GG_TABLE_ROWS - 1;
}

char *gg_cli_table_cell(gg_table *t, int row, int column)
{
  return t->cell[row][column];
}

static int width_of(const gg_table *t, int c)
{
  size_t width = strlen(t->head[c]);
  for (int r = 0; r < t->n_rows; r++)
    if (strlen(t->cell[r][c]) > width) width = strlen(t->cell[r][c]);
  return (int)width;
}

/* Cells as wide as their columns, without blanks at the end. */
static void print_line(const gg_table *t, FILE *out, const int *columns, int n, int row)
{
  char line[GG_TABLE_COLUMNS * (GG_TABLE_CELL + GAP)];
  int used = 0;
  for (int i = 0; i < n; i++) {
    int c = columns[i], width = width_of(t, c);
    const char *text = row < 0 ? t->head[c] : t->cell[row][c];
    used += sprintf(line + used, "%*s%*s", i ? GAP : 0, "", t->right[c] ? width : -width, text);
  }
  while (used && line[used - 1] == ' ') used--;
  fprintf(out, "%.*s\n", used, line);
}

static bool row_is_empty(const gg_table *t, const int *columns, int n, int keep, int row)
{
  for (int i = keep; i < n; i++)
    if (t->cell[row][columns[i]][0]) return false;
  return n > keep;
}

static void print_block(const gg_table *t, FILE *out, const int *columns, int n, int keep)
{
  print_line(t, out, columns, n, -1);
  int total = (n - 1) * GAP;
  for (int i = 0; i < n; i++) total += width_of(t, columns[i]);
  for (int i = 0; i < total; i++) fputc('-', out);
  fputc('\n', out);
  for (int r = 0; r < t->n_rows; r++)
    if (!row_is_empty(t, columns, n, keep, r)) print_line(t, out, columns, n, r);
}

void gg_cli_table_print(const gg_table *t, FILE *out, int keep)
{
  int width = gg_cli_terminal_width();
  int columns[GG_TABLE_COLUMNS], next = keep;
  do {
    int n = 0, used = 0;
    for (; n < keep; n++) columns[n] = n, used += width_of(t, n) + GAP;
    bool first = true;
    while (next < t->n_columns && (first || used + width_of(t, next) <= width)) {
      used += width_of(t, next) + GAP;
      columns[n++] = next++;
      first = false;
    }
    print_block(t, out, columns, n, keep);
    if (next < t->n_columns) fputc('\n', out);
  } while (next < t->n_columns);
}
