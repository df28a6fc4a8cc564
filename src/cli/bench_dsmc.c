/* graingas bench dsmc: the Enskog Monte Carlo engine by size, and what each feature of a scene costs. */
#include <math.h>

#include "cli/bench_dsmc.h"

static const char times_caption[] =
    "Elastic smooth spheres (the kernel of free cooling), no tap: nanoseconds per accepted collision, CPU time of one "
    "core, median (least - largest) of repeats";
static const char ratios_caption[] = "What a scene's features cost: nanoseconds per accepted collision over those of "
                                     "the scene beside it, timed in turn; "
                                     "median (least - largest) of repeats. Elastic unless sheared: e = 0.9; rough: "
                                     "beta = 0, frictional: mu = 0.123; two "
                                     "species: alike but for their mass";

/* The table: quick leaves out the last. */
static const double densities[] = {0, 0.3};
static const int64_t sizes[] = {10000, 100000, 1000000};
enum { N_DENSITIES = 2, N_SIZES = 3, QUICK_SIZES = 2 };

const gg_bench_feature gg_dsmc_features_timed[GG_DSMC_KINDS] = {
    [GG_DSMC_SMOOTH] = {"smooth", GG_DSMC_SMOOTH},
    [GG_DSMC_ROUGH] = {"rough", GG_DSMC_SMOOTH},
    [GG_DSMC_FRICTIONAL] = {"frictional", GG_DSMC_ROUGH},
    [GG_DSMC_TWO] = {"two species", GG_DSMC_SMOOTH},
    [GG_DSMC_TWO_ROUGH] = {"two species, rough", GG_DSMC_ROUGH},
    [GG_DSMC_TAPPED] = {"smooth, tap open", GG_DSMC_SMOOTH},
    [GG_DSMC_SHEARED] = {"sheared smooth", GG_DSMC_SMOOTH},
    [GG_DSMC_SHEARED_TAPPED] = {"sheared smooth, tap open", GG_DSMC_SHEARED},
    [GG_DSMC_SHEARED_ROUGH] = {"sheared rough, tap open", GG_DSMC_SHEARED_TAPPED},
    [GG_DSMC_SHEARED_FRICTIONAL] = {"sheared frictional, tap open", GG_DSMC_SHEARED_ROUGH},
    [GG_DSMC_SHEARED_TWO] = {"sheared, two species, tap open", GG_DSMC_SHEARED_TAPPED},
};

gg_contender gg_bench_dsmc_contender(const gg_bench *b, gg_dsmc_kind kind, double phi, int64_t n)
{
  const bool sheared = kind >= GG_DSMC_SHEARED;
  gg_contender c = {.scene = gg_bench_scene(b, GG_DSMC, phi, n),
                    .tap = kind == GG_DSMC_TAPPED || kind > GG_DSMC_SHEARED};
  gg_scene *s = &c.scene;
  c.against = gg_dsmc_features_timed[kind].against;
  s->flow = sheared ? GG_USF : GG_EQUILIBRIUM;
  const bool rough = kind == GG_DSMC_ROUGH || kind == GG_DSMC_TWO_ROUGH || kind == GG_DSMC_SHEARED_ROUGH;
  const bool frictional = kind == GG_DSMC_FRICTIONAL || kind == GG_DSMC_SHEARED_FRICTIONAL;
  for (int p = 0; p < GG_PAIRS; p++) {
    s->collision.e[p] = sheared ? 0.9 : 1;
    s->collision.beta[p] = rough ? sheared ? 0 : 1 : frictional ? 0.4 : -1;
    s->collision.mu[p] = frictional ? 0.123 : INFINITY;
  }
  if (kind != GG_DSMC_TWO && kind != GG_DSMC_TWO_ROUGH && kind != GG_DSMC_SHEARED_TWO) return c;
  s->n_species = 2;
  s->species[0].fraction = 0.5;
  s->species[1] = (gg_species){0.5, 1, 4, 0.4};
  return c;
}

static double warmup_of(bool quick)
{
  return quick ? 10 : 20;
}

static gg_status times(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "times", times_caption, 1, err);
  if (!sheet) return GG_FAILED;
  gg_table_column(sheet->table, "N", true);
  for (int d = 0; d < N_DENSITIES; d++) gg_bench_density_column(sheet, densities[d]);
  for (int i = 0; i < (quick ? QUICK_SIZES : N_SIZES); i++) {
    int row = gg_table_row(sheet->table);
    gg_bench_cell(sheet, row, 0, "%lld", (long long)sizes[i]);
    for (int d = 0; d < N_DENSITIES; d++) {
      gg_throughput t;
      gg_scene s = gg_bench_dsmc_contender(b, GG_DSMC_SMOOTH, densities[d], sizes[i]).scene;
      GG_TRY(gg_measure_throughput(&s, false, warmup_of(quick), quick ? 3 : 7, quick ? 0.3 : 1, &t, err));
      gg_bench_cell(sheet, row, 1 + d, "%.2f (%.2f - %.2f)", 1e9 / t.rate, 1e9 / t.fastest, 1e9 / t.slowest);
      json_array_append_new(sheet->rows, json_pack("{s:f, s:I, s:f, s:f, s:f, s:s}", "phi", densities[d], "particles",
                                                   (json_int_t)sizes[i], "mean", 1e9 / t.rate, "least", 1e9 / t.fastest,
                                                   "largest", 1e9 / t.slowest, "unit", "ns per collision"));
      gg_bench_tell(b, "phi %g N %lld: %.1f ns", densities[d], (long long)sizes[i], 1e9 / t.rate);
    }
  }
  return GG_OK;
}

/* A race compares rates: times are their inverse. */
static void note_ratio(gg_bench_sheet *sheet, int column, double phi, int64_t n, int kind, const gg_race *r)
{
  const double ns = 1e9 / r->own.rate, ratio = 1 / r->ratio, least = 1 / r->highest, largest = 1 / r->lowest;
  if (kind == gg_dsmc_features_timed[kind].against)
    gg_bench_cell(sheet, kind, column, "%.2f ns", ns);
  else
    gg_bench_cell(sheet, kind, column, "%.2f (%.2f - %.2f) %.1f ns", ratio, least, largest, ns);
  json_array_append_new(sheet->rows,
                        json_pack("{s:f, s:I, s:s, s:s, s:f, s:f, s:f, s:f, s:s}", "phi", phi, "particles",
                                  (json_int_t)n, "scene", gg_dsmc_features_timed[kind].name, "against",
                                  gg_dsmc_features_timed[gg_dsmc_features_timed[kind].against].name, "ratio", ratio,
                                  "least", least, "largest", largest, "mean", ns, "unit", "ns per collision"));
}

static gg_status ratios(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  const int64_t n = quick ? 10000 : 100000;
  gg_bench_sheet *sheet = gg_bench_start_ratios(b, ratios_caption, gg_dsmc_features_timed, GG_DSMC_KINDS, err);
  if (!sheet) return GG_FAILED;
  for (int d = 0; d < N_DENSITIES; d++) {
    int column = gg_bench_density_column(sheet, densities[d]);
    gg_contender c[GG_DSMC_KINDS];
    gg_race r[GG_DSMC_KINDS];
    for (int k = 0; k < GG_DSMC_KINDS; k++) c[k] = gg_bench_dsmc_contender(b, (gg_dsmc_kind)k, densities[d], n);
    GG_TRY(gg_measure_race(c, GG_DSMC_KINDS, warmup_of(quick), quick ? 5 : 9, quick ? 0.1 : 0.4, r, err));
    for (int k = 0; k < GG_DSMC_KINDS; k++) note_ratio(sheet, column, densities[d], n, k, &r[k]);
    gg_bench_tell(b, "ratios at phi %g N %lld done", densities[d], (long long)n);
  }
  return GG_OK;
}

gg_status gg_bench_dsmc(gg_bench *b, gg_error *err)
{
  GG_TRY(times(b, err));
  GG_TRY(ratios(b, err));
  GG_TRY(gg_bench_dsmc_precision(b, err));
  GG_TRY(gg_bench_dsmc_paths(b, err));
  return gg_bench_dsmc_threads(b, err);
}
