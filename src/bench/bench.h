/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench: speed of the engines. A subject measures and fills tables; it is a file and a row of the table in
 * bench.c. */
#ifndef GG_BENCH_H
#define GG_BENCH_H

#include "io/checked_json.h"
#include "scene/scene.h"

/* A table of text, with the same numbers as rows of JSON. Subjects fill it, the command prints it. */
enum { GG_BENCH_COLUMNS = 16, GG_BENCH_ROWS = 80, GG_BENCH_CELL = 64 };

typedef struct gg_bench_table {
  const char *key;           /* first word of the names of JSON rows; a literal, like the caption */
  const char *caption;       /* printed above the table: quantity and method; NULL: none */
  char title[GG_BENCH_CELL]; /* printed above the caption; may be empty */
  int keep;                  /* first columns that are repeated if the table is too wide */
  json_t *rows;              /* an array of objects */
  int n_columns, n_rows;
  bool right[GG_BENCH_COLUMNS]; /* numbers are right-aligned */
  char head[GG_BENCH_COLUMNS][GG_BENCH_CELL];
  char cell[GG_BENCH_ROWS][GG_BENCH_COLUMNS][GG_BENCH_CELL];
} gg_bench_table;

typedef struct gg_bench_options {
  bool quick;          /* fewer sizes, shorter stretches */
  const char *picture; /* for "error": "x.svg" makes x_<state>.svg for each state; also .png, .pdf; NULL: none */
  const char *width;   /* width of the picture, "86mm"; NULL: as for a screen */
  int threads;         /* threads of one engine, where threads are measured */
  double smaller;      /* factor by which grains and stretches are reduced, for tests; 0: 1 */
  int n_overrides;
  const char *const *override; /* "KEY=VALUE" of a scene; only run.seed matters */
  void *context;
  void (*tell)(void *context, const char *line); /* progress line, which replaces the last one; may be NULL */
  /* Called with each row, one line of JSON, as soon as it is measured; may be NULL. */
  void (*record)(void *context, const char *line);
} gg_bench_options;

/* The value of a JSON row. NaN (unknown) becomes null. */
typedef struct gg_bench_value {
  const char *unit;              /* a unit that ends with "second" is a rate; otherwise less is better */
  double value, lowest, highest; /* median, least and largest of the repeats */
  int repeats, threads;
} gg_bench_value;

enum { GG_BENCH_TABLES = 24 };
typedef struct gg_bench {
  const gg_bench_options *options;
  uint64_t seed;
  unsigned failures; /* failed allocations before the bench */
  bool measured;     /* the tables are complete, even if the picture failed */
  int n_tables;
  gg_bench_table *table[GG_BENCH_TABLES];
} gg_bench;

/* Measure a subject: "md", "dsmc", "observables", "error"; NULL: the overview. Clear *bench afterwards, also on
 * failure. */
gg_status gg_bench_run(gg_bench *bench, const char *subject, const gg_bench_options *options, gg_error *err);
void gg_bench_clear(gg_bench *bench);

/* Compare two files of JSON rows. *text: text or lines of JSON, to be freed; NULL on failure. GG_FAILED with the text:
 * rows are slower by more than `limit` per cent beyond their spread; negative: no limit. */
gg_status gg_bench_compare(const char *before, const char *after, double limit, bool json, char **text, gg_error *err);

/* For subjects. */
typedef gg_status gg_bench_subject(gg_bench *bench, gg_error *err);
gg_bench_subject gg_bench_overview, gg_bench_md, gg_bench_dsmc, gg_bench_observables, gg_bench_error;
gg_status gg_bench_scenes(gg_bench *bench, gg_error *err); /* the second table of the overview */

/* A new, empty table, owned by the bench; NULL with the message if out of memory. `key` and `caption` are literals. */
gg_bench_table *gg_bench_table_new(gg_bench *bench, const char *key, const char *caption, int keep, gg_error *err);
/* Add a column with its head, a row with its first cell; return their index. */
int gg_bench_table_column(gg_bench_table *table, bool right, const char *format, ...) GG_PRINTF(3, 4);
int gg_bench_table_row(gg_bench_table *table, const char *format, ...) GG_PRINTF(2, 3);
void gg_bench_table_put(gg_bench_table *table, int row, int column, const char *format, ...) GG_PRINTF(4, 5);
/* Add a JSON row. The format (of json_pack) gives the members that form its name. `more`: further members, whose
 * reference is taken; may be NULL. */
void gg_bench_table_add(const gg_bench *bench, gg_bench_table *table, gg_bench_value value, json_t *more,
                        const char *format, ...);
void gg_bench_report(const gg_bench *bench, const char *format, ...) GG_PRINTF(2, 3);
/* The default scene with the seed of this bench; the seconds of a stretch, reduced by options->smaller. */
gg_scene gg_bench_scene(const gg_bench *bench, gg_engine_kind engine, double phi, int64_t n);
double gg_bench_seconds(const gg_bench *bench, double seconds);

#endif
