/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/throughput.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

#include "base/clock.h"
#include "run/run.h"
#include "scene/model_of_scene.h"
#include "theory/near_steady.h"

enum { MOST_REPEATS = 32 };

const char gg_bench_wall_unit[] = "ns per collision, wall time";

/* State of the timing of a scene. */
typedef struct timed {
  gg_engine *engine;
  uint64_t guess; /* collisions between two readings of the clock */
  bool wall_time;
  double wall, cpu; /* totals */
  double rate[MOST_REPEATS];
} timed;

/* Advance by about `count` collisions; *done is their number. */
static gg_status advance_by(gg_engine *e, uint64_t count, uint64_t *done, gg_error *err)
{
  const uint64_t before = gg_engine_state_of(e).collisions;
  double elapsed;
  *done = 0;
  do {
    GG_TRY(e->ops->advance(e, 1e300, count - *done, &elapsed, err));
    *done = gg_engine_state_of(e).collisions - before;
  } while (*done < count);
  return GG_OK;
}

static double cpu_used(const gg_engine *e)
{
  return gg_base_clock_cpu() + gg_engine_state_of(e).others_cpu;
}

static double read_clock(const timed *r)
{
  return r->wall_time ? gg_base_clock_wall() : cpu_used(r->engine);
}

/* Time one stretch, extended until it is long enough. */
static gg_status time_stretch(timed *r, double seconds, double *rate, gg_error *err)
{
  double start = read_clock(r), gone, wall = gg_base_clock_wall(), cpu = cpu_used(r->engine);
  uint64_t sum = 0;
  do {
    uint64_t done;
    GG_TRY(advance_by(r->engine, r->guess, &done, err));
    sum += done;
    gone = read_clock(r) - start;
    if (gone < seconds / 4) r->guess *= 2;
  } while (gone < seconds);
  *rate = (double)sum / gone;
  r->wall += gg_base_clock_wall() - wall;
  r->cpu += cpu_used(r->engine) - cpu;
  return GG_OK;
}

static gg_status start(const gg_timed_scene *c, double warmup, timed *r, gg_error *err)
{
  const gg_scene *scene = &c->scene;
  gg_model model;
  uint64_t done;
  GG_TRY(gg_scene_model_make(scene, scene->engine, &model, err));
  const gg_engine_ops *ops = gg_common_engine_of(scene->engine);
  GG_TRY(ops->accepts(&model, err));
  GG_TRY(gg_theory_start_near_steady(&model, err));
  GG_TRY(ops->create(&model, scene->run.seed, 0, &r->engine, err));
  r->wall_time = c->wall_time;
  ops = r->engine->ops;
  if (c->threads > 1 && ops->threads) ops->threads(r->engine, c->threads);
  if (c->prepare) c->prepare(r->engine);
  r->guess = (uint64_t)model.n / 4 + 1000;
  return advance_by(r->engine, (uint64_t)(warmup * (double)model.n / 2) + 1, &done, err);
}

gg_bench_value gg_bench_spread(const char *unit, double *values, int n)
{
  gsl_sort(values, 1, (size_t)n);
  return (gg_bench_value){unit, gsl_stats_median_from_sorted_data(values, 1, (size_t)n), values[0], values[n - 1], n,
                          1};
}

static gg_timing compare(const timed *r, const timed *other, double neighbour, int repeats)
{
  double rate[MOST_REPEATS], ratio[MOST_REPEATS];
  for (int i = 0; i < repeats; i++) rate[i] = r->rate[i], ratio[i] = r->rate[i] / other->rate[i];
  return (gg_timing){gg_bench_spread("", rate, repeats), gg_bench_spread("", ratio, repeats), r->cpu / r->wall,
                     neighbour};
}

static gg_status time_all(const gg_timed_scene *c, int n, double warmup, int repeats, double seconds, timed *r,
                          gg_error *err)
{
  for (int k = 0; k < n; k++) GG_TRY(start(&c[k], warmup, &r[k], err));
  for (int i = 0; i < repeats; i++)
    for (int k = 0; k < n; k++) GG_TRY(time_stretch(&r[k], seconds, &r[k].rate[i], err));
  return GG_OK;
}

/* A busy neighbour, as another process would be: a thread that spins. The calling thread and all that it starts after
 * the neighbour have so many processors, of which the neighbour wants one. */
typedef struct neighbour {
  pthread_t thread;
  atomic_bool over;
  double began, busy; /* wall time at its start; processors that it had, on average */
#ifdef __linux__
  cpu_set_t before;
#endif
} neighbour;

static void *spin(void *context)
{
  neighbour *b = context;
  while (!atomic_load_explicit(&b->over, memory_order_relaxed)) continue;
  b->busy = gg_base_clock_cpu() / (gg_base_clock_wall() - b->began);
  return NULL;
}

static gg_status start_neighbour(neighbour *b, int processors, gg_error *err)
{
#ifdef __linux__
  sched_getaffinity(0, sizeof b->before, &b->before);
  cpu_set_t few = b->before;
  for (int k = CPU_SETSIZE - 1; k >= 0 && CPU_COUNT(&few) > processors; k--) CPU_CLR(k, &few);
  sched_setaffinity(0, sizeof few, &few);
#endif
  b->began = gg_base_clock_wall();
  return pthread_create(&b->thread, NULL, spin, b) ? gg_base_fail(err, GG_FAILED, "no thread can be started") : GG_OK;
}

static void stop_neighbour(neighbour *b)
{
  atomic_store(&b->over, true);
  pthread_join(b->thread, NULL);
#ifdef __linux__
  sched_setaffinity(0, sizeof b->before, &b->before);
#endif
}

gg_status gg_bench_throughput_compare(const gg_timed_scene *c, int n, double warmup, int repeats, double seconds,
                                      gg_timing *out, gg_error *err)
{
  timed r[GG_MOST_TIMED] = {0};
  neighbour beside = {0};
  if (n > GG_MOST_TIMED) return gg_base_fail(err, GG_FAILED, "%d scenes at once; at most %d", n, GG_MOST_TIMED);
  if (repeats > MOST_REPEATS) repeats = MOST_REPEATS;
  if (c[n - 1].neighbour) GG_TRY(start_neighbour(&beside, c[n - 1].threads, err));
  gg_status status = time_all(c, n, warmup, repeats, seconds, r, err);
  if (c[n - 1].neighbour) stop_neighbour(&beside);
  for (int k = 0; k < n; k++) {
    if (status == GG_OK) out[k] = compare(&r[k], &r[c[k].against], beside.busy, repeats);
    if (r[k].engine) r[k].engine->ops->destroy(r[k].engine);
  }
  return status;
}

gg_status gg_bench_throughput_measure(const gg_scene *scene, double warmup, int repeats, double seconds, gg_timing *out,
                                      gg_error *err)
{
  const gg_timed_scene only = {.scene = *scene, .against = 0};
  return gg_bench_throughput_compare(&only, 1, warmup, repeats, seconds, out, err);
}

gg_bench_value gg_bench_inverse(gg_bench_value v, double numerator)
{
  return (gg_bench_value){v.unit, numerator / v.value, numerator / v.highest, numerator / v.lowest, v.repeats, 1};
}

gg_bench_value gg_bench_rate(const gg_timing *r, const char *unit)
{
  gg_bench_value v = r->rate;
  v.unit = unit;
  return v;
}

gg_bench_value gg_bench_time(const gg_timing *r, const char *unit)
{
  return gg_bench_inverse(gg_bench_rate(r, unit), 1e9);
}
