/* One state of uniform shear: all ways to simulate it, the truth, and how far from it each of them ends. */
#ifndef GG_BENCH_ERROR_STATE_H
#define GG_BENCH_ERROR_STATE_H

#include "bench/bench.h"
#include "bench/error_course.h"

typedef struct gg_way { /* to simulate it */
  gg_engine_kind engine;
  const char *name; /* as tables and pictures have it */
  int64_t n;
  double step; /* dsmc, mean free times; 0: its own */
  bool single;
  int replicas;
} gg_way;
enum { GG_WAYS = 12 };
extern const gg_way gg_bench_error_methods[GG_WAYS];

/* limit + per_grain/N over the ways of an engine whose step and precision are its own. */
typedef struct gg_by_size {
  double limit, limit_error, per_grain, per_grain_error;
} gg_by_size;

typedef struct gg_error_state {
  double phi, e;
  bool rough;
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
} gg_error_state;

/* `seconds` of each run, warm-up included. */
gg_status gg_bench_error_state_measure(const gg_bench *bench, gg_error_state *state, int seeds, double seconds,
                                       gg_error *err);
/* Relative error at a mark, the root of the mean square over runs; *error: how well that is known. */
double gg_bench_error_at(const gg_error_state *state, int way, int quantity, int mark, double *error);
/* Seconds until the error is this small; INFINITY: never, the floor is surely above; NaN: not told, the floor is not
 * known well enough. */
double gg_bench_seconds_to(const gg_error_state *state, int way, int quantity, double error);

#endif
