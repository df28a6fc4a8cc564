/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench: prints the measurements of src/bench. The only subcommand that uses more than the public header. */
#include "bench/bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/print.h"
#include "cli/progress.h"

static void tell(void *context, const char *text)
{
  gg_cli_line_show(context, text, false);
}

static int print_table(const gg_bench_table *s)
{
  GG_CLI_FREED gg_table *t = gg_cli_table_new();
  if (!t) return gg_cli_fail(GG_FAILED, "out of memory");
  for (int c = 0; c < s->n_columns; c++) gg_cli_table_column(t, s->head[c], s->right[c]);
  for (int r = 0; r < s->n_rows; r++) {
    int row = gg_cli_table_row(t);
    for (int c = 0; c < s->n_columns; c++) snprintf(gg_cli_table_cell(t, row, c), GG_TABLE_CELL, "%s", s->cell[r][c]);
  }
  if (s->caption) gg_cli_print_wrapped(stdout, "", s->caption), putchar('\n');
  if (*s->title) printf("%s\n\n", s->title);
  gg_cli_table_print(t, stdout, s->keep);
  return GG_OK;
}

/* Flush each row, so that an interrupted bench leaves the rows that are measured. */
static void print_row(void *context, const char *row)
{
  gg_cli_line_clear(context);
  printf("%s\n", row);
  fflush(stdout);
}

static int print(const gg_bench *b)
{
  int code = GG_OK;
  for (int i = 0; i < b->n_tables && code == GG_OK; i++) {
    if (i) putchar('\n');
    code = print_table(b->table[i]);
  }
  return code;
}

static int compare(const gg_options *o)
{
  GG_CLI_FREED char *text = NULL;
  gg_error err;
  if (!o->more[1]) return gg_cli_fail(GG_BAD_INPUT, "bench compare needs two files: A.json B.json");
  const gg_status status = gg_bench_compare(o->more[0], o->more[1], o->limit, o->json, &text, &err);
  if (text) fputs(text, stdout);
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

static int measure(const gg_options *o)
{
  const char *picture = o->picture && strcmp(o->picture, "none") != 0 ? o->picture : NULL;
  gg_cli_line line;
  gg_bench_options asked = {.quick = o->quick,
                            .picture = picture,
                            .width = o->width,
                            .threads = o->threads,
                            .n_overrides = o->n_overrides,
                            .override = o->override,
                            .context = &line,
                            .tell = tell,
                            .record = o->json ? print_row : NULL};
  gg_bench b;
  gg_error err;
  if (o->more[0])
    return gg_cli_fail(GG_BAD_INPUT, "bench %s takes no file; '%s' is one too many", o->input, o->more[0]);
  gg_cli_line_start(&line, o->quiet);
  const gg_status status = gg_bench_run(&b, o->input, &asked, &err);
  gg_cli_line_clear(&line);
  int code = b.measured && !o->json ? print(&b) : GG_OK;
  if (status != GG_OK) code = gg_cli_report(&err);
  gg_bench_clear(&b);
  return code;
}

int gg_cli_bench_main(const gg_options *o)
{
  return o->input && strcmp(o->input, "compare") == 0 ? compare(o) : measure(o);
}
