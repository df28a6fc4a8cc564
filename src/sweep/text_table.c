/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/text_table.h"

#include <stdarg.h>
#include <string.h>

void gg_sweep_text_row(gg_text_table *t)
{
  if (t->n_rows < GG_TEXT_ROWS) memset(t->cell[t->n_rows], 0, sizeof t->cell[0]);
  t->n_rows++;
  t->at = 0;
}

void gg_sweep_text_cells(gg_text_table *t, const char *format, ...)
{
  char text[8 * GG_TEXT_CELL];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  for (char *at = text, *cell; t->n_rows <= GG_TEXT_ROWS && t->at < GG_TEXT_COLUMNS && (cell = strsep(&at, "\t"));)
    snprintf(t->cell[t->n_rows - 1][t->at++], GG_TEXT_CELL, "%s", cell);
  if (t->at > t->n_columns) t->n_columns = t->at;
}

/* Bytes of UTF-8 that continue a letter take no room. */
static int letters(const char *text)
{
  int n = 0;
  for (; *text; text++) n += ((unsigned char)*text & 0xc0) != 0x80;
  return n;
}

static int width_of(const gg_text_table *t, int rows, int column)
{
  int width = 3;
  for (int i = 0; i < rows; i++) {
    const int its = letters(t->cell[i][column]);
    if (its > width) width = its;
  }
  return width;
}

void gg_sweep_text_print(gg_text_table *t, FILE *out)
{
  const int rows = t->n_rows < GG_TEXT_ROWS ? t->n_rows : GG_TEXT_ROWS;
  for (int i = 0; i < rows; i++) {
    fputc('|', out);
    for (int k = 0; k < t->n_columns; k++)
      fprintf(out, " %s%*s |", t->cell[i][k], width_of(t, rows, k) - letters(t->cell[i][k]), "");
    fputc('\n', out);
    if (i) continue;
    fputc('|', out);
    for (int k = 0; k < t->n_columns; k++) {
      fputc(' ', out);
      for (int width = width_of(t, rows, k); width > 0; width--) fputc('-', out);
      fputs(" |", out);
    }
    fputc('\n', out);
  }
  if (t->n_rows > rows) fprintf(out, "\n%d more rows are left out.\n", t->n_rows - rows);
  fputc('\n', out);
  t->n_rows = t->n_columns = t->at = 0;
}
