/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One state of uniform shear: all ways to simulate it, the truth, and how far from it each of them ends. */
#ifndef GG_BENCH_ERROR_STATE_H
#define GG_BENCH_ERROR_STATE_H

#include "bench/bench.h"
#include "common/engine.h"
#include "common/quantity.h"

/* Means of one scene after so much processor time, warm-up included: of runs that differ in their seed. */
enum { GG_COURSE_QUANTITIES = 5, GG_COURSE_MARKS = 32, GG_COURSE_SEEDS = 8 };
/* Of shear T, P_xy, N1, kurtosis of C_x (the fourth moment; shear has no a2), theta/T; of free cooling the reduced
 * cooling rate, a2, kurtoses of C_x and of the spin, theta/T. */
const gg_quantity *gg_bench_error_quantities(gg_flow flow);

typedef struct gg_course {
  int seeds, marks;
  double warmup;                                                       /* seconds, mean over seeds */
  double seconds[GG_COURSE_MARKS];                                     /* since the start, mean over seeds */
  double mean[GG_COURSE_QUANTITIES][GG_COURSE_MARKS][GG_COURSE_SEEDS]; /* over the window until then; NaN: none */
  double error[GG_COURSE_QUANTITIES]; /* that the first run claims of itself at its end */
} gg_course;

/* Each run warms up as one of the command does, and averages until it has taken so much time. Marks are at the same
 * numbers of samples in all of them, each half as many again as the last. */
gg_status gg_bench_error_course_measure(const gg_scene *scene, int seeds, double seconds, gg_course *course,
                                        gg_error *err);

/* At the last mark: mean over the runs, its standard error, and the scatter of one run: that over seeds, or what the
 * first claims of itself, whichever is larger. */
typedef struct gg_course_end {
  double mean, error, scatter;
} gg_course_end;
gg_course_end gg_bench_error_course_last(const gg_course *course, int quantity);
/* Error of a mean over one second, the warm-up apart, whose only error is noise: scatter times the root of the time
 * averaged over, of the later half of the marks. */
double gg_bench_error_course_noise(const gg_course *course, int quantity);

typedef struct gg_way { /* to simulate it */
  gg_engine_kind engine;
  const char *name; /* as tables and pictures have it */
  int64_t n;
  double step; /* dsmc, mean free times; 0: its own */
  bool single;
  int replicas;
} gg_way;
enum { GG_WAYS = 12, GG_ERROR_THEORIES = 16 };
extern const gg_way gg_bench_error_methods[GG_WAYS];

/* limit + per_grain/N over the ways of an engine whose step and precision are its own. */
typedef struct gg_by_size {
  double limit, limit_error, per_grain, per_grain_error;
} gg_by_size;

typedef struct gg_error_state {
  double phi, e;
  bool rough;
  gg_flow flow;
  bool done[GG_WAYS];
  gg_course course[GG_WAYS];
  double noise[GG_WAYS][GG_COURSE_QUANTITIES]; /* relative, of a second without warm-up */
  /* Relative: what no time brings down, with its standard error; and as far as it can be told from 0. */
  double shift[GG_WAYS][GG_COURSE_QUANTITIES], shift_error[GG_WAYS][GG_COURSE_QUANTITIES];
  double floor[GG_WAYS][GG_COURSE_QUANTITIES];
  double unit[GG_COURSE_QUANTITIES]; /* errors are relative to this: the truth's size */
  /* Of each engine: what it would have in the limit, by the solution without random numbers, a long run or its own
   * larger systems; and by how much the number of grains shifts it. */
  double truth[2][GG_COURSE_QUANTITIES], truth_error[2][GG_COURSE_QUANTITIES];
  const char *source[2][GG_COURSE_QUANTITIES];
  gg_by_size size[2][GG_COURSE_QUANTITIES];
  double step_coefficient[GG_COURSE_QUANTITIES], step_coefficient_error[GG_COURSE_QUANTITIES]; /* relative, times h^2 */
  double step_order[GG_COURSE_QUANTITIES];
  int n_theories;
  struct {
    const char *name;
    double error[GG_COURSE_QUANTITIES]; /* relative to the truth, at least what it says of itself; NaN: no answer */
  } theory[GG_ERROR_THEORIES];
} gg_error_state;

/* "phi 0.3, e 0.9, rough, shear" */
void gg_bench_error_state_name(const gg_error_state *state, char *text, size_t size);

/* `seconds` of each run, warm-up included. */
gg_status gg_bench_error_state_measure(const gg_bench *bench, gg_error_state *state, int seeds, double seconds,
                                       gg_error *err);
/* Relative error at a mark, the root of the mean square over runs; *error: how well that is known. */
double gg_bench_error_at(const gg_error_state *state, int way, int quantity, int mark, double *error);
/* Seconds until the error is this small; INFINITY: never, the floor is surely above; NaN: unknown, the floor is not
 * known well enough. */
double gg_bench_seconds_to(const gg_error_state *state, int way, int quantity, double error);

#endif
