/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/print.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/cli.h"

enum { USUAL = 80, LEAST = 40, MOST = 1000 };

const char *const gg_cli_engines[GG_CLI_ENGINES] = {"md", "dsmc"};

int gg_cli_terminal_width(void)
{
  struct winsize window = {0};
  const char *said = getenv("COLUMNS");
  char *end = NULL;
  long columns = USUAL;
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col)
    columns = window.ws_col;
  else if (said && *said) {
    columns = strtol(said, &end, 10);
    if (*end || columns < 1) columns = USUAL;
  }
  return (int)(columns < LEAST ? LEAST : columns > MOST ? MOST : columns);
}

void gg_cli_freed(void *place)
{
  void *pointer;
  memcpy(&pointer, place, sizeof pointer);
  free(pointer);
}

/* Number of characters of UTF-8 text: bytes that are not continuation bytes. */
static int columns_of(const char *text, size_t bytes)
{
  int n = 0;
  for (size_t i = 0; i < bytes; i++) n += ((unsigned char)text[i] & 0xC0) != 0x80;
  return n;
}

/* Print words from column `used` on, wrapped, with `indent` blanks before further lines. Blanks between words stay. */
static void put_words(FILE *out, const char *text, int used, int indent)
{
  int width = gg_cli_terminal_width();
  bool begun = false;
  while (*text) {
    int gap = (int)strspn(text, " ");
    text += gap;
    size_t bytes = strcspn(text, " \n");
    int word = columns_of(text, bytes);
    if (begun && used + gap + word > width) {
      fprintf(out, "\n%*s", indent, "");
      used = indent, gap = 0;
    }
    if (bytes) fprintf(out, "%*s%.*s", gap, "", (int)bytes, text);
    used += gap + word;
    begun = true;
    text += bytes;
    if (*text != '\n') continue;
    text++;
    fprintf(out, "\n%*s", *text && *text != '\n' ? indent : 0, "");
    used = indent, begun = false;
  }
  fputc('\n', out);
}

void gg_cli_print_wrapped(FILE *out, const char *lead, const char *text)
{
  fputs(lead, out);
  int indent = columns_of(lead, strlen(lead));
  put_words(out, text, indent, indent);
}

void gg_cli_print_paragraph(FILE *out, int indent, const char *format, ...)
{
  char *text = NULL;
  va_list args;
  va_start(args, format);
  int length = vasprintf(&text, format, args);
  va_end(args);
  if (length >= 0) put_words(out, text, 0, indent);
  free(text);
}

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

void gg_cli_format_count(double count, char *text, size_t size)
{
  static const char *const prefixes[] = {"", " k", " M", " G", " T"};
  int k = 0;
  while (count >= 999.5 && k < 4) count /= 1000, k++;
  if (k == 0 && count == floor(count))
    snprintf(text, size, "%.0f", count);
  else
    snprintf(text, size, "%.3g%s", count, prefixes[k]);
}

void gg_cli_format_duration(double seconds, char *text, size_t size)
{
  long whole = lround(seconds);
  if (seconds < 0.0995)
    snprintf(text, size, "%.0f ms", 1000 * seconds);
  else if (seconds < 9.95)
    snprintf(text, size, "%.1f s", seconds);
  else if (whole < 60)
    snprintf(text, size, "%ld s", whole);
  else if (whole < 3600)
    snprintf(text, size, "%ld:%02ld min", whole / 60, whole % 60);
  else
    snprintf(text, size, "%ld:%02ld:%02ld h", whole / 3600, whole / 60 % 60, whole % 60);
}

/* Texts on standard output, errors on standard error. */

/* Messages may quote names with control characters. */
int gg_cli_report(const gg_error *err)
{
  gg_error shown = *err;
  gg_text_make_printable(shown.message);
  fflush(stdout);
  fprintf(stderr, "graingas: %s\n", shown.message);
  return err->status;
}

void gg_cli_print_name(FILE *out, const char *before, const char *name, const char *after)
{
  GG_CLI_FREED char *shown = strdup(name);
  if (shown && (out != stdout || isatty(STDOUT_FILENO))) gg_text_make_printable(shown);
  fprintf(out, "%s%s%s", before, shown ? shown : "", after);
}

int gg_cli_report_of(const char *prefix, const gg_error *err)
{
  return gg_cli_fail(err->status, "%s: %s", prefix, err->message);
}

int gg_cli_fail(gg_status status, const char *format, ...)
{
  gg_error err = {.status = status};
  va_list args;
  va_start(args, format);
  vsnprintf(err.message, sizeof err.message, format, args);
  va_end(args);
  return gg_cli_report(&err);
}

gg_status gg_cli_refuse(gg_error *err, gg_status status, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(err->message, sizeof err->message, format, args);
  va_end(args);
  return err->status = status;
}

bool gg_cli_has_ending(const char *text, const char *ending)
{
  const size_t length = strlen(text), tail = strlen(ending);
  return length > tail && strcmp(text + length - tail, ending) == 0;
}

void gg_cli_append(char *text, size_t size, const char *format, ...)
{
  const size_t used = strlen(text);
  va_list args;
  va_start(args, format);
  vsnprintf(text + used, size - used, format, args);
  va_end(args);
}

bool gg_cli_has_word(const char *words, const char *word)
{
  const size_t length = strlen(word);
  for (const char *at = words; at && (at = strstr(at, word)); at += length)
    if ((at == words || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return true;
  return false;
}

void gg_cli_print_notice(const char *result_file)
{
  char text[400];
  if (gg_result_file_notice(result_file, text, sizeof text, NULL) != GG_OK || !*text) return;
  fflush(stdout);
  gg_cli_print_name(stderr, "warning: ", result_file, ": ");
  fprintf(stderr, "%s\n", text);
}

void gg_cli_print_text(char *text)
{
  if (text) puts(text);
  free(text);
}
