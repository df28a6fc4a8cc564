/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One state of uniform shear or free cooling: all methods of simulation, reference values, and errors. */
#ifndef GG_BENCH_ERROR_STATE_H
#define GG_BENCH_ERROR_STATE_H

#include "bench/bench.h"
#include "common/engine.h"
#include "common/quantity.h"
#include "statistics/error_course.h"

/* Quantities. Shear: T, P_xy, N1, kurtosis of C_x (the fourth moment; shear has no a2), theta/T. Free cooling: reduced
 * cooling rate, a2, kurtoses of C_x and of the spin, theta/T. */
const gg_quantity *gg_bench_error_quantities(gg_flow flow);

typedef struct gg_error_method { /* a method of simulation */
  gg_engine_kind engine;
  const char *name; /* in tables and pictures */
  int64_t n;
  double step; /* dsmc, mean free times; 0: default */
  bool single;
  int replicas;
} gg_error_method;
enum { GG_ERROR_METHODS = 12, GG_ERROR_THEORIES = 16 };
extern const gg_error_method gg_bench_error_methods[GG_ERROR_METHODS];

/* Fit limit + per_grain/N over the methods of an engine with default step and precision. */
typedef struct gg_by_size {
  double limit, limit_error, per_grain, per_grain_error;
} gg_by_size;

typedef struct gg_error_state {
  double phi, e;
  bool rough;
  gg_flow flow;
  bool done[GG_ERROR_METHODS];
  gg_course course[GG_ERROR_METHODS];
  double noise[GG_ERROR_METHODS][GG_COURSE_QUANTITIES]; /* relative error of one second of averaging */
  /* Relative systematic error (finite N, step), which no time reduces, with its standard error; `floor`: its part that
   * differs significantly from 0. */
  double shift[GG_ERROR_METHODS][GG_COURSE_QUANTITIES], shift_error[GG_ERROR_METHODS][GG_COURSE_QUANTITIES];
  double floor[GG_ERROR_METHODS][GG_COURSE_QUANTITIES];
  double unit[GG_COURSE_QUANTITIES]; /* errors are relative to this absolute value of the reference */
  /* For each engine: reference value (from the noise-free solution, a long run, or extrapolation in 1/N), its error and
   * source; fit of the finite-size shift. */
  double truth[2][GG_COURSE_QUANTITIES], truth_error[2][GG_COURSE_QUANTITIES];
  const char *source[2][GG_COURSE_QUANTITIES];
  gg_by_size size[2][GG_COURSE_QUANTITIES];
  double step_coefficient[GG_COURSE_QUANTITIES], step_coefficient_error[GG_COURSE_QUANTITIES]; /* relative, times h^2 */
  double step_order[GG_COURSE_QUANTITIES];
  int n_theories;
  struct {
    const char *name;
    double error[GG_COURSE_QUANTITIES]; /* relative to the reference, at least the theory's numerical error; NaN: no
                                           value */
  } theory[GG_ERROR_THEORIES];
} gg_error_state;

/* Name of the state: "phi 0.3, e 0.9, rough, shear". */
void gg_bench_error_state_name(const gg_error_state *state, char *text, size_t size);

/* Measure all methods; `seconds` per run, warm-up included. */
gg_status gg_bench_error_state_measure(const gg_bench *bench, gg_error_state *state, int seeds, double seconds,
                                       gg_error *err);
/* Relative error at a mark, the root of the mean square over runs; *error: its standard error. */
double gg_bench_error_at(const gg_error_state *state, int way, int quantity, int mark, double *error);
/* Seconds until the error is this small; INFINITY: never, the floor is certainly above; NaN: the floor is not known
 * well enough. */
double gg_bench_seconds_to(const gg_error_state *state, int way, int quantity, double error);

#endif
