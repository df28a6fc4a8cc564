/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench compare: two files of rows, compared row by row. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "bench/bench.h"

typedef struct bounds {
  double value, lowest, highest;
} bounds;

typedef struct comparison {
  FILE *out;
  bool json;
  double limit; /* a ratio of times; INFINITY: none */
  int compared, slower, faster, beyond_limit;
} comparison;

static gg_status add_line(json_t *rows, const char *path, int number, const char *line, gg_error *err)
{
  json_auto_t *row = gg_io_json_read(line, NULL);
  const char *name = gg_io_json_string(row, "name");
  const bool good = *name && gg_base_text_is_printable(name) && *gg_io_json_string(row, "unit");
  if (good) json_object_set(rows, name, row);
  return good
             ? GG_OK
             : gg_base_fail(err, GG_BAD_FILE, "%s, line %d: not a row that graingas bench --json prints", path, number);
}

/* Read a file; of several rows with one name, the last counts. */
static gg_status read_rows(const char *path, json_t *rows, gg_error *err)
{
  GG_FREED char *line = NULL;
  size_t room = 0;
  GG_CLOSED FILE *in = fopen(path, "r");
  if (!in) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
  for (int n = 1; getline(&line, &room, in) > 0; n++) GG_TRY(add_line(rows, path, n, line, err));
  if (json_object_size(rows) > 0) return GG_OK;
  return gg_base_fail(err, GG_BAD_FILE, "%s: no rows that graingas bench --json prints", path);
}

/* The time of a row, for rates their inverse. */
static bounds time_of(const json_t *row)
{
  static const char rate[] = "second";
  const char *unit = gg_io_json_string(row, "unit");
  const size_t n = strlen(unit);
  const bounds v = {gg_io_json_number(row, "value"), gg_io_json_number(row, "lowest"),
                    gg_io_json_number(row, "highest")};
  if (n < sizeof rate || strcmp(unit + n + 1 - sizeof rate, rate) != 0) return v;
  return (bounds){1 / v.value, 1 / v.highest, 1 / v.lowest};
}

static bool is_same_kind(const json_t *a, const json_t *b)
{
  return b && strcmp(gg_io_json_string(a, "unit"), gg_io_json_string(b, "unit")) == 0 &&
         gg_io_json_number(a, "threads") == gg_io_json_number(b, "threads");
}

static void print_row(comparison *c, const char *name, bounds r, const char *word)
{
  if (c->json) {
    json_t *row = json_pack("{s:s, s:s, s:f, s:f, s:f, s:s}", "name", name, "unit", "time after over time before",
                            "value", r.value, "lowest", r.lowest, "highest", r.highest, "beyond_spread", word);
    char *line = gg_io_json_text(row, JSON_COMPACT | JSON_REAL_PRECISION(12));
    if (line) fprintf(c->out, "%s\n", line);
    free(line);
    json_decref(row);
  } else {
    fprintf(c->out, "%5.2f (%.2f - %.2f) %-10s  %s\n", r.value, r.lowest, r.highest, word, name);
  }
}

static void compare_row(comparison *c, const char *name, const json_t *before, const json_t *after)
{
  const bounds a = time_of(before), b = time_of(after);
  const bounds r = {b.value / a.value, b.lowest / a.highest, b.highest / a.lowest};
  if (!is_same_kind(before, after) || !(r.lowest > 0 && isfinite(r.highest) && isfinite(r.value))) return;
  const bool beyond = r.lowest > c->limit;
  c->compared++;
  c->slower += r.lowest > 1;
  c->faster += r.highest < 1;
  c->beyond_limit += beyond;
  print_row(c, name, r, beyond ? "over limit" : r.lowest > 1 ? "slower" : r.highest < 1 ? "faster" : "");
}

/* Print "before: b.json, 0.1.0+g156f34b3, AMD EPYC, 2 cores, AVX-512, 2024-05-31T12:00:00Z", from the first row. */
static void print_origin(FILE *out, const char *word, const char *path, json_t *rows)
{
  const json_t *row = json_object_iter_value(json_object_iter(rows)), *machine = json_object_get(row, "machine");
  char line[1000];
  snprintf(line, sizeof line, "%s: %s, %s, %s, %g cores, %s, %s", word, path, gg_io_json_string(row, "version"),
           gg_io_json_string(machine, "cpu"), gg_io_json_number(machine, "cores"),
           gg_io_json_string(row, "instructions"), gg_io_json_string(row, "time"));
  gg_base_text_make_printable(line);
  fprintf(out, "%s\n", line);
}

static void print_all(comparison *c, const char *const path[2], json_t *const rows[2])
{
  const char *name;
  json_t *row;
  if (!c->json) {
    print_origin(c->out, "before", path[0], rows[0]);
    print_origin(c->out, "after", path[1], rows[1]);
    fprintf(c->out, "\nTime after over time before: of the medians (least - largest of repeats).\n\n");
  }
  json_object_foreach(rows[0], name, row) compare_row(c, name, row, json_object_get(rows[1], name));
  if (!c->json)
    fprintf(c->out, "\n%d rows in both with repeats; beyond their spread %d slower, %d faster\n", c->compared,
            c->slower, c->faster);
}

static gg_status compare(comparison *c, const char *const path[2], json_t *const rows[2], char **text, gg_error *err)
{
  for (int k = 0; k < 2; k++) GG_TRY(read_rows(path[k], rows[k], err));
  c->out = gg_base_memory_stream_open(text);
  if (!c->out) return gg_base_out_of_memory(err);
  print_all(c, path, rows);
  if (!gg_base_memory_stream_close(c->out, text)) return gg_base_out_of_memory(err);
  if (c->compared == 0)
    return gg_base_fail(err, GG_BAD_FILE, "%s and %s have no rows in common that have repeats", path[0], path[1]);
  if (c->beyond_limit == 0) return GG_OK;
  return gg_base_fail(err, GG_FAILED, "%d of %d rows are slower by more than %g %% beyond their spread",
                      c->beyond_limit, c->compared, 100 * (c->limit - 1));
}

gg_status gg_bench_compare(const char *before, const char *after, double limit, bool json, char **text, gg_error *err)
{
  const unsigned failures = gg_base_memory_failures();
  comparison c = {.json = json, .limit = limit < 0 ? INFINITY : 1 + limit / 100};
  const char *const path[2] = {before, after};
  *text = NULL;
  json_t *const rows[2] = {json_object(), json_object()};
  const gg_status status = compare(&c, path, rows, text, err);
  for (int k = 0; k < 2; k++) json_decref(rows[k]);
  if (gg_base_memory_failures() == failures) return status;
  free(*text);
  *text = NULL;
  return gg_base_out_of_memory(err);
}
