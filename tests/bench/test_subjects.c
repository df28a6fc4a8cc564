/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every table of graingas bench, of small systems and short stretches: whole, its numbers what they say; and what is
 * refused. `bench_subjects quick`: the tables of --quick alone, without those of errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/thread_pool.h"
#include "bench/bench.h"
#include "graingas.h"

static int reports;
static json_t *recorded; /* rows of the present bench, as they came */
static int full_too = 1;

static void report(void *context, const char *line)
{
  (void)context;
  assert_true(*line && !strchr(line, '\n'));
  reports++;
}

static void record(void *context, const char *line)
{
  (void)context;
  assert_null(strchr(line, '\n'));
  json_array_append_new(recorded, json_loads(line, 0, NULL));
}

/* In the overview the rows of a size are recorded before it is reported as done. */
static void report_after_rows(void *context, const char *line)
{
  static size_t before;
  if (!reports) before = 0;
  assert_true(json_array_size(recorded) > before);
  before = json_array_size(recorded);
  report(context, line);
}

static double of(const json_t *row, const char *key)
{
  const json_t *value = json_object_get(row, key);
  if (!json_is_number(value)) fail_msg("%s is missing", key);
  return json_number_value(value);
}

static double of_two(const json_t *row, const char *key, const char *end)
{
  char name[64];
  snprintf(name, sizeof name, "%s_%s", key, end);
  return of(row, name);
}

/* Each cell of the table is filled, and each row of the record has what was measured between its bounds, and so has
 * what else it has (NULL: nothing): a ratio, an overhead. */
static void assert_whole(const gg_bench_table *s, const char *also)
{
  size_t i;
  json_t *row;
  assert_true(s->n_rows > 0 && s->n_columns > 1 && json_array_size(s->rows) > 0);
  for (int c = 0; c < s->n_columns; c++) {
    int filled = 0;
    assert_true(strlen(s->head[c]) > 0 && strlen(s->head[c]) < GG_BENCH_CELL - 1);
    for (int r = 0; r < s->n_rows; r++) filled += s->cell[r][c][0] != 0;
    if (strcmp(s->head[c], "against") != 0 && filled < s->n_rows) fail_msg("%s: %s", s->key, s->head[c]);
  }
  json_array_foreach(s->rows, i, row)
  {
    const double m = of(row, "value"), low = of(row, "lowest"), high = of(row, "highest");
    if (!(0 < low && low <= m && m <= high)) fail_msg("%s: %g is not from %g to %g", s->key, m, low, high);
    assert_true(of(row, "repeats") >= 3 && of(row, "threads") >= 1 && json_object_get(row, "unit"));
    if (also)
      assert_true(of_two(row, also, "lowest") <= of(row, also) && of(row, also) <= of_two(row, also, "highest"));
  }
}

static bool is_word(const json_t *row, const char *key, const char *word)
{
  return strcmp(json_string_value(json_object_get(row, key)), word) == 0;
}

/* Ratios: every scene once at each density, the one that it is set beside among them; one beside itself is 1. */
static void assert_beside(const gg_bench_table *s, const char *unit)
{
  size_t i, k;
  json_t *row, *other;
  assert_whole(s, "ratio");
  assert_int_equal(json_array_size(s->rows), s->n_rows * (s->n_columns - 2));
  json_array_foreach(s->rows, i, row)
  {
    const char *against = json_string_value(json_object_get(row, "against"));
    int itself = 0, beside = 0;
    json_array_foreach(s->rows, k, other)
    {
      if (of(other, "phi") != of(row, "phi")) continue;
      itself += is_word(other, "scene", json_string_value(json_object_get(row, "scene")));
      beside += is_word(other, "scene", against);
    }
    if (itself != 1 || beside != 1) fail_msg("%s: row %zu: %d, %d of '%s'", s->key, i, itself, beside, against);
    assert_true(is_word(row, "unit", unit) && of(row, "ratio_lowest") > 0);
    assert_true(!is_word(row, "scene", against) || of(row, "ratio") == 1);
  }
}

static const gg_bench_table *table_of(const gg_bench *b, const char *key)
{
  for (int i = 0; i < b->n_tables; i++)
    if (strcmp(b->table[i]->key, key) == 0) return b->table[i];
  fail_msg("there is no table '%s'", key);
  return NULL;
}

static void begin(gg_bench *b, gg_bench_options *o, const char *subject)
{
  gg_error err;
  reports = 0;
  recorded = json_array();
  o->record = record;
  if (gg_bench_run(b, subject, o, &err) != GG_OK) fail_msg("%s", err.message);
}

/* The record has every row in a line, with a name of its own, where and when it was measured and by which build, and
 * nothing else. */
static void end(gg_bench *b)
{
  json_t *names = json_object(), *row;
  size_t rows = 0, i;
  for (int t = 0; t < b->n_tables; t++) rows += json_array_size(b->table[t]->rows);
  assert_int_equal(json_array_size(recorded), rows);
  json_array_foreach(recorded, i, row)
  {
    const json_t *machine = json_object_get(row, "machine");
    assert_true(json_is_string(json_object_get(machine, "cpu")) && of(machine, "cores") >= 1);
    assert_true(is_word(row, "version", gg_version()));
    assert_true(json_is_string(json_object_get(row, "instructions")));
    assert_int_equal(strlen(json_string_value(json_object_get(row, "time"))), strlen("2024-05-31T12:00:00Z"));
    json_object_set(names, json_string_value(json_object_get(row, "name")), row);
  }
  if (json_object_size(names) != rows) fail_msg("%zu names of %zu rows", json_object_size(names), rows);
  json_decref(names);
  json_decref(recorded);
  gg_bench_clear(b);
  assert_int_equal(b->n_tables, 0);
}

static bool has_scene(const gg_bench_table *s, const char *name)
{
  size_t i;
  json_t *row;
  json_array_foreach(s->rows, i, row) if (is_word(row, "scene", name)) return true;
  return false;
}

static int count_scenes(const gg_bench_table *s, const char *name, const char *engine)
{
  int n = 0;
  size_t i;
  json_t *row;
  json_array_foreach(s->rows, i, row) n += is_word(row, "scene", name) && is_word(row, "engine", engine);
  return n;
}

/* Scenes of the overview: each kind that a nightly run is to watch, walls and baths at three densities. */
static void check_scenes(const gg_bench_table *s)
{
  static const struct {
    const char *name, *engine;
    int rows;
  } kinds[] = {
      {"elastic", "md", 1},           {"white noise, e = 0.99", "md", 1},     {"white noise, e = 0.9", "md", 1},
      {"bath, e = 0.9", "md", 3},     {"bath, e = 0.9, beta = 0.5", "md", 3}, {"walls (couette), e = 0.9", "md", 3},
      {"start, per grain", "md", 2},  {"white noise, e = 0.9", "dsmc", 1},    {"walls (couette), e = 0.9", "dsmc", 3},
      {"start, per grain", "dsmc", 1}};
  size_t i;
  json_t *row;
  int rows = 0;
  assert_whole(s, NULL);
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    assert_int_equal(count_scenes(s, kinds[k].name, kinds[k].engine), kinds[k].rows);
    rows += kinds[k].rows;
  }
  assert_int_equal(s->n_rows, rows);
  assert_int_equal(json_array_size(s->rows), rows);
  json_array_foreach(s->rows, i, row) assert_true(
      is_word(row, "unit", is_word(row, "scene", "start, per grain") ? "ns per grain" : "ns per collision"));
}

/* Tables of two threads from number `first` on, one without and one with a neighbour in turn. The neighbour of the
 * second has a hundredth of a processor at least, also on a machine with many other processes. */
static void check_threads(const gg_bench *b, int first, int tables)
{
  size_t i;
  json_t *row;
  assert_int_equal(b->n_tables, first + tables);
  for (int t = 0; t < tables; t++) {
    const gg_bench_table *s = b->table[first + t];
    assert_string_equal(s->key, t % 2 ? "threads, busy neighbour" : "threads");
    assert_whole(s, "ratio");
    json_array_foreach(s->rows, i, row)
    {
      assert_int_equal(of(row, "threads"), 2);
      assert_true(is_word(row, "unit", "ns per collision, wall time") && of(row, "processors") > 0);
      assert_true(t % 2 ? of(row, "neighbour") > 0.01 : of(row, "neighbour") == 0);
    }
  }
}

static void the_overview_has_every_engine_density_and_size(void **state)
{
  (void)state;
  gg_bench b;
  for (int quick = !full_too; quick < 2; quick++) {
    gg_bench_options o = {.quick = quick, .smaller = 200, .threads = 4, .tell = report_after_rows};
    const int processors = gg_base_processors();
    begin(&b, &o, NULL);
    assert_int_equal(gg_base_processors(), processors); /* those that were left to a neighbour are given back */
    const gg_bench_table *s = table_of(&b, "throughput");
    assert_whole(s, NULL);
    assert_int_equal(s->n_rows, 2 * 2 * (quick ? 2 : 3)); /* engines, densities, sizes */
    assert_int_equal(reports, s->n_rows + table_of(&b, "scenes")->n_rows + 4);
    assert_int_equal(json_array_size(s->rows), 3 * s->n_rows);
    check_scenes(table_of(&b, "scenes"));
    check_threads(&b, 2, 4);
    end(&b);
  }
}

static void md_has_its_rows_and_ratios(void **state)
{
  (void)state;
  static const char *const scenes[] = {
      "smooth",       "rough", "two species", "walls", "walls, gravity", "sheared frictional", "white noise, e = 0.9",
      "bath, e = 0.9"};
  gg_bench b;
  for (int quick = !full_too; quick < 2; quick++) {
    gg_bench_options o = {.quick = quick, .smaller = 1000, .threads = quick ? 2 : 1, .tell = report};
    begin(&b, &o, "md");
    assert_whole(table_of(&b, "collisions"), NULL);
    assert_int_equal(table_of(&b, "collisions")->n_rows, quick ? 2 : 4);
    assert_beside(table_of(&b, "ratios"), "collisions per CPU-second");
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++)
      assert_true(has_scene(table_of(&b, "ratios"), scenes[k]));
    check_threads(&b, 2, quick ? 4 : 0);
    end(&b);
  }
}

static void dsmc_has_its_rows_and_ratios(void **state)
{
  (void)state;
  gg_bench b;
  for (int quick = !full_too; quick < 2; quick++)
    for (int threads = 1; threads <= (quick ? 2 : 1); threads++) {
      gg_bench_options o = {.quick = quick, .smaller = 1000, .threads = threads, .tell = report};
      begin(&b, &o, "dsmc");
      assert_whole(table_of(&b, "times"), NULL);
      assert_whole(table_of(&b, "walls"), NULL);
      assert_beside(table_of(&b, "ratios"), "ns per collision");
      assert_whole(table_of(&b, "precision"), "ratio");
      assert_whole(table_of(&b, "paths"), "ratio");
      check_threads(&b, 5, threads > 1 ? 2 : 0);
      end(&b);
    }
}

/* A row for each observable, engine, density and size that can have it: each a filled cell; "-" where none can. */
static void every_observable_has_its_cost_or_a_dash(void **state)
{
  (void)state;
  static const char *const md_alone[] = {"pair_correlation",    "velocity_correlations",      "structure", "cells",
                                         "local_distributions", "local_velocity_correlations"};
  gg_bench b;
  gg_bench_options o = {
      .quick = true, .smaller = full_too ? 2 : 20, .tell = report}; /* systems of 500 grains, or three sizes */
  begin(&b, &o, "observables");
  const gg_bench_table *s = table_of(&b, "observables");
  assert_whole(s, "overhead");
  assert_int_equal(reports, s->n_rows);
  assert_int_equal(s->n_columns, 1 + 2 * 2 * (full_too ? 3 : 1)); /* engines, densities, sizes */
  size_t next = 0;
  double most = -1;
  for (int r = 0; r < s->n_rows; r++) {
    const bool nowhere = strcmp(s->cell[r][0], "helfand") == 0 || strcmp(s->cell[r][0], "shear_wave") == 0;
    bool of_md = !nowhere && strcmp(s->cell[r][0], "conductivity") != 0, of_dsmc = !nowhere;
    for (size_t k = 0; k < sizeof md_alone / sizeof *md_alone; k++) of_dsmc &= strcmp(s->cell[r][0], md_alone[k]) != 0;
    for (int c = 1; c < s->n_columns; c++) {
      bool dsmc = strncmp(s->head[c], "dsmc", 4) == 0, there = strcmp(s->cell[r][c], "-") != 0;
      if (there != (dsmc ? of_dsmc : of_md)) fail_msg("%s, %s: %s", s->cell[r][0], s->head[c], s->cell[r][c]);
      if (!there) continue;
      const json_t *row = json_array_get(s->rows, next++);
      assert_true(is_word(row, "observable", s->cell[r][0]) && is_word(row, "engine", dsmc ? "dsmc" : "md"));
      assert_true(is_word(row, "unit", "ns per collision") && of(row, "particles") > 0);
      most = fmax(most, of(row, "overhead"));
    }
  }
  assert_int_equal(next, json_array_size(s->rows));
  print_message("# the largest overhead: %g\n", most);
  assert_true(most > 0.25); /* 0.6; upside down none is above 0 but by noise */
  end(&b);
}

/* A number, or null where there is none. */
static bool is_null_or_number(const json_t *row, const char *key)
{
  const json_t *value = json_object_get(row, key);
  return json_is_null(value) || (json_is_real(value) && isfinite(json_real_value(value)));
}

/* A table a state: a row a quantity; seconds to 1, 0.1 and 0.01 % of md and of dsmc, and who has it first. */
static void check_state(const gg_bench_table *seconds, const char *title, int rows)
{
  size_t i;
  json_t *row;
  assert_string_equal(seconds->title, title);
  assert_int_equal(seconds->n_rows, rows);
  assert_int_equal(seconds->n_columns, 8);
  json_array_foreach(seconds->rows, i, row)
  {
    assert_true(is_null_or_number(row, "error_of_a_second") && is_null_or_number(row, "floor"));
    const json_t *until = json_object_get(row, "seconds_to_0.01_0.001_0.0001");
    assert_int_equal(json_array_size(until), 3);
    assert_int_equal(json_array_size(json_object_get(row, "seconds")), json_array_size(json_object_get(row, "stderr")));
  }
  assert_int_equal(i, rows * 12); /* by every way */
  for (int r = 0; r < rows; r++) {
    const char *cell = seconds->cell[r][1], *first = seconds->cell[r][7];
    assert_true(strcmp(cell, "never") == 0 || strcmp(cell, "?") == 0 || strstr(cell, " s, N "));
    assert_true(strncmp(first, "md", 2) == 0 || strncmp(first, "dsmc", 4) == 0 || strcmp(first, "?") == 0 ||
                strcmp(first, "-") == 0);
  }
}

static void every_state_has_time_against_error_and_a_picture(void **state)
{
  (void)state;
  static const char *const pictures[] = {"error_phi-0.01-e-0.9-rough-shear.svg", "error_phi-0.3-e-0.9-rough-shear.svg",
                                         "error_phi-0.01-e-0.9-smooth-shear.svg",
                                         "error_phi-0.01-e-0.9-rough-cooling.svg"};
  gg_bench b;
  const char *picture = system("command -v gnuplot >/dev/null") == 0 ? "error.svg" : NULL;
  gg_bench_options o = {.quick = true, .smaller = 100, .tell = report, .picture = picture};
  begin(&b, &o, "error");
  assert_true(reports >= 4 * 12); /* each way of each state */
  assert_int_equal(b.n_tables, 4 + 1);
  static const char *const titles[] = {"phi 0.01, e 0.9, rough, shear", "phi 0.3, e 0.9, rough, shear",
                                       "phi 0.01, e 0.9, smooth, shear", "phi 0.01, e 0.9, rough, cooling"};
  static const int rows[] = {5, 5, 4, 5}; /* smooth grains have no theta */
  for (int t = 0; t < 4; t++) check_state(b.table[t], titles[t], rows[t]);
  const gg_bench_table *floors = table_of(&b, "floors");
  assert_int_equal(floors->n_rows, 19);
  size_t i;
  json_t *row;
  json_array_foreach(floors->rows, i, row)
  {
    assert_true(is_null_or_number(row, "truth") && is_null_or_number(row, "step_order"));
    assert_true(strlen(json_string_value(json_object_get(row, "source"))) > 0);
  }
  size_t seconds = 0;
  for (int k = 0; k < b.n_tables; k++)
    if (strcmp(b.table[k]->key, "seconds") == 0) seconds += json_array_size(b.table[k]->rows);
  assert_int_equal(seconds, 19 * 12); /* of all states */
  for (int t = 0; picture && t < 4; t++) assert_int_equal(remove(pictures[t]), 0);
  end(&b);
}

static void refuse(const char *subject, gg_bench_options o, const char *said)
{
  gg_bench b;
  gg_error err = {0};
  assert_int_equal(gg_bench_run(&b, subject, &o, &err), GG_BAD_INPUT);
  if (!strstr(err.message, said)) fail_msg("'%s' lacks '%s'", err.message, said);
  assert_int_equal(b.n_tables, 0);
  gg_bench_clear(&b);
}

static void bad_options_are_refused(void **state)
{
  (void)state;
  static const char *const bad[] = {"run.seed=-1"};
  refuse("rubbish", (gg_bench_options){0},
         "'rubbish' is not known; allowed: md, dsmc, observables, error, compare, or nothing");
  refuse("md", (gg_bench_options){.picture = "x.svg"}, "--picture is for bench error");
  refuse(NULL, (gg_bench_options){.picture = "x.svg"}, "--picture is for bench error");
  refuse("error", (gg_bench_options){.picture = "x.gif", .smaller = 100}, "x.gif");
  refuse("md", (gg_bench_options){.n_overrides = 1, .override = bad}, "run.seed");
}

int main(int argc, char **argv)
{
  full_too = !(argc > 1 && strcmp(argv[1], "quick") == 0);
  char folder[] = "/tmp/graingas-bench-XXXXXX";
  const struct CMUnitTest quick[] = {cmocka_unit_test(the_overview_has_every_engine_density_and_size),
                                     cmocka_unit_test(md_has_its_rows_and_ratios),
                                     cmocka_unit_test(dsmc_has_its_rows_and_ratios),
                                     cmocka_unit_test(every_observable_has_its_cost_or_a_dash),
                                     cmocka_unit_test(bad_options_are_refused)},
                          full[] = {cmocka_unit_test(the_overview_has_every_engine_density_and_size),
                                    cmocka_unit_test(md_has_its_rows_and_ratios),
                                    cmocka_unit_test(dsmc_has_its_rows_and_ratios),
                                    cmocka_unit_test(every_observable_has_its_cost_or_a_dash),
                                    cmocka_unit_test(every_state_has_time_against_error_and_a_picture),
                                    cmocka_unit_test(bad_options_are_refused)};
  if (!mkdtemp(folder) || chdir(folder) != 0) return 1;
  int failed = full_too ? cmocka_run_group_tests(full, NULL, NULL) : cmocka_run_group_tests(quick, NULL, NULL);
  if (chdir("/") != 0 || rmdir(folder) != 0) return 1;
  return failed;
}
