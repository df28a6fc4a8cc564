/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress and time left of a run. The run does not depend on them. A run ends at a test of its averaging window
 * (averaging.c). The errors so far predict which test, assuming that they fall as 1/sqrt(window); the time of recent
 * samples predicts when. */
#ifndef GG_PROGRESS_ESTIMATE_H
#define GG_PROGRESS_ESTIMATE_H

#include <stdbool.h>
#include <stdint.h>

struct gg_stopping_criteria;
struct gg_convergence;
struct gg_replicas_state;

enum { GG_PROGRESS_ERRORS = 32, GG_PROGRESS_MARKS = 64 };

typedef struct gg_progress_estimate {
  int n_errors; /* of the present window; the latest of them */
  struct {
    double window, log_scale; /* samples; ln(error sqrt(window)) */
  } errors[GG_PROGRESS_ERRORS];
  bool trending;     /* when last looked: the window would be given up */
  double trusted_at; /* samples that the window needs before its error can be trusted */
  double sure_at;    /* and before it is sure */
  int n_marks;       /* of the present phase */
  struct {
    double wall, due; /* a clock reading, and how many samples every replica had taken */
  } marks[GG_PROGRESS_MARKS];
  double fraction; /* the largest reported */
} gg_progress_estimate;

/* Averaging starts or restarts. */
void gg_run_progress_open_window(gg_progress_estimate *o);
/* Averaging begins: another pace. */
void gg_run_progress_new_phase(gg_progress_estimate *o);
/* The window has this many samples, and this is known of its means. */
void gg_run_progress_record_errors(gg_progress_estimate *o, double window, const struct gg_convergence *c);
void gg_run_progress_record_time(gg_progress_estimate *o, double wall, double due);

/* When the run ends, in samples of each replica; a rough guess, or NaN, where that is not known yet: errors are not, or
 * the window may be given up for a trend. */
typedef struct gg_expected_end {
  double at;
  bool known;
} gg_expected_end;
gg_expected_end gg_run_progress_end(const gg_progress_estimate *o, const struct gg_stopping_criteria *criteria,
                                    const struct gg_replicas_state *state);
/* Seconds a sample, lately; NaN where that is not known yet. */
double gg_run_progress_pace(const gg_progress_estimate *o);

#endif
