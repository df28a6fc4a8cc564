/* Means of one scene after so much processor time, warm-up included: of runs that differ in their seed. */
#ifndef GG_BENCH_ERROR_COURSE_H
#define GG_BENCH_ERROR_COURSE_H

#include "common/engine.h"
#include "common/quantity.h"

enum { GG_COURSE_QUANTITIES = 5, GG_COURSE_MARKS = 32, GG_COURSE_SEEDS = 8 };
/* T, P_xy, N1, kurtosis of C_x (the fourth moment; shear has no a2), theta/T. */
extern const gg_quantity gg_bench_error_course_quantity[GG_COURSE_QUANTITIES];

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

#endif
