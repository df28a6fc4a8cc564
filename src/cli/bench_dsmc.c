/* graingas bench dsmc: the Enskog Monte Carlo engine by size, and what each feature of a scene costs. */
#include <math.h>

#include "cli/bench.h"

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

enum {
  SMOOTH,
  ROUGH,
  FRICTIONAL,
  TWO,
  TWO_ROUGH,
  TAPPED,
  SHEARED,
  SHEARED_TAPPED,
  SHEARED_ROUGH,
  SHEARED_FRICTIONAL,
  SHEARED_TWO
};
static const gg_bench_feature scenes[] = {
    [SMOOTH] = {"smooth", SMOOTH},
    [ROUGH] = {"rough", SMOOTH},
    [FRICTIONAL] = {"frictional", ROUGH},
    [TWO] = {"two species", SMOOTH},
    [TWO_ROUGH] = {"two species, rough", ROUGH},
    [TAPPED] = {"smooth, tap open", SMOOTH},
    [SHEARED] = {"sheared smooth", SMOOTH},
    [SHEARED_TAPPED] = {"sheared smooth, tap open", SHEARED},
    [SHEARED_ROUGH] = {"sheared rough, tap open", SHEARED_TAPPED},
    [SHEARED_FRICTIONAL] = {"sheared frictional, tap open", SHEARED_ROUGH},
    [SHEARED_TWO] = {"sheared, two species, tap open", SHEARED_TAPPED},
};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

static gg_contender contender(const gg_bench *b, int kind, double phi, int64_t n)
{
  const bool sheared = kind >= SHEARED;
  gg_contender c = {.scene = gg_bench_scene(b, GG_DSMC, phi, n), .tap = kind == TAPPED || kind > SHEARED};
  gg_scene *s = &c.scene;
  c.against = scenes[kind].against;
  s->flow = sheared ? GG_USF : GG_EQUILIBRIUM;
  const bool rough = kind == ROUGH || kind == TWO_ROUGH || kind == SHEARED_ROUGH;
  const bool frictional = kind == FRICTIONAL || kind == SHEARED_FRICTIONAL;
  for (int p = 0; p < GG_PAIRS; p++) {
    s->collision.e[p] = sheared ? 0.9 : 1;
    s->collision.beta[p] = rough ? sheared ? 0 : 1 : frictional ? 0.4 : -1;
    s->collision.mu[p] = frictional ? 0.123 : INFINITY;
  }
  if (kind != TWO && kind != TWO_ROUGH && kind != SHEARED_TWO) return c;
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
      gg_scene s = contender(b, SMOOTH, densities[d], sizes[i]).scene;
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
  if (kind == scenes[kind].against)
    gg_bench_cell(sheet, kind, column, "%.2f ns", ns);
  else
    gg_bench_cell(sheet, kind, column, "%.2f (%.2f - %.2f) %.1f ns", ratio, least, largest, ns);
  json_array_append_new(sheet->rows, json_pack("{s:f, s:I, s:s, s:s, s:f, s:f, s:f, s:f, s:s}", "phi", phi, "particles",
                                               (json_int_t)n, "scene", scenes[kind].name, "against",
                                               scenes[scenes[kind].against].name, "ratio", ratio, "least", least,
                                               "largest", largest, "mean", ns, "unit", "ns per collision"));
}

static gg_status ratios(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  const int64_t n = quick ? 10000 : 100000;
  gg_bench_sheet *sheet = gg_bench_start_ratios(b, ratios_caption, scenes, N_SCENES, err);
  if (!sheet) return GG_FAILED;
  for (int d = 0; d < N_DENSITIES; d++) {
    int column = gg_bench_density_column(sheet, densities[d]);
    gg_contender c[N_SCENES];
    gg_race r[N_SCENES];
    for (int k = 0; k < N_SCENES; k++) c[k] = contender(b, k, densities[d], n);
    GG_TRY(gg_measure_race(c, N_SCENES, warmup_of(quick), quick ? 5 : 9, quick ? 0.1 : 0.4, r, err));
    for (int k = 0; k < N_SCENES; k++) note_ratio(sheet, column, densities[d], n, k, &r[k]);
    gg_bench_tell(b, "ratios at phi %g N %lld done", densities[d], (long long)n);
  }
  return GG_OK;
}

gg_status gg_bench_dsmc(gg_bench *b, gg_error *err)
{
  GG_TRY(times(b, err));
  return ratios(b, err);
}
