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
  double e, phi;
  int64_t n;
  int threads; /* threads, timed in wall time; 0: one, timed in processor time */
  bool start;  /* time the placement of grains */
} single;

static const single singles[] = {
    {"elastic", GG_MD, GG_EQUILIBRIUM, 1, 0.3, 10000, 0, false},
    {"white noise, e = 0.99", GG_MD, GG_HSS, 0.99, 0.3, 10000, 0, false},
    {"white noise, e = 0.9", GG_MD, GG_HSS, 0.9, 0.3, 10000, 0, false},
    {"walls (couette), e = 0.9", GG_MD, GG_COUETTE, 0.9, 0.3, 10000, 0, false},
    {"start, per grain", GG_MD, GG_EQUILIBRIUM, 1, 0.3, 100000, 0, true},
    {"start, per grain", GG_MD, GG_EQUILIBRIUM, 1, 0.5, 100000, 0, true},
    {"white noise, e = 0.9", GG_DSMC, GG_HSS, 0.9, 0.3, 10000, 0, false},
    {"walls (couette), e = 0.9", GG_DSMC, GG_COUETTE, 0.9, 0.01, 100000, 0, false},
    {"start, per grain", GG_DSMC, GG_EQUILIBRIUM, 1, 0.3, 100000, 0, true},
    {"one thread", GG_DSMC, GG_EQUILIBRIUM, 1, 0.3, 100000, 1, false},
    {"two threads", GG_DSMC, GG_EQUILIBRIUM, 1, 0.3, 100000, 2, false},
};
enum { N_SINGLES = sizeof singles / sizeof *singles, REPEATS = 5 };

static gg_timed_scene timed_scene(const gg_bench *b, const single *s)
{
  gg_timed_scene c = {
      .scene = gg_bench_scene(b, s->engine, s->phi, s->n), .threads = s->threads, .wall_time = s->threads > 0};
  c.scene.flow = s->flow;
  c.scene.collision.e[0] = s->e;
  if (s->flow == GG_HSS) c.scene.thermostat = GG_WHITE_NOISE;
  if (s->flow == GG_COUETTE && s->engine == GG_DSMC)
    c.scene.particles = 1000; /* the channel has the width of md's with this number of grains */
  return c;
}

static gg_status time_start(const gg_scene *scene, const gg_model *model, double *ns, gg_error *err)
{
  const gg_engine_ops *ops = gg_common_engine_of(scene->engine);
  gg_engine *engine;
  const double began = gg_base_clock_cpu();
  GG_TRY(ops->create(model, scene->run.seed, 0, &engine, err));
  *ns = 1e9 * (gg_base_clock_cpu() - began) / (double)model->n;
  engine->ops->destroy(engine);
  return GG_OK;
}

static gg_status measure_start(const gg_scene *scene, int repeats, gg_bench_value *v, gg_error *err)
{
  gg_model model;
  double ns[REPEATS];
  GG_TRY(gg_scene_model_make(scene, scene->engine, &model, err));
  for (int i = 0; i < repeats; i++) GG_TRY(time_start(scene, &model, &ns[i], err));
  *v = gg_bench_spread("ns per grain", ns, repeats);
  return GG_OK;
}

static gg_status measure(const gg_bench *b, const single *s, gg_bench_value *v, gg_error *err)
{
  const bool quick = b->options->quick;
  const int repeats = quick ? 3 : REPEATS;
  const gg_timed_scene c = timed_scene(b, s);
  gg_timing r;
  if (s->start) return measure_start(&c.scene, repeats, v, err);
  GG_TRY(gg_bench_throughput_compare(&c, 1, quick ? 10 : 20, repeats, gg_bench_seconds(b, quick ? 0.2 : 0.6), &r, err));
  *v = gg_bench_time(&r, s->threads ? gg_bench_wall_unit : "ns per collision");
  v->threads = s->threads;
  return GG_OK;
}

gg_status gg_bench_scenes(gg_bench *b, gg_error *err)
{
  static const char *const head[] = {"scene", "engine", "phi", "N", "ns"};
  gg_bench_table *t =
      gg_bench_table_new(b, "scenes",
                         "Single scenes, smooth grains, nothing measured: nanoseconds per collision, in CPU time, with "
                         "threads in wall time; median (least - largest) of repeats. start: placement of the grains",
                         2, err);
  for (int k = 0; t && k < 5; k++) gg_bench_table_column(t, k > 1, "%s", head[k]);
  for (const single *s = singles; t && s < singles + N_SINGLES; s++) {
    gg_bench_value v;
    const char *engine = gg_common_engine_of(s->engine)->name;
    GG_TRY(measure(b, s, &v, err));
    const int row = gg_bench_table_row(t, "%s", s->name);
    gg_bench_table_put(t, row, 1, "%s", engine);
    gg_bench_table_put(t, row, 2, "%g", s->phi);
    gg_bench_table_put(t, row, 3, "%lld", (long long)s->n);
    gg_bench_table_put(t, row, 4, "%.3g (%.3g - %.3g)", v.value, v.lowest, v.highest);
    gg_bench_table_add(b, t, v, NULL, "{s:s, s:s, s:f, s:I}", "engine", engine, "scene", s->name, "phi", s->phi,
                       "particles", (json_int_t)s->n);
    gg_bench_report(b, "%s, %s done", engine, s->name);
  }
  return t ? GG_OK : GG_FAILED;
}
