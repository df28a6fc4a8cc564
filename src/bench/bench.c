/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/bench.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/build.h"
#include "base/machine.h"
#include "base/memory.h"
#include "base/text.h"
#include "scene/scene_reader.h"
#include "simd/dispatch.h"

static const struct {
  const char *name; /* word of the command line; NULL: the overview */
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

/* Name of a row: "ratios: md, walls, phi 0.3, particles 10000". A true member gives its key, a false one nothing. */
static void name_row(const char *table, json_t *members, char *name, size_t size)
{
  const char *key;
  json_t *member;
  snprintf(name, size, "%s:", table);
  json_object_foreach(members, key, member)
  {
    if (json_is_false(member)) continue;
    gg_base_text_append(name, size, "%s ", name[strlen(name) - 1] == ':' ? "" : ",");
    if (json_is_string(member))
      gg_base_text_append(name, size, "%s", json_string_value(member));
    else if (json_is_number(member))
      gg_base_text_append(name, size, "%s %.10g", key, json_number_value(member));
    else
      gg_base_text_append(name, size, "%s", key);
  }
}

/* Machine, time and build of a measurement. */
static json_t *origin(void)
{
  char processor[200], date[32];
  gg_base_machine_processor(processor, sizeof processor);
  gg_base_machine_date(date, sizeof date);
  return json_pack("{s:{s:s, s:I}, s:s, s:s, s:s}", "machine", "cpu", processor, "cores",
                   (json_int_t)gg_base_machine_cores(), "version", gg_base_build_version, "instructions",
                   gg_simd_instructions_name(gg_simd_instructions_best()), "time", date);
}

void gg_bench_table_add(const gg_bench *b, gg_bench_table *s, gg_bench_value v, json_t *more, const char *format, ...)
{
  char name[200];
  va_list list;
  va_start(list, format);
  json_t *members = json_vpack_ex(NULL, 0, format, list);
  va_end(list);
  name_row(s->key, members, name, sizeof name);
  json_t *row = json_pack("{s:s, s:s, s:o, s:o, s:o, s:i, s:i}", "name", name, "unit", v.unit, "value",
                          gg_io_json_finite(v.value), "lowest", gg_io_json_finite(v.lowest), "highest",
                          gg_io_json_finite(v.highest), "repeats", v.repeats, "threads", v.threads > 1 ? v.threads : 1);
  json_object_update_new(row, members);
  if (more) json_object_update_new(row, more);
  json_object_update_new(row, origin());
  char *line = NULL;
  if (b->options->record && gg_base_memory_failures() == b->failures)
    line = gg_io_json_text(row, JSON_COMPACT | JSON_REAL_PRECISION(12));
  if (line) b->options->record(b->options->context, line);
  free(line);
  json_array_append_new(s->rows, row);
}

void gg_bench_report(const gg_bench *b, const char *format, ...)
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

/* Apply the overrides of options (--seed), checked like those of a scene. */
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
    if (subjects[i].name) gg_base_text_append(allowed, sizeof allowed, "%s%s", *allowed ? ", " : "", subjects[i].name);
  return GG_REFUSE(err, "bench: '%s' is not known; allowed: %s, compare, or nothing for an overview", word, allowed);
}

gg_status gg_bench_run(gg_bench *b, const char *subject, const gg_bench_options *options, gg_error *err)
{
  int i = 0;
  *b = (gg_bench){.options = options, .failures = gg_base_memory_failures()};
  while (i < N_SUBJECTS && (subject ? !subjects[i].name || strcmp(subject, subjects[i].name) != 0 : i > 0)) i++;
  if (i == N_SUBJECTS) return refuse(subject, err);
  if (options->picture && subjects[i].run != gg_bench_error)
    return GG_REFUSE(err, "bench: --picture is for bench error, which has one");
  GG_TRY(take_seed(b, err));
  const gg_status status = subjects[i].run(b, err);
  if (gg_base_memory_failures() != b->failures) return b->measured = false, gg_base_out_of_memory(err);
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
