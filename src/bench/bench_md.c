/* graingas bench md: the event-driven engine by size and density, and what each feature of a scene costs. */
#include <math.h>

#include "bench/scene_grid.h"

static const char rates_caption[] =
    "Elastic smooth spheres in a periodic box, no stress measured: millions of collisions per CPU-second on one core, "
    "median (slowest - fastest) of repeats, time per collision";
static const char ratios_caption[] =
    "What a scene's features cost: collisions between grains per CPU-second over that of the scene beside it, timed in "
    "turn; median (least - largest) of repeats. Elastic, smooth and periodic unless said otherwise; sheared and moving "
    "walls: e = 0.9, rough there: beta = 0, frictional: mu = 0.123";

/* The table: quick leaves out the last columns. */
static const double densities[] = {0.01, 0.3, 0.5};
static const int64_t sizes[] = {1000, 10000, 100000, 1000000};
enum { N_DENSITIES = 3, N_SIZES = 4, QUICK_SIZES = 2 };

static gg_scene elastic(const gg_bench *b, double phi, int64_t n)
{
  gg_scene s = gg_bench_scene(b, GG_MD, phi, n);
  s.flow = GG_EQUILIBRIUM;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = 1;
  return s;
}

static void set_rule(gg_scene *s, double beta, double mu)
{
  for (int p = 0; p < GG_PAIRS; p++) s->collision.beta[p] = beta, s->collision.mu[p] = mu;
}

/* One feature at a time: every scene is compared with one that lacks it. */
enum {
  SMOOTH,
  ROUGH,
  TWO,
  SUMMED,
  WALLED,
  FALLING,
  SHEARED,
  SHEARED_ROUGH,
  SHEARED_FRICTIONAL,
  SHEARED_SUMMED,
  COUETTE
};
static const gg_bench_feature scenes[] = {
    [SMOOTH] = {"smooth", SMOOTH},
    [ROUGH] = {"rough", SMOOTH},
    [TWO] = {"two species", SMOOTH},
    [SUMMED] = {"stress measured", SMOOTH},
    [WALLED] = {"walls", SMOOTH},
    [FALLING] = {"walls, gravity", WALLED},
    [SHEARED] = {"sheared smooth", SMOOTH},
    [SHEARED_ROUGH] = {"sheared rough", SMOOTH},
    [SHEARED_FRICTIONAL] = {"sheared frictional", SHEARED_ROUGH},
    [SHEARED_SUMMED] = {"sheared rough, stress measured", SHEARED_ROUGH},
    [COUETTE] = {"moving walls, rough", SHEARED_ROUGH},
};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

static void add_walls(gg_scene *s, bool gravity)
{
  s->flow = GG_POISEUILLE;
  s->walls.e = 1;
  s->walls.beta = -1;
  /* Weight times height below the temperature 1/2: the gas hardly settles. */
  if (gravity) s->gravity[1] = -0.1 / cbrt((double)s->particles * M_PI / (6 * s->phi));
}

static void add_species(gg_scene *s)
{
  s->n_species = 2;
  s->species[0].fraction = 0.5;
  s->species[1] = (gg_species){0.5, 1, 4, 0.4};
}

static gg_timed_scene timed_scene(const gg_bench *b, int kind, double phi, int64_t n)
{
  gg_timed_scene c = {.scene = elastic(b, phi, n), .sums = kind == SUMMED || kind == SHEARED_SUMMED};
  c.against = scenes[kind].against;
  if (kind == ROUGH) set_rule(&c.scene, 1, INFINITY);
  if (kind == TWO) add_species(&c.scene);
  if (kind == WALLED || kind == FALLING) add_walls(&c.scene, kind == FALLING);
  if (kind < SHEARED) return c;
  c.scene.flow = kind == COUETTE ? GG_COUETTE : GG_USF;
  for (int p = 0; p < GG_PAIRS; p++) c.scene.collision.e[p] = 0.9;
  if (kind == SHEARED_FRICTIONAL)
    set_rule(&c.scene, 0.4, 0.123);
  else if (kind != SHEARED)
    set_rule(&c.scene, 0, INFINITY);
  return c;
}

static void note_rate(gg_bench_sheet *sheet, int row, int column, double phi, int64_t n, const gg_throughput *t)
{
  gg_bench_sheet_put(sheet, row, column, "%.3g (%.3g - %.3g) %.0f ns", t->rate * 1e-6, t->slowest * 1e-6,
                     t->fastest * 1e-6, 1e9 / t->rate);
  json_array_append_new(sheet->rows, json_pack("{s:f, s:I, s:f, s:f, s:f, s:s}", "phi", phi, "particles", (json_int_t)n,
                                               "mean", t->rate, "slowest", t->slowest, "fastest", t->fastest, "unit",
                                               "collisions per CPU-second"));
}

/* Large systems start near equilibrium, and a few collisions a grain cost seconds. */
static double warmup_of(int64_t n, bool quick)
{
  return n >= 1000000 ? 5 : quick ? 10 : 30;
}

static void note_ratio(gg_bench_sheet *sheet, int column, double phi, int64_t n, int kind, const gg_timing *r)
{
  const char *against = scenes[scenes[kind].against].name;
  gg_bench_sheet_put(sheet, kind, column, "%.2f (%.2f - %.2f)", r->ratio, r->lowest, r->highest);
  if (kind == scenes[kind].against) gg_bench_sheet_put(sheet, kind, column, "%.3g M/s", r->own.rate * 1e-6);
  json_array_append_new(sheet->rows, json_pack("{s:f, s:I, s:s, s:s, s:f, s:f, s:f, s:f, s:s}", "phi", phi, "particles",
                                               (json_int_t)n, "scene", scenes[kind].name, "against", against, "ratio",
                                               r->ratio, "least", r->lowest, "largest", r->highest, "mean", r->own.rate,
                                               "unit", "collisions per CPU-second"));
}

gg_status gg_bench_md(gg_bench *b, gg_error *err)
{
  bool quick = b->options->quick;
  const gg_bench_grid grid = {densities, N_DENSITIES, timed_scene, warmup_of};
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "collisions", rates_caption, 1, err);
  if (!sheet) return GG_FAILED;
  GG_TRY(gg_bench_rates(b, sheet, &grid, sizes, quick ? QUICK_SIZES : N_SIZES, note_rate, err));
  return gg_bench_ratios(b, ratios_caption, &grid, scenes, N_SCENES, quick ? 2000 : 10000, 0.5, note_ratio, err);
}
