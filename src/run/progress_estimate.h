/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress and time left of a run. The run does not depend on them. The forecast says at which sample the run ends; the
 * time of recent samples predicts when. */
#ifndef GG_PROGRESS_ESTIMATE_H
#define GG_PROGRESS_ESTIMATE_H

#include "statistics/averaging_forecast.h"

struct gg_convergence;

enum { GG_PROGRESS_MARKS = 64 };

typedef struct gg_progress_estimate {
  gg_averaging_forecast forecast;
  int n_marks; /* of the present phase */
  struct {
    double wall, due; /* a clock reading, and how many samples every replica had taken */
  } marks[GG_PROGRESS_MARKS];
  double fraction; /* the largest reported */
} gg_progress_estimate;

/* Averaging begins: another pace. */
void gg_run_progress_new_phase(gg_progress_estimate *o);
/* The window has this many samples, and this is known of its means. */
void gg_run_progress_record_errors(gg_progress_estimate *o, double window, const struct gg_convergence *c);
void gg_run_progress_record_time(gg_progress_estimate *o, double wall, double due);
/* Seconds a sample, lately; NaN where that is not known yet. */
double gg_run_progress_pace(const gg_progress_estimate *o);

#endif
