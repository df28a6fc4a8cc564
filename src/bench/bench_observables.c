/* graingas bench observables: what each observable costs, over the time of a run without it, at three sizes. */
#include <string.h>

#include "bench/bench.h"
#include "bench/observable_cost.h"

static const char caption[] =
    "Processor time that each observable adds at its own cadence, in per cent of the run without it, timed in turn "
    "with "
    "it: median (least - largest) of repeats. rheology: against an engine that is not sampled. Uniform shear, e = 0.9, "
    "rough grains (beta = 0); sonine in free cooling, profiles in Couette flow, viscosity in its flow. -: cannot be "
    "had";

static const double densities[] = {0.01, 0.3};
static const int64_t sizes[] = {500, 4000, 32000}, quick_sizes[] = {500, 2000, 4000};
enum { N_DENSITIES = 2, N_SIZES = 3, N_CASES = 2 * N_DENSITIES * N_SIZES };

/* An engine at a density and a size: a column each. */
typedef struct setting {
  gg_engine_kind engine;
  double phi;
  int64_t n;
} setting;

static setting setting_of(const gg_bench *b, int i)
{
  return (setting){(gg_engine_kind)(i / (N_DENSITIES * N_SIZES)), densities[i / N_SIZES % N_DENSITIES],
                   (b->options->quick ? quick_sizes : sizes)[i % N_SIZES]};
}

/* The scene to measure it in: of the usual flow, or of the first other one that has it and whose grains may lose
 * energy.
 */
static bool find_scene(const gg_bench *b, const setting *c, const gg_observable *o, gg_scene *scene)
{
  for (int k = -1; k < GG_N_FLOWS; k++) {
    gg_model model;
    *scene = gg_bench_scene(b, c->engine, c->phi, c->n);
    if (k >= 0) scene->flow = (gg_flow)k;
    if (gg_flow_of(scene->flow)->conserves) continue;
    memcpy(scene->gravity, gg_flow_of(scene->flow)->gravity, sizeof scene->gravity);
    for (int p = 0; p < GG_PAIRS; p++) scene->collision.beta[p] = 0;
    if (gg_common_model_make(scene, c->engine, &model, NULL) != GG_OK) continue;
    if (gg_run_engine_ops_of(c->engine)->accepts(&model, NULL) != GG_OK) continue;
    if (!o->refuses || !o->refuses(&model)) return true;
  }
  return false;
}

/* Stretches of large systems are long by themselves, and scatter less. */
static int repeats_of(const gg_bench *b, int64_t n)
{
  return n > 10000 || b->options->quick ? 3 : 15;
}

static gg_status measure(gg_bench *b, gg_bench_sheet *sheet, int row, int i, const gg_observable *o, gg_error *err)
{
  gg_scene scene;
  gg_observable_cost cost;
  setting c = setting_of(b, i);
  gg_bench_sheet_put(sheet, row, 1 + i, "-");
  if (!find_scene(b, &c, o, &scene)) return GG_OK;
  GG_TRY(gg_bench_observable_cost_measure(&scene, o, b->options->quick ? 10 : 30, repeats_of(b, c.n),
                                          gg_bench_seconds(b, b->options->quick ? 0.01 : 0.15), &cost, err));
  gg_bench_sheet_put(sheet, row, 1 + i, "%.0f %% (%.0f - %.0f)", 100 * cost.overhead, 100 * cost.lowest,
                     100 * cost.highest);
  json_array_append_new(sheet->rows,
                        json_pack("{s:s, s:s, s:f, s:I, s:f, s:f, s:f, s:f, s:s}", "observable", o->name, "engine",
                                  gg_run_engine_ops_of(c.engine)->name, "phi", c.phi, "particles", (json_int_t)c.n,
                                  "overhead", cost.overhead, "least", cost.lowest, "largest", cost.highest, "ns",
                                  cost.ns, "unit", "over the CPU time of the run without it; ns a collision with it"));
  return GG_OK;
}

gg_status gg_bench_observables(gg_bench *b, gg_error *err)
{
  gg_bench_sheet *sheet = gg_bench_new_sheet(b, "observables", caption, 1, err);
  if (!sheet) return GG_FAILED;
  gg_bench_sheet_column(sheet, false, "observable");
  for (int i = 0; i < N_CASES; i++) {
    setting c = setting_of(b, i);
    gg_bench_sheet_column(sheet, true, "%s phi %g N %lld", gg_run_engine_ops_of(c.engine)->name, c.phi, (long long)c.n);
  }
  for (int k = 0; gg_measure_observables[k]; k++) {
    int row = gg_bench_sheet_row(sheet);
    gg_bench_sheet_put(sheet, row, 0, "%s", gg_measure_observables[k]->name);
    for (int i = 0; i < N_CASES; i++) GG_TRY(measure(b, sheet, row, i, gg_measure_observables[k], err));
    gg_bench_tell(b, "%s done", gg_measure_observables[k]->name);
  }
  return GG_OK;
}
