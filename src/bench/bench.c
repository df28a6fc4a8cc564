/* graingas bench: how fast things are. The frame: which subject, and what it measured printed. */
#include "bench/bench.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/document.h"

static const struct {
  const char *name; /* the word typed; NULL: none */
  gg_bench_subject *run;
} subjects[] = {
    {NULL, gg_bench_overview},
    {"md", gg_bench_md},
    {"dsmc", gg_bench_dsmc},
    {"observables", gg_bench_observables},
};
enum { N_SUBJECTS = sizeof subjects / sizeof *subjects };

gg_bench_sheet *gg_bench_new_sheet(gg_bench *b, const char *key, const char *caption, int keep, gg_error *err)
{
  gg_bench_sheet *s = b->n_sheets < GG_BENCH_SHEETS ? &b->sheet[b->n_sheets++] : NULL;
  if (s) *s = (gg_bench_sheet){key, caption, keep, gg_table_new(), json_array()};
  if (s && s->table && s->rows) return s;
  gg_fail(err, GG_FAILED, "out of memory");
  return NULL;
}

void gg_bench_cell(gg_bench_sheet *sheet, int row, int column, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  vsnprintf(gg_table_cell(sheet->table, row, column), GG_TABLE_CELL, format, list);
  va_end(list);
}

int gg_bench_density_column(gg_bench_sheet *sheet, double phi)
{
  char head[24];
  snprintf(head, sizeof head, "phi %.4g", phi);
  return gg_table_column(sheet->table, head, true);
}

void gg_bench_tell(const gg_bench *b, const char *format, ...)
{
  if (b->options->quiet) return;
  va_list list;
  va_start(list, format);
  vfprintf(stderr, format, list);
  va_end(list);
  fputc('\n', stderr);
}

gg_scene gg_bench_scene(const gg_bench *b, gg_engine_kind engine, double phi, int64_t n)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine;
  s.phi = phi;
  s.particles = s.dsmc.particles = n;
  s.run.seed = b->seed;
  return s;
}

/* The overrides that options stand for (--seed), checked as a scene's are. */
static gg_status take_seed(gg_bench *b, gg_error *err)
{
  gg_scene_draft draft;
  gg_scene_draft_start(&draft);
  for (int i = 0; i < b->options->n_overrides; i++) {
    const char *equals = strchr(b->options->override[i], '=');
    char key[96];
    snprintf(key, sizeof key, "%.*s", (int)(equals - b->options->override[i]), b->options->override[i]);
    GG_TRY(gg_scene_draft_set(&draft, key, equals + 1, err));
  }
  b->seed = draft.scene.run.seed;
  return GG_OK;
}

static void print_json(const gg_bench *b)
{
  json_t *document = json_pack("{s:s}", "graingas", gg_version());
  for (int i = 0; i < b->n_sheets; i++) json_object_set(document, b->sheet[i].key, b->sheet[i].rows);
  char *text = gg_document_text(document);
  if (text) puts(text);
  free(text);
  json_decref(document);
}

static int print(const gg_bench *b)
{
  if (b->options->json) print_json(b);
  for (int i = 0; i < b->n_sheets && !b->options->json; i++) {
    if (i) putchar('\n');
    gg_print_wrapped(stdout, "", b->sheet[i].caption, gg_terminal_width());
    putchar('\n');
    gg_table_print(b->sheet[i].table, stdout, gg_terminal_width(), b->sheet[i].keep);
  }
  return fflush(stdout) == 0 ? GG_OK : gg_cli_fail(GG_BAD_FILE, "standard output cannot be written");
}

static int run(const gg_options *o, gg_bench_subject *subject)
{
  gg_bench b = {.options = o};
  gg_error err;
  gg_status status = take_seed(&b, &err);
  if (status == GG_OK) status = subject(&b, &err);
  int code = status == GG_OK ? print(&b) : gg_cli_report(&err);
  for (int i = 0; i < b.n_sheets; i++) {
    free(b.sheet[i].table);
    json_decref(b.sheet[i].rows);
  }
  return code;
}

static int refuse(const char *word)
{
  char allowed[64] = "";
  for (int i = 0; i < N_SUBJECTS; i++)
    if (subjects[i].name)
      snprintf(allowed + strlen(allowed), sizeof allowed - strlen(allowed), "%s%s", *allowed ? ", " : "",
               subjects[i].name);
  return gg_cli_fail(GG_BAD_INPUT, "bench: '%s' is not known; allowed: %s, or nothing for an overview", word, allowed);
}

int gg_cli_bench_main(const gg_command *command, int argc, char **argv)
{
  gg_options o;
  int code = gg_options_parse(command, argc, argv, &o), i = 0;
  while (i < N_SUBJECTS && (o.input ? !subjects[i].name || strcmp(o.input, subjects[i].name) != 0 : i > 0)) i++;
  if (code == GG_CLI_GO_ON) code = i < N_SUBJECTS ? run(&o, subjects[i].run) : refuse(o.input);
  gg_options_clear(&o);
  return code;
}
