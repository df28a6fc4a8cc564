/* graingas bench dsmc: the Enskog Monte Carlo engine by size, and what each feature of a scene costs. */
#include "bench/bench_dsmc.h"

static const char times_caption[] = "Elastic smooth spheres (the kernel of free cooling), nothing measured: "
                                    "nanoseconds per accepted collision, CPU time of one "
                                    "core, median (least - largest) of repeats";
static const char ratios_caption[] =
    "What a scene's features cost: nanoseconds per accepted collision over those of the scene beside it, timed in "
    "turn; median (least - largest) of repeats. Elastic unless sheared: e = 0.9; rough: beta = 0, frictional: mu = "
    "0.123; two species: alike but for their mass";

/* The table: quick leaves out the last. */
static const double densities[] = {0, 0.3};
static const int64_t sizes[] = {10000, 100000, 1000000};
enum { N_DENSITIES = 2, N_SIZES = 3, QUICK_SIZES = 2 };

static double warmup_of(int64_t n, bool quick)
{
  (void)n;
  return quick ? 10 : 20;
}

static void note_time(gg_bench_sheet *sheet, int row, int column, double phi, int64_t n, const gg_throughput *t)
{
  gg_bench_sheet_put(sheet, row, column, "%.2f (%.2f - %.2f)", 1e9 / t->rate, 1e9 / t->fastest, 1e9 / t->slowest);
  json_array_append_new(sheet->rows, json_pack("{s:f, s:I, s:f, s:f, s:f, s:s}", "phi", phi, "particles", (json_int_t)n,
                                               "mean", 1e9 / t->rate, "least", 1e9 / t->fastest, "largest",
                                               1e9 / t->slowest, "unit", "ns per collision"));
}

/* What is measured are rates: times are their inverse. */
static void note_ratio(gg_bench_sheet *sheet, int column, double phi, int64_t n, int kind, const gg_timing *r)
{
  const double ns = 1e9 / r->own.rate, ratio = 1 / r->ratio, least = 1 / r->highest, largest = 1 / r->lowest;
  if (kind == gg_bench_dsmc_features[kind].against)
    gg_bench_sheet_put(sheet, kind, column, "%.2f ns", ns);
  else
    gg_bench_sheet_put(sheet, kind, column, "%.2f (%.2f - %.2f) %.1f ns", ratio, least, largest, ns);
  json_array_append_new(sheet->rows,
                        json_pack("{s:f, s:I, s:s, s:s, s:f, s:f, s:f, s:f, s:s}", "phi", phi, "particles",
                                  (json_int_t)n, "scene", gg_bench_dsmc_features[kind].name, "against",
                                  gg_bench_dsmc_features[gg_bench_dsmc_features[kind].against].name, "ratio", ratio,
                                  "least", least, "largest", largest, "mean", ns, "unit", "ns per collision"));
}

gg_status gg_bench_dsmc(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  const gg_bench_grid grid = {densities, N_DENSITIES, gg_bench_dsmc_scene, warmup_of};
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "times", times_caption, 1, err);
  if (!sheet) return GG_FAILED;
  GG_TRY(gg_bench_rates(b, sheet, &grid, sizes, quick ? QUICK_SIZES : N_SIZES, note_time, err));
  GG_TRY(gg_bench_ratios(b, ratios_caption, &grid, gg_bench_dsmc_features, GG_BENCH_DSMC_KINDS, quick ? 10000 : 100000,
                         0.4, note_ratio, err));
  GG_TRY(gg_bench_dsmc_precision(b, err));
  GG_TRY(gg_bench_dsmc_paths(b, err));
  return gg_bench_dsmc_threads(b, err);
}
