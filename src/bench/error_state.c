/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/error_state.h"

#include <math.h>

#include "run/replicas.h"
#include "run/series_means.h"
#include "scene/model_of_scene.h"
#include "theory/theory_list.h"

const gg_quantity *gg_bench_error_quantities(gg_flow flow)
{
  static const gg_quantity sheared[GG_COURSE_QUANTITIES] = {GG_Q_TEMPERATURE, GG_Q_P_XY, GG_Q_N1, GG_Q_KURTOSIS_CX,
                                                            GG_Q_TEMPERATURE_RATIO},
                           cooling[GG_COURSE_QUANTITIES] = {GG_Q_COOLING_RATE, GG_Q_A2, GG_Q_KURTOSIS_CX,
                                                            GG_Q_KURTOSIS_WX, GG_Q_TEMPERATURE_RATIO};
  return flow == GG_HCS ? cooling : sheared;
}

void gg_bench_error_state_name(const gg_error_state *s, char *text, size_t size)
{
  snprintf(text, size, "phi %g, e %g, %s, %s", s->phi, s->e, s->rough ? "rough" : "smooth",
           s->flow == GG_HCS ? "cooling" : "shear");
}

static double seconds_of(const gg_replicas *all)
{
  double sum = 0;
  for (int i = 0; i < all->n; i++) sum += all->replica[i].clock.cpu;
  return sum;
}

static gg_status advance_to(gg_replicas *all, uint64_t due, bool adapt, gg_error *err)
{
  all->state.due = due;
  return gg_run_replicas_advance(all, due, adapt, NULL, err);
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
  gg_slow_modes slow;
  GG_TRY(gg_run_replicas_slow_modes(all, &slow, err));
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    gg_mean m;
    GG_TRY(gg_run_replicas_mean(all, gg_bench_error_quantities(all->scene.flow)[q], slow.time, &m, err));
    c->mean[q][mark][seed] = m.mean;
    if (seed == 0) c->error[q] = m.error;
  }
  c->seconds[mark] += seconds_of(all) / c->seeds;
  return GG_OK;
}

/* Follow one run. The time of the first run sets the number of marks; further runs have as many. */
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

/* Each run warms up as usual and averages until it has used `seconds`. Marks are at the same numbers of samples in all
 * runs; each window is half as long again as the last. */
static gg_status measure(const gg_scene *scene, int seeds, double seconds, gg_course *c, gg_error *err)
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

const gg_error_method gg_bench_error_methods[GG_ERROR_METHODS] = {
    {GG_MD, "md N 250", 250, 0, false, 1},
    {GG_MD, "md N 1000", 1000, 0, false, 1},
    {GG_MD, "md N 4000", 4000, 0, false, 1},
    {GG_DSMC, "dsmc N 100", 100, 0, false, 1},
    {GG_DSMC, "dsmc N 500", 500, 0, false, 1},
    {GG_DSMC, "dsmc N 2000", 2000, 0, false, 1},
    {GG_DSMC, "dsmc N 10000", 10000, 0, false, 1},
    {GG_DSMC, "dsmc N 80000", 80000, 0, false, 1},
    {GG_DSMC, "dsmc N 10000, single", 10000, 0, true, 1},
    {GG_DSMC, "dsmc N 10000, step 1", 10000, 1, false, 1},
    {GG_DSMC, "dsmc N 10000, step 0.5", 10000, 0.5, false, 1},
    {GG_DSMC, "dsmc N 2000, 5 replicas", 2000, 0, false, 5},
};
enum { STEP_1 = 9, STEP_HALF = 10 };
/* The long run: reference if there is no better one; LONGER times the time of the others. */
enum { LONGER = 100, TRUTH_N = 80000 };

static gg_scene scene_of(const gg_bench *b, const gg_error_state *s, const gg_error_method *w)
{
  gg_scene scene = gg_bench_scene(b, w->engine, s->phi, w->n);
  scene.flow = s->flow;
  scene.collision.e[0] = s->e;
  scene.collision.beta[0] = s->rough ? 0 : -1;
  scene.run.replicas = w->replicas;
  if (w->step > 0) scene.dsmc.time_step = w->step;
  if (w->single) scene.dsmc.precision = GG_SINGLE;
  return scene;
}

/* Weighted straight line in 1/N; if error > 0, `at_limit` is a point at 1/N = 0. */
static gg_by_size fit_size(const gg_error_state *s, gg_engine_kind engine, int q, double at_limit, double error)
{
  double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
  if (error > 0) w = 1 / (error * error), wy = w * at_limit;
  for (int i = 0; i < GG_ERROR_METHODS; i++) {
    const gg_error_method *way = &gg_bench_error_methods[i];
    if (!s->done[i] || way->engine != engine || way->step != 0 || way->single) continue; /* not engines by themselves */
    const gg_course_end end = gg_statistics_course_last(&s->course[i], q);
    const double x = 1 / (double)gg_bench_error_methods[i].n, g = 1 / (end.error * end.error);
    if (!(end.error > 0)) continue;
    w += g, wx += g * x, wxx += g * x * x, wy += g * end.mean, wxy += g * x * end.mean;
  }
  const double det = w * wxx - wx * wx;
  return (gg_by_size){(wxx * wy - wx * wxy) / det, sqrt(wxx / det), (w * wxy - wx * wy) / det, sqrt(w / det)};
}

static void set_reference(gg_error_state *s, gg_engine_kind engine, int q, double value, double error,
                          const char *source)
{
  if (!isfinite(value) || !isfinite(error) || (s->source[engine][q] && error >= s->truth_error[engine][q])) return;
  s->truth[engine][q] = value, s->truth_error[engine][q] = error, s->source[engine][q] = source;
}

static void use_solution(gg_error_state *s, const gg_model *m)
{
  gg_theory_answer a;
  if (gg_theory_evaluate(&gg_theory_enskog_hermite, m, &a, NULL) != GG_OK) return;
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    const gg_quantity name = gg_bench_error_quantities(s->flow)[q];
    set_reference(s, GG_DSMC, q, a.value[name], a.error[name], "solved without noise");
  }
}

static void find_theories(gg_error_state *s, const gg_model *m)
{
  const gg_theory *theory;
  gg_theory_answer a;
  for (int i = 0; (theory = gg_theory_of(m, i)) && s->n_theories < GG_ERROR_THEORIES; i++) {
    bool any = false;
    if (gg_theory_evaluate(theory, m, &a, NULL) != GG_OK) continue;
    double *error = s->theory[s->n_theories].error;
    for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
      const gg_quantity name = gg_bench_error_quantities(s->flow)[q];
      error[q] = fmax(fabs(a.value[name] - s->truth[GG_DSMC][q]), a.error[name]) / s->unit[q];
      if (!isfinite(a.value[name])) error[q] = NAN;
      any |= isfinite(error[q]);
    }
    if (any) s->theory[s->n_theories++].name = theory->name;
  }
}

/* Whether a long run is needed: some reference error is above a tenth of the error of a run of this length. */
static bool wants_long_run(const gg_error_state *s, double seconds)
{
  bool wants = false;
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    const gg_quantity name = gg_bench_error_quantities(s->flow)[q];
    if (!s->rough && (name == GG_Q_TEMPERATURE_RATIO || name == GG_Q_KURTOSIS_WX)) continue; /* they need spins */
    double best = INFINITY;
    for (int i = 0; i < GG_ERROR_METHODS; i++) {
      const gg_course *c = &s->course[i];
      if (s->done[i] && gg_bench_error_methods[i].engine == GG_DSMC && seconds > c->warmup)
        best = fmin(best, gg_statistics_course_noise(c, q) / sqrt(seconds - c->warmup));
    }
    wants |= !s->source[GG_DSMC][q] || s->truth_error[GG_DSMC][q] > best / 10;
  }
  return wants;
}

static gg_status find_truth(const gg_bench *b, gg_error_state *s, double seconds, gg_error *err)
{
  const gg_error_method long_one = {GG_DSMC, "long run", TRUTH_N, 0, false, 1};
  const gg_scene scene = scene_of(b, s, &long_one);
  gg_model m;
  GG_TRY(gg_scene_model_make(&scene, GG_DSMC, &m, err));
  use_solution(s, &m);
  if (wants_long_run(s, seconds)) {
    gg_bench_report(b, "phi %g, e %g: a run of %.0f s for the truth", s->phi, s->e, LONGER * seconds);
    gg_course c;
    GG_TRY(measure(&scene, 1, LONGER * seconds, &c, err));
    for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
      const gg_course_end end = gg_statistics_course_last(&c, q);
      set_reference(s, GG_DSMC, q, end.mean, end.error, "long run");
    }
  }
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    const gg_by_size md = fit_size(s, GG_MD, q, 0, 0);
    set_reference(s, GG_MD, q, md.limit, md.limit_error, "1/N to 0");
    s->size[GG_MD][q] = md;
    s->size[GG_DSMC][q] = fit_size(s, GG_DSMC, q, s->truth[GG_DSMC][q], s->truth_error[GG_DSMC][q]);
    s->unit[q] = fabs(s->truth[GG_DSMC][q]);
  }
  find_theories(s, &m);
  return GG_OK;
}

/* Fit the error of split steps, shift = coefficient h^2, to the methods with steps 1 and 0.5. */
static void fit_step(gg_error_state *s, int q)
{
  double shift[2], error[2];
  const int way[2] = {STEP_1, STEP_HALF};
  for (int i = 0; i < 2; i++) {
    const gg_course_end end = gg_statistics_course_last(&s->course[way[i]], q);
    const double size = s->size[GG_DSMC][q].per_grain / (double)gg_bench_error_methods[way[i]].n;
    shift[i] = (end.mean - s->truth[GG_DSMC][q] - size) / s->unit[q];
    error[i] = hypot(end.error, s->truth_error[GG_DSMC][q]) / s->unit[q];
  }
  const double w1 = 1 / (error[0] * error[0]), w2 = 1 / (error[1] * error[1]);
  s->step_coefficient[q] = (w1 * shift[0] + w2 * shift[1] / 4) / (w1 + w2 / 16);
  s->step_coefficient_error[q] = 1 / sqrt(w1 + w2 / 16);
  s->step_order[q] = shift[0] / shift[1] > 0 && fabs(shift[1]) > 2 * error[1] ? log2(shift[0] / shift[1]) : NAN;
}

static void find_errors(gg_error_state *s)
{
  for (int q = 0; q < GG_COURSE_QUANTITIES; q++) {
    fit_step(s, q);
    for (int i = 0; i < GG_ERROR_METHODS; i++) {
      if (!s->done[i]) continue;
      const gg_error_method *w = &gg_bench_error_methods[i];
      const gg_by_size *size = &s->size[w->engine][q];
      const double each = (double)w->n * s->unit[q], square = w->step * w->step;
      const double floor = size->per_grain / each + s->step_coefficient[q] * square;
      const double error = hypot(size->per_grain_error / each, s->step_coefficient_error[q] * square);
      s->noise[i][q] = gg_statistics_course_noise(&s->course[i], q) / s->unit[q];
      s->shift[i][q] = fabs(floor);
      s->shift_error[i][q] = error;
      s->floor[i][q] = sqrt(fmax(floor * floor - error * error, 0));
    }
  }
}

gg_status gg_bench_error_state_measure(const gg_bench *b, gg_error_state *s, int seeds, double seconds, gg_error *err)
{
  char name[GG_BENCH_CELL];
  gg_bench_error_state_name(s, name, sizeof name);
  for (int i = 0; i < GG_ERROR_METHODS; i++) {
    if (s->phi == 0 && gg_bench_error_methods[i].engine == GG_MD) continue;
    gg_bench_report(b, "%s: %s (%d of %d)", name, gg_bench_error_methods[i].name, i + 1, GG_ERROR_METHODS);
    const gg_scene scene = scene_of(b, s, &gg_bench_error_methods[i]);
    GG_TRY(measure(&scene, seeds, seconds, &s->course[i], err));
    s->done[i] = true;
  }
  GG_TRY(find_truth(b, s, seconds, err));
  find_errors(s);
  return GG_OK;
}

double gg_bench_error_at(const gg_error_state *s, int way, int q, int mark, double *error)
{
  const double truth = s->truth[gg_bench_error_methods[way].engine][q], unit = s->unit[q];
  const double rms = gg_statistics_course_distance(&s->course[way], q, mark, truth, error);
  return *error /= unit, rms / unit;
}

double gg_bench_seconds_to(const gg_error_state *s, int way, int q, double error)
{
  const double left = error * error - s->floor[way][q] * s->floor[way][q], unsure = s->shift_error[way][q];
  if (s->shift[way][q] - 2 * unsure > error) return INFINITY;
  if (!(left > 0) || unsure > error) return NAN;
  const gg_course *c = &s->course[way];
  return fmax(c->warmup + s->noise[way][q] * s->noise[way][q] / left, c->seconds[0]);
}
