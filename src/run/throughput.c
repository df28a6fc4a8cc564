#include "run/throughput.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>

#include "run/clock.h"
#include "run/start.h"

enum { MOST_REPEATS = 32 };

static uint64_t collisions(const gg_engine *e)
{
  gg_engine_state s;
  e->ops->state(e, &s);
  return s.collisions;
}

/* Advance by about `count` collisions, however long that takes; returns how many there were. */
static gg_status advance_by(gg_engine *e, uint64_t count, uint64_t *done, gg_error *err)
{
  uint64_t before = collisions(e);
  double elapsed;
  do {
    uint64_t left = count - (collisions(e) - before);
    GG_TRY(e->ops->advance(e, 1e300, left, &elapsed, err));
  } while (collisions(e) - before < count);
  *done = collisions(e) - before;
  return GG_OK;
}

/* One timed stretch, grown until it is long enough to time. */
static gg_status time_stretch(gg_engine *e, double seconds, uint64_t *guess, double *rate, uint64_t *total,
                              gg_error *err)
{
  double start = gg_cpu_now(), gone;
  uint64_t sum = 0;
  do {
    uint64_t done;
    GG_TRY(advance_by(e, *guess, &done, err));
    sum += done;
    gone = gg_cpu_now() - start;
    if (gone < seconds / 4) *guess *= 2;
  } while (gone < seconds);
  *rate = (double)sum / gone;
  *total += sum;
  return GG_OK;
}

static gg_status time_engine(gg_engine *e, const gg_model *model, bool tap, double warmup, int repeats, double seconds,
                             gg_throughput *out, gg_error *err)
{
  uint64_t done, guess = (uint64_t)model->n / 4 + 1000;
  double rates[MOST_REPEATS];
  e->ops->tap(e, tap);
  GG_TRY(advance_by(e, (uint64_t)(warmup * (double)model->n / 2) + 1, &done, err));
  out->repeats = repeats < MOST_REPEATS ? repeats : MOST_REPEATS;
  for (int i = 0; i < out->repeats; i++) GG_TRY(time_stretch(e, seconds, &guess, &rates[i], &out->collisions, err));
  gsl_sort(rates, 1, (size_t)out->repeats);
  out->rate = gsl_stats_median_from_sorted_data(rates, 1, (size_t)out->repeats);
  out->slowest = rates[0];
  out->fastest = rates[out->repeats - 1];
  return GG_OK;
}

gg_status gg_measure_throughput(const gg_scene *scene, bool tap, double warmup, int repeats, double seconds,
                                gg_throughput *out, gg_error *err)
{
  gg_model model;
  gg_engine *engine;
  *out = (gg_throughput){0};
  GG_TRY(gg_model_make(scene, scene->engine, &model, err));
  const gg_engine_ops *ops = gg_engine_ops_of(scene->engine);
  GG_TRY(ops->accepts(&model, err));
  gg_start_near_steady(&model);
  GG_TRY(ops->create(&model, scene->run.seed, 0, &engine, err));
  gg_status status = time_engine(engine, &model, tap, warmup, repeats, seconds, out, err);
  ops->destroy(engine);
  return status;
}
