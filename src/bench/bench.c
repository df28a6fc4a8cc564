#include "bench/bench.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "files/result_document.h"
#include "graingas.h"
#include "scene/scene_reader.h"

static const struct {
  const char *name; /* the word typed; NULL: none */
  gg_bench_subject *run;
} subjects[] = {
    {NULL, gg_bench_overview}, {"md", gg_bench_md}, {"dsmc", gg_bench_dsmc}, {"observables", gg_bench_observables},
    {"error", gg_bench_error},
};
enum { N_SUBJECTS = sizeof subjects / sizeof *subjects, LEAST_GRAINS = 500 };

gg_bench_table *gg_bench_table_new(gg_bench *b, const char *key, const char *caption, int keep, gg_error *err)
{
  gg_bench_table *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return NULL;
  *s = (gg_bench_table){.key = key, .caption = caption, .keep = keep, .rows = json_array()};
  if (s->rows && b->n_tables < GG_BENCH_TABLES) return b->table[b->n_tables++] = s;
  gg_base_out_of_memory(err);
  json_decref(s->rows);
  free(s);
  return NULL;
}

int gg_bench_table_column(gg_bench_table *s, bool right, const char *format, ...)
{
  const int column = s->n_columns < GG_BENCH_COLUMNS ? s->n_columns++ : GG_BENCH_COLUMNS - 1;
  va_list list;
  va_start(list, format);
  vsnprintf(s->head[column], GG_BENCH_CELL, format, list);
  va_end(list);
  s->right[column] = right;
  return column;
}

int gg_bench_table_row(gg_bench_table *s, const char *format, ...)
{
  const int row = s->n_rows < GG_BENCH_ROWS ? s->n_rows++ : GG_BENCH_ROWS - 1;
  va_list list;
  va_start(list, format);
  vsnprintf(s->cell[row][0], GG_BENCH_CELL, format, list);
  va_end(list);
  return row;
}

void gg_bench_table_put(gg_bench_table *s, int row, int column, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  vsnprintf(s->cell[row][column], GG_BENCH_CELL, format, list);
  va_end(list);
}

void gg_bench_table_add(gg_bench_table *s, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  json_array_append_new(s->rows, json_vpack_ex(NULL, 0, format, list));
  va_end(list);
}

void gg_bench_tell(const gg_bench *b, const char *format, ...)
{
  char line[160];
  va_list list;
  if (!b->options->tell) return;
  va_start(list, format);
  vsnprintf(line, sizeof line, format, list);
  va_end(list);
  b->options->tell(b->options->context, line);
}

static double smaller(const gg_bench *b)
{
  return b->options->smaller > 1 ? b->options->smaller : 1;
}

double gg_bench_seconds(const gg_bench *b, double seconds)
{
  return seconds / smaller(b);
}

gg_scene gg_bench_scene(const gg_bench *b, gg_engine_kind engine, double phi, int64_t n)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine;
  s.phi = phi;
  const int64_t fewer = (int64_t)((double)n / smaller(b));
  s.particles = s.dsmc.particles = fewer < n && fewer < LEAST_GRAINS ? LEAST_GRAINS : fewer;
  s.run.seed = b->seed;
  return s;
}

/* The overrides that options stand for (--seed), checked as a scene's are. */
static gg_status take_seed(gg_bench *b, gg_error *err)
{
  gg_scene scene = gg_scene_defaults();
  for (int i = 0; i < b->options->n_overrides; i++) {
    const char *equals = strchr(b->options->override[i], '=');
    char key[96];
    snprintf(key, sizeof key, "%.*s", (int)(equals - b->options->override[i]), b->options->override[i]);
    GG_TRY(gg_scene_override(&scene, key, equals + 1, err));
  }
  b->seed = scene.run.seed;
  return GG_OK;
}

static gg_status refuse(const char *word, gg_error *err)
{
  char allowed[64] = "";
  for (int i = 0; i < N_SUBJECTS; i++)
    if (subjects[i].name)
      snprintf(allowed + strlen(allowed), sizeof allowed - strlen(allowed), "%s%s", *allowed ? ", " : "",
               subjects[i].name);
  return gg_base_fail(err, GG_BAD_INPUT, "bench: '%s' is not known; allowed: %s, or nothing for an overview", word,
                      allowed);
}

gg_status gg_bench_run(gg_bench *b, const char *subject, const gg_bench_options *options, gg_error *err)
{
  int i = 0;
  *b = (gg_bench){.options = options};
  while (i < N_SUBJECTS && (subject ? !subjects[i].name || strcmp(subject, subjects[i].name) != 0 : i > 0)) i++;
  if (i == N_SUBJECTS) return refuse(subject, err);
  if (options->picture && subjects[i].run != gg_bench_error)
    return gg_base_fail(err, GG_BAD_INPUT, "bench: --picture is for bench error, which has one");
  GG_TRY(take_seed(b, err));
  const gg_status status = subjects[i].run(b, err);
  b->measured |= status == GG_OK;
  return status;
}

void gg_bench_clear(gg_bench *b)
{
  for (int i = 0; i < b->n_tables; i++) {
    json_decref(b->table[i]->rows);
    free(b->table[i]);
  }
  *b = (gg_bench){0};
}

char *gg_bench_document(const gg_bench *b)
{
  json_t *document = json_pack("{s:s}", "graingas", gg_version());
  for (int i = 0; i < b->n_tables; i++) {
    json_t *there = json_object_get(document, b->table[i]->key); /* tables of one key are one */
    if (there)
      json_array_extend(there, b->table[i]->rows);
    else
      json_object_set_new(document, b->table[i]->key, json_copy(b->table[i]->rows));
  }
  char *text = document ? gg_files_document_text(document) : NULL;
  json_decref(document);
  return text;
}
