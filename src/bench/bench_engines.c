/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench, bench md, bench dsmc: speed by size and density; cost of features of a scene. */
#include <math.h>
#include <string.h>

#include "bench/bench.h"
#include "bench/throughput.h"
#include "dsmc/dsmc.h"

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

enum {
  ROUGH = 1,
  FRICTIONAL = 2,
  MIXTURE = 4,
  SHEARED = 8,
  WALLS = 16,
  GRAVITY = 32,
  COUETTE = 64,
  NOISE = 128,
  NEARLY = 256,
  IN_BATH = 512,
  TWO_WAYS = 1024 /* also timed in two ways: by another path, on threads */
};

/* A scene with a feature, and the scene it is compared with; the first row is compared with itself. */
typedef struct feature {
  const char *name, *against;
  unsigned has;
} feature;

static const feature md_features[] = {
    {"smooth", "smooth", TWO_WAYS},
    {"rough", "smooth", ROUGH},
    {"two species", "smooth", MIXTURE},
    {"walls", "smooth", WALLS},
    {"walls, gravity", "walls", WALLS | GRAVITY},
    {"sheared smooth", "smooth", SHEARED},
    {"sheared rough", "smooth", SHEARED | ROUGH | TWO_WAYS},
    {"sheared frictional", "sheared rough", SHEARED | FRICTIONAL},
    {"moving walls, rough", "sheared rough", SHEARED | ROUGH | COUETTE},
    {"white noise, e = 0.99", "smooth", NOISE | NEARLY},
    {"white noise, e = 0.9", "smooth", NOISE},
    {"bath, e = 0.9", "smooth", NOISE | IN_BATH},
    {"bath, rough, e = 0.9", "bath, e = 0.9", NOISE | IN_BATH | ROUGH},
};
static const feature dsmc_features[] = {
    {"smooth", "smooth", TWO_WAYS},
    {"rough", "smooth", ROUGH | TWO_WAYS},
    {"frictional", "rough", FRICTIONAL},
    {"two species", "smooth", MIXTURE | TWO_WAYS},
    {"two species, rough", "rough", MIXTURE | ROUGH},
    {"sheared smooth", "smooth", SHEARED | TWO_WAYS},
    {"sheared rough", "sheared smooth", SHEARED | ROUGH},
    {"sheared frictional", "sheared rough", SHEARED | FRICTIONAL},
    {"sheared, two species", "sheared smooth", SHEARED | MIXTURE | TWO_WAYS},
};
static const feature dsmc_wall_features[] = {{"moving walls", "moving walls", SHEARED | COUETTE}};

/* Parameters of the bench of an engine. With --quick only the first sizes. */
typedef struct engine_bench {
  gg_engine_kind engine;
  const char *rates, *rates_caption, *ratios_caption, *unit;
  const feature *features;
  int n_features, n_densities, n_sizes, quick_sizes;
  double densities[3];
  int64_t sizes[4], ratio_size, quick_ratio_size;
  double ratio_seconds;
  int first_shared; /* first size that threads share */
} engine_bench;

static const engine_bench md = {
    GG_MD,
    "collisions",
    "Elastic smooth spheres in a periodic box, not sampled: millions of collisions per CPU-second on one core, "
    "median (slowest - fastest) of repeats, time per collision",
    "Cost of a scene's features: collisions between grains per CPU-second over that of the scene in column `against`, "
    "timed in turn; median (least - largest) of repeats. Elastic, smooth and periodic unless the row names another "
    "case. Sheared, moving walls: e = 0.9; rough among them: beta = 0; frictional: mu = 0.123. Bath: drag 0.1",
    "collisions per CPU-second",
    md_features,
    COUNT(md_features),
    3,
    4,
    2,
    {0.01, 0.3, 0.5},
    {1000, 10000, 100000, 1000000},
    10000,
    2000,
    0.5,
    2};
static const engine_bench dsmc = {
    GG_DSMC,
    "times",
    "Elastic smooth spheres (the kernel of free cooling), not sampled: nanoseconds per accepted collision, CPU "
    "time of one core, median (least - largest) of repeats",
    "Cost of a scene's features: nanoseconds per accepted collision over those of the scene in column `against`, timed "
    "in turn; median (least - largest) of repeats. Elastic; sheared: e = 0.9; rough: beta = 0; frictional: mu = "
    "0.123; two species differ in mass alone",
    "ns per collision",
    dsmc_features,
    COUNT(dsmc_features),
    2,
    3,
    2,
    {0, 0.3},
    {10000, 100000, 1000000},
    100000,
    10000,
    0.4,
    1};

static const engine_bench dsmc_walls = {
    .engine = GG_DSMC,
    .rates = "walls",
    .rates_caption =
        "Smooth spheres, e = 0.9, between moving walls, not sampled: nanoseconds per accepted collision, flights, "
        "contacts with walls and order by height included, CPU time of one core, median (least - largest) of repeats",
    .unit = "ns per collision",
    .features = dsmc_wall_features,
    .n_features = 1,
    .n_densities = 3,
    .n_sizes = 2,
    .quick_sizes = 1,
    .densities = {0.01, 0.3, 0.5},
    .sizes = {5000, 100000}};

static int find(const engine_bench *e, const char *name)
{
  int k = 0;
  while (strcmp(e->features[k].name, name) != 0) k++;
  return k;
}

static void add_walls(gg_scene *s, bool gravity)
{
  s->flow = GG_POISEUILLE;
  s->walls.e = 1;
  s->walls.beta = -1;
  /* m g H is small against T = 1/2, so that the density hardly varies with height. */
  if (gravity) s->gravity[1] = -0.1 / cbrt((double)s->particles * M_PI / (6 * s->phi));
}

static gg_timed_scene timed_scene(const gg_bench *b, const engine_bench *e, int kind, double phi, int64_t n)
{
  const unsigned has = e->features[kind].has;
  gg_timed_scene c = {.scene = gg_bench_scene(b, e->engine, phi, n)};
  gg_scene *s = &c.scene;
  c.against = find(e, e->features[kind].against);
  s->flow = has & COUETTE ? GG_COUETTE : has & SHEARED ? GG_USF : has & NOISE ? GG_HSS : GG_EQUILIBRIUM;
  if (has & NOISE) s->thermostat = has & IN_BATH ? GG_BATH : GG_WHITE_NOISE;
  if (has & IN_BATH) s->bath.drag = 0.1, s->bath.temperature = 1;
  for (int p = 0; p < GG_PAIRS; p++) {
    s->collision.e[p] = has & NEARLY ? 0.99 : has & (SHEARED | NOISE) ? 0.9 : 1;
    s->collision.beta[p] = has & FRICTIONAL ? 0.4 : !(has & ROUGH) ? -1 : has & SHEARED ? 0 : 1;
    s->collision.mu[p] = has & FRICTIONAL ? 0.123 : INFINITY;
  }
  if (has & WALLS) add_walls(s, has & GRAVITY);
  if (!(has & MIXTURE)) return c;
  s->n_species = 2;
  s->species[0].fraction = 0.5;
  s->species[1] = (gg_species){0.5, 1, 4, 0.4, 1, 0};
  return c;
}

/* Warm-up in collisions per grain; short for large systems of md, which start near equilibrium. */
static double warmup_of(const engine_bench *e, int64_t n, bool quick)
{
  return e->engine == GG_MD && n >= 1000000 ? 5 : quick ? 10 : e->engine == GG_MD ? 30 : 20;
}

static const char *engine_name(const engine_bench *e)
{
  return gg_common_engine_of(e->engine)->name;
}

static void put_rate(const gg_bench *b, gg_bench_table *t, const engine_bench *e, int row, int column, double phi,
                     int64_t n, const gg_timing *r)
{
  const bool is_md = e->engine == GG_MD;
  const gg_bench_value v = is_md ? gg_bench_rate(r, e->unit) : gg_bench_time(r, e->unit);
  if (is_md)
    gg_bench_table_put(t, row, column, "%.3g (%.3g - %.3g) %.0f ns", v.value * 1e-6, v.lowest * 1e-6, v.highest * 1e-6,
                       1e9 / v.value);
  else
    gg_bench_table_put(t, row, column, "%.2f (%.2f - %.2f)", v.value, v.lowest, v.highest);
  gg_bench_table_add(b, t, v, NULL, "{s:s, s:f, s:I}", "engine", engine_name(e), "phi", phi, "particles",
                     (json_int_t)n);
}

/* Measure the plain scene: a row for each size, a column for each density. */
static gg_status measure_rates(gg_bench *b, const engine_bench *e, gg_error *err)
{
  const bool quick = b->options->quick;
  gg_bench_table *t = gg_bench_table_new(b, e->rates, e->rates_caption, 1, err);
  if (!t) return GG_FAILED;
  gg_bench_table_column(t, true, "N");
  for (int d = 0; d < e->n_densities; d++) gg_bench_table_column(t, true, "phi %.4g", e->densities[d]);
  for (int i = 0; i < (quick ? e->quick_sizes : e->n_sizes); i++) {
    const int row = gg_bench_table_row(t, "%lld", (long long)e->sizes[i]);
    for (int d = 0; d < e->n_densities; d++) {
      gg_timing r;
      const gg_scene s = timed_scene(b, e, 0, e->densities[d], e->sizes[i]).scene;
      GG_TRY(gg_bench_throughput_measure(&s, warmup_of(e, e->sizes[i], quick), quick ? 3 : 7,
                                         gg_bench_seconds(b, quick ? 0.3 : 1), &r, err));
      put_rate(b, t, e, row, 1 + d, e->densities[d], e->sizes[i], &r);
      gg_bench_report(b, "phi %g N %lld: %.3g M/s", e->densities[d], (long long)e->sizes[i], r.rate.value * 1e-6);
    }
  }
  return GG_OK;
}

/* Put a ratio of rates; for dsmc the inverse, a ratio of times. */
static void put_ratio(const gg_bench *b, gg_bench_table *t, const engine_bench *e, int column, double phi, int64_t n,
                      int kind, const gg_timing *r)
{
  const bool is_md = e->engine == GG_MD;
  const feature *f = &e->features[kind];
  const gg_bench_value v = is_md ? gg_bench_rate(r, e->unit) : gg_bench_time(r, e->unit),
                       ratio = is_md ? r->ratio : gg_bench_inverse(r->ratio, 1);
  if (strcmp(f->against, f->name) == 0)
    gg_bench_table_put(t, kind, column, is_md ? "%.3g M/s" : "%.2f ns", is_md ? v.value * 1e-6 : v.value);
  else if (is_md)
    gg_bench_table_put(t, kind, column, "%.2f (%.2f - %.2f)", ratio.value, ratio.lowest, ratio.highest);
  else
    gg_bench_table_put(t, kind, column, "%.2f (%.2f - %.2f) %.1f ns", ratio.value, ratio.lowest, ratio.highest,
                       v.value);
  json_t *beside = json_pack("{s:s, s:f, s:f, s:f}", "against", f->against, "ratio", ratio.value, "ratio_lowest",
                             ratio.lowest, "ratio_highest", ratio.highest);
  gg_bench_table_add(b, t, v, beside, "{s:s, s:s, s:f, s:I}", "engine", engine_name(e), "scene", f->name, "phi", phi,
                     "particles", (json_int_t)n);
}

/* Measure the scenes with and without each feature, at one size: a row for each. */
static gg_status measure_ratios(gg_bench *b, const engine_bench *e, gg_error *err)
{
  const bool quick = b->options->quick;
  const int64_t n = quick ? e->quick_ratio_size : e->ratio_size;
  gg_bench_table *t = gg_bench_table_new(b, "ratios", e->ratios_caption, 2, err);
  if (!t) return GG_FAILED;
  gg_bench_table_column(t, false, "scene");
  gg_bench_table_column(t, false, "against");
  for (int k = 0; k < e->n_features; k++) {
    const int row = gg_bench_table_row(t, "%s", e->features[k].name);
    if (k) gg_bench_table_put(t, row, 1, "%s", e->features[k].against);
  }
  for (int d = 0; d < e->n_densities; d++) {
    const double phi = e->densities[d];
    const int column = gg_bench_table_column(t, true, "phi %.4g", phi);
    gg_timed_scene c[GG_MOST_TIMED];
    gg_timing r[GG_MOST_TIMED];
    for (int k = 0; k < e->n_features; k++) c[k] = timed_scene(b, e, k, phi, n);
    GG_TRY(gg_bench_throughput_compare(c, e->n_features, warmup_of(e, n, quick), quick ? 5 : 9,
                                       gg_bench_seconds(b, quick ? 0.1 : e->ratio_seconds), r, err));
    for (int k = 0; k < e->n_features; k++) put_ratio(b, t, e, column, phi, n, k, &r[k]);
    gg_bench_report(b, "ratios at phi %g N %lld done", phi, (long long)n);
  }
  return GG_OK;
}

/* The feature that only the second way has. Beside a neighbour both ways have so many processors as the second has
 * threads, and another thread keeps one of them busy. */
typedef enum second_way { IN_SINGLE_PRECISION, IN_BLOCKS, ON_THREADS, BESIDE_A_NEIGHBOUR } second_way;

#define IN_TURN "timed in turn; median (least - largest) of repeats"
static const struct {
  const char *key, *caption;
} ways[] = {
    {"precision",
     "Single precision: nanoseconds per accepted collision in double/in single precision, and the ratio of the rates; "
     "CPU time, one thread, phi 0.3; " IN_TURN},
    {"paths",
     "Speedup by blocks: nanoseconds per accepted collision in the plain loop (one random pair after another, under "
     "one majorant)/by blocks, and the ratio of the rates; CPU time, one thread; " IN_TURN},
    {"threads",
     "Speedup by threads within one run: the rate of collisions over that of one thread, in wall time, and processors "
     "busy on average; " IN_TURN},
    {"threads, busy neighbour",
     "The same on as many processors as threads, one of which another thread keeps busy, also beside the one thread; "
     "wall time, " IN_TURN},
};

static void take_plain_path(gg_engine *engine)
{
  gg_dsmc *d = (gg_dsmc *)engine;
  for (int p = 0; p < GG_PAIRS; p++) d->path[p] = GG_DSMC_PLAIN;
  gg_dsmc_start_majorants(d);
}

static void differ(gg_timed_scene way[2], second_way second, int threads)
{
  if (second == IN_SINGLE_PRECISION) way[1].scene.dsmc.precision = GG_SINGLE;
  if (second == IN_BLOCKS) way[0].prepare = take_plain_path;
  way[0].wall_time = way[1].wall_time = second >= ON_THREADS;
  way[0].neighbour = way[1].neighbour = second == BESIDE_A_NEIGHBOUR;
  way[1].threads = threads;
}

/* No cooling gas in single precision: without rescaling its velocities would leave the range. */
static bool has_two_ways(const feature *f, second_way second)
{
  return second == IN_SINGLE_PRECISION ? f->has & SHEARED || !(f->has & FRICTIONAL) : f->has & TWO_WAYS;
}

static void put_two(const gg_bench *b, gg_bench_table *t, const engine_bench *e, int row, int column, int kind,
                    double phi, int64_t n, const gg_timing r[2], int used)
{
  const gg_bench_value ratio = r[1].ratio;
  gg_bench_value v = gg_bench_time(&r[1], used > 1 ? gg_bench_wall_unit : dsmc.unit);
  v.threads = used;
  if (used > 1)
    gg_bench_table_put(t, row, column, "%.2f (%.2f - %.2f) %.2f of %d", ratio.value, ratio.lowest, ratio.highest,
                       r[1].processors, used);
  else
    gg_bench_table_put(t, row, column, "%.1f/%.1f ns %.2f (%.2f - %.2f)", 1e9 / r[0].rate.value, v.value, ratio.value,
                       ratio.lowest, ratio.highest);
  json_t *beside = json_pack("{s:f, s:f, s:f, s:f, s:f, s:f}", "other", 1e9 / r[0].rate.value, "ratio", ratio.value,
                             "ratio_lowest", ratio.lowest, "ratio_highest", ratio.highest, "processors",
                             r[1].processors, "neighbour", r[1].neighbour);
  gg_bench_table_add(b, t, v, beside, "{s:s, s:s, s:f, s:I}", "engine", engine_name(e), "scene", e->features[kind].name,
                     "phi", phi, "particles", (json_int_t)n);
}

/* Measure `sizes` sizes: a row for each kind of scene. */
static gg_status measure_two(gg_bench *b, const engine_bench *e, double phi, second_way second, int sizes, int used,
                             gg_error *err)
{
  const bool quick = b->options->quick;
  const int first = second >= ON_THREADS ? e->first_shared : 0;
  gg_bench_table *t = gg_bench_table_new(b, ways[second].key, ways[second].caption, 1, err);
  if (!t) return GG_FAILED;
  gg_bench_table_column(t, false, "%s, phi %g", engine_name(e), phi);
  for (int i = first; i < e->n_sizes && i < first + sizes; i++) {
    const int64_t n = e->sizes[i];
    const int column = gg_bench_table_column(t, true, "N %lld", (long long)n);
    for (int k = 0, row = 0; k < e->n_features; k++) {
      gg_timed_scene way[2] = {timed_scene(b, e, k, phi, n)};
      gg_timing r[2];
      if (!has_two_ways(&e->features[k], second)) continue;
      if (i == first) gg_bench_table_row(t, "%s", e->features[k].name);
      way[0].against = 0;
      way[1] = way[0];
      differ(way, second, used);
      GG_TRY(gg_bench_throughput_compare(way, 2, 5, quick ? 3 : 7,
                                         gg_bench_seconds(b, quick ? 0.25 * e->ratio_seconds : 2 * e->ratio_seconds), r,
                                         err));
      put_two(b, t, e, row++, column, k, phi, n, r, used);
    }
    gg_bench_report(b, "%s, N %lld done", ways[second].key, (long long)n);
  }
  return GG_OK;
}

/* With and without a neighbour. */
static gg_status measure_threads(gg_bench *b, const engine_bench *e, double phi, int sizes, int used, gg_error *err)
{
  if (used <= 1) gg_bench_report(b, "one processor: threads are not timed");
  for (second_way k = ON_THREADS; k <= BESIDE_A_NEIGHBOUR && used > 1; k++)
    GG_TRY(measure_two(b, e, phi, k, sizes, used, err));
  return GG_OK;
}

gg_status gg_bench_md(gg_bench *b, gg_error *err)
{
  const int sizes = b->options->quick ? 1 : 4, used = b->options->threads;
  GG_TRY(measure_rates(b, &md, err));
  GG_TRY(measure_ratios(b, &md, err));
  GG_TRY(measure_threads(b, &md, 0.3, sizes, used, err));
  return measure_threads(b, &md, 0.5, sizes, used, err);
}

gg_status gg_bench_dsmc(gg_bench *b, gg_error *err)
{
  const int sizes = b->options->quick ? 1 : 4;
  GG_TRY(measure_rates(b, &dsmc, err));
  GG_TRY(measure_rates(b, &dsmc_walls, err));
  GG_TRY(measure_ratios(b, &dsmc, err));
  GG_TRY(measure_two(b, &dsmc, 0.3, IN_SINGLE_PRECISION, sizes, 1, err));
  GG_TRY(measure_two(b, &dsmc, 0.3, IN_BLOCKS, sizes, 1, err));
  return measure_threads(b, &dsmc, 0.3, sizes, b->options->threads, err);
}

/* Rows of the overview: both engines in shear at e = 0.9. */
static const struct {
  const char *name;
  double beta, mu;
} kernels[] = {{"smooth", -1, INFINITY}, {"rough", 0, INFINITY}, {"frictional", 0.4, 0.123}};

static gg_status measure_overview(gg_bench *b, gg_bench_table *t, gg_engine_kind engine, double phi, int64_t n,
                                  gg_error *err)
{
  const bool quick = b->options->quick;
  const char *name = gg_common_engine_of(engine)->name;
  const int row = gg_bench_table_row(t, "%s", name);
  gg_bench_table_put(t, row, 1, "%g", phi);
  gg_bench_table_put(t, row, 2, "%lld", (long long)n);
  for (int k = 0; k < COUNT(kernels); k++) {
    gg_timing r;
    gg_scene s = gg_bench_scene(b, engine, phi, n);
    s.collision.beta[0] = kernels[k].beta;
    s.collision.mu[0] = kernels[k].mu;
    GG_TRY(gg_bench_throughput_measure(&s, 20, quick ? 3 : 5, gg_bench_seconds(b, quick ? 0.2 : 0.6), &r, err));
    gg_bench_table_put(t, row, 3 + k, "%.3g M/s (%.0f ns)", r.rate.value * 1e-6, 1e9 / r.rate.value);
    gg_bench_table_add(b, t, gg_bench_rate(&r, md.unit), NULL, "{s:s, s:s, s:f, s:I}", "engine", name, "kernel",
                       kernels[k].name, "phi", phi, "particles", (json_int_t)n);
  }
  gg_bench_report(b, "%s phi %g N %lld done", name, phi, (long long)n);
  return GG_OK;
}

gg_status gg_bench_overview(gg_bench *b, gg_error *err)
{
  static const char caption[] = "Collisions per CPU-second, one core; uniform shear, e = 0.9; median of repeats";
  const int n_sizes = b->options->quick ? 2 : 3, two = b->options->threads > 2 ? 2 : b->options->threads;
  gg_bench_table *t = gg_bench_table_new(b, "throughput", caption, 3, err);
  if (!t) return GG_FAILED;
  gg_bench_table_column(t, false, "engine");
  gg_bench_table_column(t, true, "phi");
  gg_bench_table_column(t, true, "N");
  for (int k = 0; k < COUNT(kernels); k++) gg_bench_table_column(t, true, "%s", kernels[k].name);
  for (int i = 0; i < 2 * 2 * n_sizes; i++)
    GG_TRY(measure_overview(b, t, (gg_engine_kind)(i / (2 * n_sizes)), md.densities[i / n_sizes % 2],
                            md.sizes[i % n_sizes], err));
  GG_TRY(gg_bench_scenes(b, err));
  GG_TRY(measure_threads(b, &md, 0.3, 1, two, err));
  return measure_threads(b, &dsmc, 0.3, 1, two, err);
}
