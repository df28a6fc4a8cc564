/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas bench observables: processor time that each observable adds to a run, at three sizes. */
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "bench/bench.h"
#include "bench/throughput.h"
#include "run/replica.h"
#include "run/run.h"
#include "scene/model_of_scene.h"
#include "theory/near_steady.h"

enum { MOST_REPEATS = 32, LEAST_CYCLE = 32 };

typedef struct cost_of_observable {
  gg_bench_value over; /* added time over that of the run without it */
  gg_bench_value ns;   /* time of a collision in the run with the observable */
} cost_of_observable;

typedef struct timed_run {
  gg_replica replica;
  bool bare; /* engine without sampling */
} timed_run;

static gg_status go_on(timed_run *c, uint64_t samples, bool adapt, gg_error *err)
{
  gg_replica *r = &c->replica;
  double gone;
  adapt = adapt || !gg_model_keeps_temperature(&r->model);
  if (!c->bare) return gg_run_replica_advance(r, r->clock.samples + samples, adapt, NULL, err);
  for (uint64_t k = 0; k < samples; k++)
    GG_TRY(r->engine->ops->advance(r->engine, r->clock.interval, UINT64_MAX, &gone, err));
  return GG_OK;
}

static gg_status start(timed_run *c, const gg_scene *scene, unsigned measure, double warmup, gg_error *err)
{
  gg_scene s = *scene;
  gg_model model;
  s.measure = measure;
  GG_TRY(gg_scene_model_make(&s, s.engine, &model, err));
  GG_TRY(gg_theory_start_near_steady(&model, err));
  GG_TRY(gg_run_replica_create(&c->replica, &s, &model, 0, err));
  GG_TRY(go_on(c, (uint64_t)(warmup / GG_SAMPLING_INTERVAL), true, err));
  GG_TRY(gg_run_replica_open_window(&c->replica, err));
  c->replica.clock.window_samples = gg_measure_bursts_of(&model).regular_from; /* as in a long run */
  return GG_OK;
}

/* Nanoseconds per collision, over a number of samples. */
static gg_status time_stretch(timed_run *c, uint64_t samples, double *ns, gg_error *err)
{
  const uint64_t before = gg_engine_state_of(c->replica.engine).collisions;
  double began = gg_base_clock_cpu();
  GG_TRY(go_on(c, samples, false, err));
  *ns = 1e9 * (gg_base_clock_cpu() - began) / (double)(gg_engine_state_of(c->replica.engine).collisions - before);
  return GG_OK;
}

/* Period of the observables' intervals, in samples. */
static uint64_t cycle_of(const gg_replica *r)
{
  const gg_engine_ops *ops = r->engine->ops;
  int cycle = LEAST_CYCLE;
  for (int k = 0; k < r->sampler.n_observables; k++) {
    if (r->sampler.every[k] > cycle) cycle = r->sampler.every[k];
    const gg_observable_collisions *c = r->sampler.observable[k]->collisions;
    if (c && c->begin_burst && ops->callback_slows && ops->callback_slows(r->engine))
      return gg_measure_bursts_of(&r->model).apart;
  }
  return (uint64_t)cycle;
}

static gg_status compare(timed_run c[2], int repeats, double seconds, cost_of_observable *cost, gg_error *err)
{
  double over[MOST_REPEATS], ns[2][MOST_REPEATS], began = gg_base_clock_cpu();
  uint64_t cycles = 1, cycle = cycle_of(&c[1].replica);
  GG_TRY(go_on(&c[0], cycle, false, err));
  GG_TRY(go_on(&c[1], cycle, false, err));
  cycles += (uint64_t)(2 * seconds / fmax(gg_base_clock_cpu() - began, 1e-6));
  for (int i = 0; i < repeats; i++) {
    for (int k = 0; k < 2; k++) GG_TRY(time_stretch(&c[k], cycles * cycle, &ns[k][i], err));
    over[i] = ns[1][i] / ns[0][i] - 1;
  }
  *cost = (cost_of_observable){gg_bench_spread("", over, repeats), gg_bench_spread("ns per collision", ns[1], repeats)};
  return GG_OK;
}

/* Time the scene with `rheology` and this observable, and with rheology alone (for rheology itself: with the engine
 * that is not sampled), in turn: `repeats` stretches of at least `seconds` each, after `warmup` collisions per grain.
 * The sampling interval is that of any run. */
static gg_status measure_cost(const gg_scene *scene, const gg_observable *o, double warmup, int repeats, double seconds,
                              cost_of_observable *cost, gg_error *err)
{
  timed_run c[2] = {0};
  gg_status status = start(&c[0], scene, GG_MEASURE_RHEOLOGY, warmup, err);
  if (status == GG_OK) status = start(&c[1], scene, GG_MEASURE_RHEOLOGY | o->flag, warmup, err);
  c[0].bare = o->flag == GG_MEASURE_RHEOLOGY;
  if (status == GG_OK) status = compare(c, repeats < MOST_REPEATS ? repeats : MOST_REPEATS, seconds, cost, err);
  for (int k = 0; k < 2; k++)
    if (c[k].replica.engine) gg_run_replica_clear(&c[k].replica);
  return status;
}

static const char caption[] =
    "Processor time that each observable adds at its own cadence, in per cent of the run without it, timed in turn "
    "with it: median (least - largest) of repeats. rheology: against an engine that is not sampled. Uniform shear, e = "
    "0.9, rough grains (beta = 0); sonine and conductivity (of smooth grains) in free cooling, profiles in Couette "
    "flow, viscosity in its flow. -: cannot be had, or only of elastic grains or a wave";

static const double densities[] = {0.01, 0.3};
static const int64_t sizes[] = {500, 4000, 32000}, quick_sizes[] = {500, 2000, 4000};
enum { N_DENSITIES = 2, N_SIZES = 3 };

/* A column: an engine at a density and a size. */
typedef struct setting {
  gg_engine_kind engine;
  double phi;
  int64_t n;
} setting;

static const int64_t *sizes_of(const gg_bench *b)
{
  return b->options->quick ? quick_sizes : sizes;
}

/* Number of different sizes, after reduction by options->smaller. */
static int n_sizes_of(const gg_bench *b)
{
  int64_t grains[N_SIZES];
  int n = 0;
  for (int k = 0; k < N_SIZES; k++) {
    grains[k] = gg_bench_scene(b, GG_MD, densities[0], sizes_of(b)[k]).particles;
    n += k == 0 || grains[k] != grains[k - 1];
  }
  return n;
}

static setting setting_of(const gg_bench *b, int n_sizes, int i)
{
  return (setting){(gg_engine_kind)(i / (N_DENSITIES * n_sizes)), densities[i / n_sizes % N_DENSITIES],
                   sizes_of(b)[i % n_sizes + N_SIZES - n_sizes]};
}

/* Find a scene for an observable: the usual flow, or the first other inelastic one that has the observable. */
static bool find_scene_with(const gg_bench *b, const setting *c, const gg_observable *o, double beta, gg_scene *scene)
{
  for (int k = -1; k < GG_N_FLOWS; k++) {
    gg_model model;
    *scene = gg_bench_scene(b, c->engine, c->phi, c->n);
    if (k >= 0) scene->flow = (gg_flow)k;
    if (gg_flow_of(scene->flow)->conserves) continue;
    memcpy(scene->gravity, gg_flow_of(scene->flow)->gravity, sizeof scene->gravity);
    for (int p = 0; p < GG_PAIRS; p++) scene->collision.beta[p] = beta;
    if (gg_scene_model_make(scene, c->engine, &model, NULL) != GG_OK) continue;
    if (gg_common_engine_of(c->engine)->accepts(&model, NULL) != GG_OK) continue;
    if (!o->refuses || !o->refuses(&model)) return true;
  }
  return false;
}

static gg_status measure(gg_bench *b, gg_bench_table *table, int row, int i, const gg_observable *o, gg_error *err)
{
  gg_scene scene;
  cost_of_observable cost;
  setting c = setting_of(b, n_sizes_of(b), i);
  gg_bench_table_put(table, row, 1 + i, "-");
  if (!find_scene_with(b, &c, o, 0, &scene) && !find_scene_with(b, &c, o, -1, &scene)) return GG_OK;
  GG_TRY(measure_cost(&scene, o, b->options->quick ? 10 : 30, c.n > 10000 || b->options->quick ? 3 : 15,
                      gg_bench_seconds(b, b->options->quick ? 0.01 : 0.15), &cost, err));
  const gg_bench_value *over = &cost.over;
  gg_bench_table_put(table, row, 1 + i, "%.0f %% (%.0f - %.0f)", 100 * over->value, 100 * over->lowest,
                     100 * over->highest);
  json_t *overhead = json_pack("{s:f, s:f, s:f}", "overhead", over->value, "overhead_lowest", over->lowest,
                               "overhead_highest", over->highest);
  gg_bench_table_add(b, table, cost.ns, overhead, "{s:s, s:s, s:f, s:I}", "observable", o->name, "engine",
                     gg_common_engine_of(c.engine)->name, "phi", c.phi, "particles", (json_int_t)c.n);
  return GG_OK;
}

gg_status gg_bench_observables(gg_bench *b, gg_error *err)
{
  gg_bench_table *table = gg_bench_table_new(b, "observables", caption, 1, err);
  if (!table) return GG_FAILED;
  gg_bench_table_column(table, false, "observable");
  const int n_sizes = n_sizes_of(b), n_cases = 2 * N_DENSITIES * n_sizes;
  for (int i = 0; i < n_cases; i++) {
    setting c = setting_of(b, n_sizes, i);
    gg_bench_table_column(table, true, "%s phi %g N %lld", gg_common_engine_of(c.engine)->name, c.phi, (long long)c.n);
  }
  for (int k = 0; gg_measure_observables[k]; k++) {
    const int row = gg_bench_table_row(table, "%s", gg_measure_observables[k]->name);
    for (int i = 0; i < n_cases; i++) GG_TRY(measure(b, table, row, i, gg_measure_observables[k], err));
    gg_bench_report(b, "%s done", gg_measure_observables[k]->name);
  }
  return GG_OK;
}
