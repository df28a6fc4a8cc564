#include "bench/observable_cost.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

#include "base/clock.h"
#include "run/replica.h"
#include "run/run.h"

enum { MOST_REPEATS = 32, LEAST_CYCLE = 32 };

typedef struct timed_run {
  gg_replica replica;
  bool bare; /* the engine alone */
} timed_run;

static uint64_t collisions(const timed_run *c)
{
  gg_engine_state state;
  c->replica.engine->ops->state(c->replica.engine, &state);
  return state.collisions;
}

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
  GG_TRY(gg_common_model_make(&s, s.engine, &model, err));
  GG_TRY(gg_run_start_near_steady(&model, err));
  GG_TRY(gg_run_replica_create(&c->replica, &s, &model, 0, err));
  GG_TRY(go_on(c, (uint64_t)(warmup / GG_SAMPLING_INTERVAL), true, err));
  GG_TRY(gg_run_replica_open_window(&c->replica, err));
  c->replica.clock.window_samples = gg_run_sampling_bursts_of(&model).settled; /* the cost is that of long runs */
  return GG_OK;
}

/* Nanoseconds a collision, over `samples`. */
static gg_status time_stretch(timed_run *c, uint64_t samples, double *ns, gg_error *err)
{
  uint64_t before = collisions(c);
  double began = gg_base_clock_cpu();
  GG_TRY(go_on(c, samples, false, err));
  *ns = 1e9 * (gg_base_clock_cpu() - began) / (double)(collisions(c) - before);
  return GG_OK;
}

/* Samples in which every observable is due as often as ever. */
static uint64_t cycle_of(const gg_replica *r)
{
  const gg_engine_ops *ops = r->engine->ops;
  int cycle = LEAST_CYCLE;
  for (int k = 0; k < r->n_observables; k++) {
    if (r->every[k] > cycle) cycle = r->every[k];
    if (r->observable[k]->begin_episode && ops->callback_slows && ops->callback_slows(r->engine))
      return gg_run_sampling_bursts_of(&r->model).apart;
  }
  return (uint64_t)cycle;
}

static gg_status compare(timed_run c[2], int repeats, double seconds, gg_observable_cost *cost, gg_error *err)
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
  gsl_sort(over, 1, (size_t)repeats);
  gsl_sort(ns[1], 1, (size_t)repeats);
  *cost = (gg_observable_cost){.overhead = gsl_stats_median_from_sorted_data(over, 1, (size_t)repeats),
                               .lowest = over[0],
                               .highest = over[repeats - 1],
                               .ns = gsl_stats_median_from_sorted_data(ns[1], 1, (size_t)repeats),
                               .repeats = repeats};
  return GG_OK;
}

gg_status gg_bench_observable_cost_measure(const gg_scene *scene, const gg_observable *o, double warmup, int repeats,
                                           double seconds, gg_observable_cost *cost, gg_error *err)
{
  timed_run c[2] = {0};
  bool itself = o->flag == GG_MEASURE_RHEOLOGY;
  gg_status status = start(&c[0], scene, GG_MEASURE_RHEOLOGY, warmup, err);
  if (status == GG_OK) status = start(&c[1], scene, GG_MEASURE_RHEOLOGY | o->flag, warmup, err);
  if (status == GG_OK && itself) {
    c[0].bare = true;
    c[0].replica.engine->ops->keep_sums(c[0].replica.engine, false);
  }
  if (status == GG_OK) status = compare(c, repeats < MOST_REPEATS ? repeats : MOST_REPEATS, seconds, cost, err);
  for (int k = 0; k < 2; k++)
    if (c[k].replica.engine) gg_run_replica_clear(&c[k].replica);
  return status;
}
