#include "bench/error_course.h"

#include <math.h>

#include "run/replicas.h"

const gg_quantity gg_bench_error_course_quantity[GG_COURSE_QUANTITIES] = {GG_Q_TEMPERATURE, GG_Q_P_XY, GG_Q_N1,
                                                                          GG_Q_KURTOSIS_CX, GG_Q_TEMPERATURE_RATIO};

static double seconds_of(const gg_replicas *all)
{
  double sum = 0;
  for (int i = 0; i < all->n; i++) sum += all->replica[i].clock.cpu;
  return sum;
}

static gg_status advance_to(gg_replicas *all, uint64_t due, bool adapt, gg_error *err)
{
  all->state.due = due;
  return gg_run_replicas_advance(all, due, adapt, err);
}

static gg_status warm_up(gg_replicas *all, gg_error *err)
{
  GG_TRY(advance_to(all, all->criteria.warmup, true, err));
  for (int i = 0; i < all->n; i++) GG_TRY(gg_run_replica_open_window(&all->replica[i], err));
  all->state.averaging = 1;
  all->state.window_at = all->state.due;
  return GG_OK;
}

static gg_status note(const gg_replicas *all, gg_course *c, int mark, int seed, gg_error *err)
{
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    gg_mean m;
    GG_TRY(gg_run_replicas_mean(all, gg_bench_error_course_quantity[q], &m, err));
    c->mean[q][mark][seed] = m.mean;
    if (seed == 0) c->error[q] = m.error;
  }
  c->seconds[mark] += seconds_of(all) / c->seeds;
  return GG_OK;
}

/* The first run, by its time, sets how many marks there are; the others go as far. */
static gg_status follow(gg_replicas *all, gg_course *c, int seed, double seconds, gg_error *err)
{
  uint64_t window = 8;
  GG_TRY(warm_up(all, err));
  c->warmup += seconds_of(all) / c->seeds;
  for (int k = 0; k < (seed ? c->marks : GG_COURSE_MARKS); k++, window += window / 2) {
    GG_TRY(advance_to(all, all->state.window_at + window, false, err));
    GG_TRY(note(all, c, k, seed, err));
    if (!seed) c->marks = k + 1;
    if (!seed && seconds_of(all) >= seconds / 1.2) break;
  }
  return GG_OK;
}

gg_status gg_bench_error_course_measure(const gg_scene *scene, int seeds, double seconds, gg_course *c, gg_error *err)
{
  *c = (gg_course){.seeds = seeds < GG_COURSE_SEEDS ? seeds : GG_COURSE_SEEDS};
  gg_scene s = *scene;
  for (int seed = 0; seed < c->seeds; seed++, s.run.seed++) {
    gg_replicas all;
    GG_TRY(gg_run_replicas_create(&all, &s, NULL, 1, NULL, err));
    gg_status status = follow(&all, c, seed, seconds, err);
    gg_run_replicas_clear(&all);
    GG_TRY(status);
  }
  return GG_OK;
}

static void moments(const gg_course *c, int q, int mark, double *mean, double *variance)
{
  *mean = *variance = 0;
  for (int i = 0; i < c->seeds; i++) *mean += c->mean[q][mark][i] / c->seeds;
  for (int i = 0; i < c->seeds; i++) *variance += pow(c->mean[q][mark][i] - *mean, 2) / (c->seeds - 1);
}

gg_course_end gg_bench_error_course_last(const gg_course *c, int q)
{
  double mean, variance;
  moments(c, q, c->marks - 1, &mean, &variance);
  /* A handful of runs scatters by chance less than they should: what blocks say has a part in it. */
  double scatter = c->seeds < 2 ? c->error[q] : fmax(sqrt(variance), c->error[q] > 0 ? c->error[q] : 0);
  return (gg_course_end){mean, scatter / sqrt(c->seeds), scatter};
}

double gg_bench_error_course_noise(const gg_course *c, int q)
{
  double sum = 0;
  int n = 0;
  for (int k = c->marks / 2; k < c->marks; k++, n++) {
    double mean, variance;
    moments(c, q, k, &mean, &variance);
    sum += variance * (c->seconds[k] - c->warmup);
  }
  return sqrt(sum / n);
}
