/* graingas bench observables: what each observable costs, as its share of a run's time. */
#include "bench/bench.h"
#include "bench/observable_cost.h"

static const char caption[] =
    "Share of a run's processor time that each observable takes at its own cadence, timed in turn with the same run "
    "without it: median (least - largest) of repeats. rheology: against an engine that is not sampled. Uniform shear, "
    "e = 0.9, rough grains (beta = 0), md N = 1000, dsmc N = 5000; sonine in free cooling, profiles in Couette flow. "
    "-: cannot be had";

static const double densities[] = {0.01, 0.3};
enum { N_DENSITIES = 2 };

/* The scene to measure it in: sheared, or the first of the other flows that have it. */
static bool find_scene(const gg_bench *b, gg_engine_kind engine, double phi, const gg_observable *o, gg_scene *scene)
{
  static const gg_flow flows[] = {GG_USF, GG_HCS, GG_COUETTE};
  for (int k = 0; k < 3; k++) {
    gg_model model;
    *scene = gg_bench_scene(b, engine, phi, engine == GG_MD ? 1000 : 5000);
    scene->flow = flows[k];
    for (int p = 0; p < GG_PAIRS; p++) scene->collision.beta[p] = 0;
    if (gg_model_make(scene, engine, &model, NULL) != GG_OK) continue;
    if (gg_engine_ops_of(engine)->accepts(&model, NULL) != GG_OK) continue;
    if (!o->refuses || !o->refuses(&model)) return true;
  }
  return false;
}

static gg_status measure(gg_bench *b, gg_bench_sheet *sheet, int row, gg_engine_kind engine, int d,
                         const gg_observable *o, gg_error *err)
{
  gg_scene scene;
  gg_observable_cost cost;
  bool quick = b->options->quick;
  int column = 1 + (int)engine * N_DENSITIES + d;
  const char *name = gg_engine_ops_of(engine)->name;
  gg_bench_sheet_put(sheet, row, column, "-");
  if (!find_scene(b, engine, densities[d], o, &scene)) return GG_OK;
  GG_TRY(gg_observable_cost_measure(&scene, o, 30, quick ? 5 : 15, quick ? 0.02 : 0.15, &cost, err));
  gg_bench_sheet_put(sheet, row, column, "%.1f %% (%.1f - %.1f)", 100 * cost.share, 100 * cost.lowest,
                     100 * cost.highest);
  json_array_append_new(sheet->rows,
                        json_pack("{s:s, s:s, s:f, s:I, s:f, s:f, s:f, s:f, s:s}", "observable", o->name, "engine",
                                  name, "phi", densities[d], "particles", (json_int_t)(engine == GG_MD ? 1000 : 5000),
                                  "share", cost.share, "least", cost.lowest, "largest", cost.highest, "ns", cost.ns,
                                  "unit", "share of the run's CPU time; ns a collision with it"));
  return GG_OK;
}

gg_status gg_bench_observables(gg_bench *b, gg_error *err)
{
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "observables", caption, 1, err);
  if (!sheet) return GG_FAILED;
  gg_bench_sheet_column(sheet, false, "observable");
  for (int k = 0; k < 2; k++)
    for (int d = 0; d < N_DENSITIES; d++) {
      gg_bench_sheet_column(sheet, true, "%s phi %g", gg_engine_ops_of((gg_engine_kind)k)->name, densities[d]);
    }
  for (int i = 0; gg_observables[i]; i++) {
    const gg_observable *o = gg_observables[i];
    int row = gg_bench_sheet_row(sheet);
    gg_bench_sheet_put(sheet, row, 0, "%s", o->name);
    for (int k = 0; k < 2; k++)
      for (int d = 0; d < N_DENSITIES; d++) GG_TRY(measure(b, sheet, row, (gg_engine_kind)k, d, o, err));
    gg_bench_tell(b, "%s done", o->name);
  }
  return GG_OK;
}
