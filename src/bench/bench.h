/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench: how fast things are. A subject measures and fills tables; it is a file of its own and a line in
 * bench.c's table. */
#ifndef GG_BENCH_H
#define GG_BENCH_H

#include "io/checked_json.h"
#include "scene/scene.h"

/* A table of text, and the same numbers as rows of the record. Subjects fill it, the command prints it. */
enum { GG_BENCH_COLUMNS = 16, GG_BENCH_ROWS = 80, GG_BENCH_CELL = 64 };

typedef struct gg_bench_table {
  const char *key;           /* that names of rows in the record begin with; a literal, as the caption is */
  const char *caption;       /* above the table: what was measured, and how; NULL: nothing */
  char title[GG_BENCH_CELL]; /* over the caption; may be empty */
  int keep;                  /* columns that are repeated where the table is too wide */
  json_t *rows;              /* an array of objects */
  int n_columns, n_rows;
  bool right[GG_BENCH_COLUMNS]; /* numbers stand right */
  char head[GG_BENCH_COLUMNS][GG_BENCH_CELL];
  char cell[GG_BENCH_ROWS][GG_BENCH_COLUMNS][GG_BENCH_CELL];
} gg_bench_table;

typedef struct gg_bench_options {
  bool quick;          /* fewer sizes, shorter stretches */
  const char *picture; /* of "error": "x.svg" makes x_<state>.svg for each; also .png, .pdf; NULL: none */
  const char *width;   /* of the picture, "86mm"; NULL: free */
  int threads;         /* that one engine may use where threads are measured */
  double smaller; /* so many times fewer grains and shorter stretches: what is measured says little; 0: as they are */
  int n_overrides;
  const char *const *override; /* "KEY=VALUE" of a scene; only run.seed matters */
  void *context;
  void (*tell)(void *context, const char *line); /* progress, a line in place of the last; NULL: not wanted */
  /* A row of the record as JSON in one line, as soon as it is measured; NULL: not wanted. */
  void (*record)(void *context, const char *line);
} gg_bench_options;

/* What a row of the record is about. NaN is null there: not known. */
typedef struct gg_bench_value {
  const char *unit;              /* one that ends with "second" is a rate, else less is better */
  double value, lowest, highest; /* median, least and largest of the repeats */
  int repeats, threads;
} gg_bench_value;

enum { GG_BENCH_TABLES = 24 };
typedef struct gg_bench {
  const gg_bench_options *options;
  uint64_t seed;
  unsigned failures; /* of memory, before it began */
  bool measured;     /* the tables are whole, whatever became of the picture */
  int n_tables;
  gg_bench_table *table[GG_BENCH_TABLES];
} gg_bench;

/* Measure a subject: "md", "dsmc", "observables", "error"; NULL for the overview. Clear *bench whatever comes of it. */
gg_status gg_bench_run(gg_bench *bench, const char *subject, const gg_bench_options *options, gg_error *err);
void gg_bench_clear(gg_bench *bench);

/* Two files of such lines set against each other, as text, or as lines of JSON; to be freed, NULL if there is none.
 * GG_FAILED, beside the text: rows are slower by more than `limit` per cent beyond their spread; negative: no limit. */
gg_status gg_bench_compare(const char *before, const char *after, double limit, bool json, char **text, gg_error *err);

/* For subjects. */
typedef gg_status gg_bench_subject(gg_bench *bench, gg_error *err);
gg_bench_subject gg_bench_overview, gg_bench_md, gg_bench_dsmc, gg_bench_observables, gg_bench_error;
gg_status gg_bench_scenes(gg_bench *bench, gg_error *err); /* the second table of the overview */

/* A new, empty table, owned by the bench; NULL with the message if out of memory. Strings must be literals. */
gg_bench_table *gg_bench_table_new(gg_bench *bench, const char *key, const char *caption, int keep, gg_error *err);
/* A new column with its head, a new row with its first cell; return their number. */
int gg_bench_table_column(gg_bench_table *table, bool right, const char *format, ...) GG_PRINTF(3, 4);
int gg_bench_table_row(gg_bench_table *table, const char *format, ...) GG_PRINTF(2, 3);
void gg_bench_table_put(gg_bench_table *table, int row, int column, const char *format, ...) GG_PRINTF(4, 5);
/* A row of the record; the format, which is json_pack's, has what makes up its name. `more`: further members, the
 * row's from then on; NULL: none. */
void gg_bench_table_add(const gg_bench *bench, gg_bench_table *table, gg_bench_value value, json_t *more,
                        const char *format, ...);
json_t *gg_bench_number(double x); /* null where it is not finite */
void gg_bench_tell(const gg_bench *bench, const char *format, ...) GG_PRINTF(2, 3);
/* The defaults with this bench's seed; and seconds of a stretch: less where the options say so. */
gg_scene gg_bench_scene(const gg_bench *bench, gg_engine_kind engine, double phi, int64_t n);
double gg_bench_seconds(const gg_bench *bench, double seconds);

#endif
