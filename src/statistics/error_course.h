/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the error of means falls with processor time: means of several seeds up to marks in time. */
#ifndef GG_ERROR_COURSE_H
#define GG_ERROR_COURSE_H

/* Means of one scene against processor time (warm-up included), for several seeds. */
enum { GG_COURSE_QUANTITIES = 5, GG_COURSE_MARKS = 32, GG_COURSE_SEEDS = 8 };
typedef struct gg_course {
  int seeds, marks;
  double warmup;                                                       /* seconds, mean over seeds */
  double seconds[GG_COURSE_MARKS];                                     /* since the start, mean over seeds */
  double mean[GG_COURSE_QUANTITIES][GG_COURSE_MARKS][GG_COURSE_SEEDS]; /* over the window up to the mark; NaN: none */
  double error[GG_COURSE_QUANTITIES]; /* standard error that the first run estimates at its end */
} gg_course;

/* At the last mark: mean over the runs, its standard error, and the scatter of one run (over seeds, or as estimated by
 * the first run, whichever is larger). */
typedef struct gg_course_end {
  double mean, error, scatter;
} gg_course_end;
gg_course_end gg_statistics_course_last(const gg_course *course, int quantity);
/* Statistical error of a mean over one second of averaging: scatter times the root of the averaging time, from the
 * later half of the marks. */
double gg_statistics_course_noise(const gg_course *course, int quantity);
/* Root of the mean square over runs of the distance from a value at a mark; *error: its standard error. */
double gg_statistics_course_distance(const gg_course *course, int quantity, int mark, double value, double *error);

#endif
