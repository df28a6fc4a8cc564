/* What the subjects of `graingas bench` share: sheets, each a table and the same rows as JSON, filled by the subject
 * and printed by the frame. A subject is a file of its own and a line in bench.c's table. */
#ifndef GG_CLI_BENCH_H
#define GG_CLI_BENCH_H

#include <jansson.h>

#include "bench/throughput.h"
#include "cli/options.h"
#include "cli/table.h"

typedef struct gg_bench_sheet {
  const char *key;     /* of the rows in the JSON document */
  const char *caption; /* above the table: what was measured, and how */
  int keep;            /* columns that are repeated where the table is too wide */
  gg_table *table;
  json_t *rows;
} gg_bench_sheet;

enum { GG_BENCH_SHEETS = 8 };
typedef struct gg_bench {
  const gg_options *options;
  uint64_t seed;
  int n_sheets;
  gg_bench_sheet sheet[GG_BENCH_SHEETS];
} gg_bench;

/* A subject measures and fills sheets. */
typedef gg_status gg_bench_subject(gg_bench *b, gg_error *err);
gg_bench_subject gg_bench_overview, gg_bench_md, gg_bench_dsmc, gg_bench_observables;

/* A new, empty sheet, owned by the frame; NULL with the message if out of memory. Strings must be literals. */
gg_bench_sheet *gg_bench_new_sheet(gg_bench *b, const char *key, const char *caption, int keep, gg_error *err);
/* Write into a cell of the sheet's table. */
void gg_bench_cell(gg_bench_sheet *sheet, int row, int column, const char *format, ...) GG_PRINTF(4, 5);
/* A new column "phi ...". */
int gg_bench_density_column(gg_bench_sheet *sheet, double phi);
/* What a feature costs: a scene that has it, timed against the one (by index) that lacks it; the first against itself.
 */
typedef struct gg_bench_feature {
  const char *name;
  int against;
} gg_bench_feature;
/* What both engines' benches have: densities side by side. Quick: fewer sizes, shorter stretches. */
typedef struct gg_bench_grid {
  const double *densities;
  int n_densities;
  gg_contender (*scene)(const gg_bench *b, int kind, double phi, int64_t n); /* kind 0: the plain one */
  double (*warmup)(int64_t n, bool quick);                                   /* collisions per grain */
} gg_bench_grid;
/* bench_grid.c: the plain scene by size, a column a density; `note` fills a cell and adds a row. */
typedef void gg_bench_note_rate(gg_bench_sheet *sheet, int row, int column, double phi, int64_t n,
                                const gg_throughput *t);
gg_status gg_bench_rates(gg_bench *b, gg_bench_sheet *sheet, const gg_bench_grid *grid, const int64_t *sizes,
                         int n_sizes, gg_bench_note_rate *note, gg_error *err);
/* Scenes with a feature against those without, at one size; a row each. */
typedef void gg_bench_note_ratio(gg_bench_sheet *sheet, int column, double phi, int64_t n, int kind, const gg_race *r);
gg_status gg_bench_ratios(gg_bench *b, const char *caption, const gg_bench_grid *grid, const gg_bench_feature *features,
                          int n_features, int64_t n, double seconds, gg_bench_note_ratio *note, gg_error *err);
/* Progress on standard error, a line each, unless --quiet. */
void gg_bench_tell(const gg_bench *b, const char *format, ...) GG_PRINTF(2, 3);
/* The defaults with this bench's seed. */
gg_scene gg_bench_scene(const gg_bench *b, gg_engine_kind engine, double phi, int64_t n);

#endif
