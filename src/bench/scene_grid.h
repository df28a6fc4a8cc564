/* Sheets that both engines' benches have: rates by size and density, and what features cost by density. */
#ifndef GG_BENCH_GRID_H
#define GG_BENCH_GRID_H

#include "bench/bench.h"
#include "bench/throughput.h"

/* What a feature costs: a scene that has it, timed against the one (by index) that lacks it; the first against itself.
 */
typedef struct gg_bench_feature {
  const char *name;
  int against;
} gg_bench_feature;

/* Densities side by side. Quick: fewer sizes, shorter stretches. */
typedef struct gg_bench_grid {
  const double *densities;
  int n_densities;
  gg_timed_scene (*scene)(const gg_bench *b, int kind, double phi, int64_t n); /* kind 0: the plain one */
  double (*warmup)(int64_t n, bool quick);                                     /* collisions per grain */
} gg_bench_grid;

/* The plain scene by size, a column a density; `note` fills a cell and adds a row. */
typedef void gg_bench_note_rate(gg_bench_sheet *sheet, int row, int column, double phi, int64_t n,
                                const gg_throughput *t);
gg_status gg_bench_rates(gg_bench *b, gg_bench_sheet *sheet, const gg_bench_grid *grid, const int64_t *sizes,
                         int n_sizes, gg_bench_note_rate *note, gg_error *err);

/* Scenes with a feature against those without, at one size; a row each. */
typedef void gg_bench_note_ratio(gg_bench_sheet *sheet, int column, double phi, int64_t n, int kind,
                                 const gg_timing *r);
gg_status gg_bench_ratios(gg_bench *b, const char *caption, const gg_bench_grid *grid, const gg_bench_feature *features,
                          int n_features, int64_t n, double seconds, gg_bench_note_ratio *note, gg_error *err);

#endif
