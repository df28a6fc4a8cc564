/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench, second table: single scenes that may be slow, and starts. */
#include "base/clock.h"
#include "bench/bench.h"
#include "bench/throughput.h"
#include "run/run.h"
#include "scene/model_of_scene.h"

typedef struct single {
  const char *name;
  gg_engine_kind engine;
  gg_flow flow;
  double e, beta, phi[3]; /* densities, a row each; 0: none */
  int64_t n;
  gg_thermostat thermostat;
  bool start; /* time the placement of grains */
} single;

static const single singles[] = {
    {"elastic", GG_MD, GG_EQUILIBRIUM, 1, -1, {0.3}, .n = 10000},
    {"white noise, e = 0.99", GG_MD, GG_HSS, 0.99, -1, {0.3}, .n = 10000, .thermostat = GG_WHITE_NOISE},
    {"white noise, e = 0.9", GG_MD, GG_HSS, 0.9, -1, {0.3}, .n = 10000, .thermostat = GG_WHITE_NOISE},
    {"bath, e = 0.9", GG_MD, GG_HSS, 0.9, -1, {0.01, 0.3, 0.5}, .n = 10000, .thermostat = GG_BATH},
    {"bath, e = 0.9, beta = 0.5", GG_MD, GG_HSS, 0.9, 0.5, {0.01, 0.3, 0.5}, .n = 10000, .thermostat = GG_BATH},
    {"walls (couette), e = 0.9", GG_MD, GG_COUETTE, 0.9, -1, {0.01, 0.3, 0.5}, .n = 10000},
    {"start, per grain", GG_MD, GG_EQUILIBRIUM, 1, -1, {0.3, 0.5}, .n = 100000, .start = true},
    {"white noise, e = 0.9", GG_DSMC, GG_HSS, 0.9, -1, {0.3}, .n = 10000, .thermostat = GG_WHITE_NOISE},
    {"walls (couette), e = 0.9", GG_DSMC, GG_COUETTE, 0.9, -1, {0.01, 0.3, 0.5}, .n = 5000},
    {"start, per grain", GG_DSMC, GG_EQUILIBRIUM, 1, -1, {0.3}, .n = 100000, .start = true},
};
enum { N_SINGLES = sizeof singles / sizeof *singles, REPEATS = 5 };

static gg_scene scene_of(const gg_bench *b, const single *s, double phi)
{
  gg_scene scene = gg_bench_scene(b, s->engine, phi, s->n);
  scene.flow = s->flow;
  scene.thermostat = s->thermostat;
  scene.bath.drag = 0.1, scene.bath.temperature = 1;
  scene.collision.e[0] = s->e;
  scene.collision.beta[0] = s->beta;
  return scene;
}

static gg_status measure_start(const gg_scene *scene, int repeats, gg_bench_value *v, gg_error *err)
{
  gg_model model;
  gg_engine *engine;
  double ns[REPEATS];
  GG_TRY(gg_scene_model_make(scene, scene->engine, &model, err));
  for (int i = 0; i < repeats; i++) {
    const double began = gg_base_clock_cpu();
    GG_TRY(gg_common_engine_of(scene->engine)->create(&model, scene->run.seed, 0, &engine, err));
    ns[i] = 1e9 * (gg_base_clock_cpu() - began) / (double)model.n;
    engine->ops->destroy(engine);
  }
  *v = gg_bench_spread("ns per grain", ns, repeats);
  return GG_OK;
}

static gg_status measure(gg_bench *b, gg_bench_table *t, const single *s, double phi, gg_error *err)
{
  const bool quick = b->options->quick;
  const int repeats = quick ? 3 : REPEATS;
  const gg_scene scene = scene_of(b, s, phi);
  const char *engine = gg_common_engine_of(s->engine)->name;
  gg_bench_value v;
  gg_timing r;
  GG_TRY(s->start ? measure_start(&scene, repeats, &v, err)
                  : gg_bench_throughput_measure(&scene, quick ? 10 : 20, repeats,
                                                gg_bench_seconds(b, quick ? 0.2 : 0.6), &r, err));
  if (!s->start) v = gg_bench_time(&r, "ns per collision");
  const int row = gg_bench_table_row(t, "%s", s->name);
  gg_bench_table_put(t, row, 1, "%s", engine);
  gg_bench_table_put(t, row, 2, "%g", phi);
  gg_bench_table_put(t, row, 3, "%lld", (long long)s->n);
  gg_bench_table_put(t, row, 4, "%.3g (%.3g - %.3g)", v.value, v.lowest, v.highest);
  gg_bench_table_add(b, t, v, NULL, "{s:s, s:s, s:f, s:I}", "engine", engine, "scene", s->name, "phi", phi, "particles",
                     (json_int_t)s->n);
  gg_bench_report(b, "%s, %s, phi %g done", engine, s->name, phi);
  return GG_OK;
}

gg_status gg_bench_scenes(gg_bench *b, gg_error *err)
{
  static const char *const head[] = {"scene", "engine", "phi", "N", "ns"};
  gg_bench_table *t =
      gg_bench_table_new(b, "scenes",
                         "Single scenes, not sampled: nanoseconds of CPU time per collision between grains; "
                         "median (least - largest) of repeats. Smooth unless the name has beta; bath: drag 0.1; start: "
                         "placement of the grains",
                         2, err);
  if (!t) return GG_FAILED;
  for (int k = 0; k < 5; k++) gg_bench_table_column(t, k > 1, "%s", head[k]);
  for (const single *s = singles; s < singles + N_SINGLES; s++)
    for (int k = 0; k < 3 && s->phi[k] > 0; k++) GG_TRY(measure(b, t, s, s->phi[k], err));
  return GG_OK;
}
