/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The replicas of one scene. They go through warm-up and averaging in lockstep until the stopping criteria are met. The
 * result combines all of them. */
#ifndef GG_REPLICAS_H
#define GG_REPLICAS_H

#include "measure/slow_modes.h"
#include "run/progress_estimate.h"
#include "run/scheduler.h"
#include "statistics/stopping_rule.h"

/* A window of less than this many correlation times of the slowest quantity cannot be called steady. */
enum { GG_LEAST_CORRELATION_TIMES = 20 };
/* Nor can a window of less than this many decay times of a slow mode between walls. Short windows underestimate decay
 * times, by half at 20. Results depend on the square of an odd mode, whose decay time is half as long: fewer suffice,
 * and fewer still where that square makes a small part of the requested errors.
 */
enum { GG_LEAST_SLOW_TIMES = 50, GG_LEAST_ODD_TIMES = 10, GG_LEAST_UNFELT_TIMES = 3 };

typedef struct gg_convergence { /* of the present averaging window */
  double relative_error;        /* of the worst quantity with a requested error; scaled so that it equals
                                 * gg_stopping_criteria.relative_error when the request is just met; NaN: unknown */
  gg_quantity worst;
  bool trusted;     /* every headline error rests on long enough blocks */
  double untrusted; /* longest correlation time of those that are not trusted, in samples, over number of replicas */
  double sure_at;   /* from so many samples on all headline errors rest on GG_MAX_BLOCKS blocks, each long enough */
  double slowest;   /* longest correlation time of the monitored quantities, in samples */
  bool trending;    /* some quantity still changes ... */
  gg_quantity trending_quantity;
  double trend_z, trend_relative; /* ... by this many errors, and by this fraction of its mean */
  double trend_share;             /* fraction of the window, its beginning, that differs from the rest; at most 1/3 */
  int slow_mode;                  /* between walls: the mode that needs the longest window; -1: none */
  double slow_mode_time;          /* its decay time, in samples */
  int slow_mode_least;            /* decay times that a window needs */
} gg_convergence;

typedef struct gg_replicas {
  gg_scene scene;
  gg_model model;
  gg_stopping_criteria criteria;
  int n;
  gg_replica *replica; /* n of them */
  const gg_run_callbacks *callbacks;
  gg_run_callbacks task_callbacks;                /* those that tasks call */
  gg_run_tasks tasks;                             /* one a replica */
  gg_run_scheduler *own_scheduler;                /* NULL: the callbacks have one */
  pthread_mutex_t lock;                           /* one thread at a time calls a callback */
  gg_stop stop;                                   /* what the model's points to */
  _Atomic int stopped;                            /* GG_NOT_STOPPED ... */
  struct gg_replicas_state {                      /* plain data: saved as bytes */
    int64_t averaging;                            /* 0: warm-up */
    uint64_t due;                                 /* samples that every replica is to have taken */
    uint64_t window_at;                           /* samples when the window was opened */
    uint64_t goal;                                /* samples at which the window is tested next */
    uint64_t restarts;                            /* windows given up for a trend */
    int64_t exact;                                /* at the last test, errors were as small as requested */
    double wall;                                  /* seconds used before this process */
    uint64_t stretch_collisions, stretch_treated; /* of all replicas, where the present stretch began */
    double arrest_share; /* fraction of treated collisions if grains have come to rest; 0: they move */
    double runaway;      /* theta/T if it has grown beyond use; else 0 */
  } state;
  gg_convergence last;
  double started, last_checkpoint; /* clock readings */
  bool starting;                   /* replicas come to be */
  double start_reported;
  gg_progress_estimate progress;
  double estimated_at,
      next_estimate; /* samples in the window when errors were last estimated for it; not before this time */
} gg_replicas;

enum { GG_NOT_STOPPED, GG_OUT_OF_TIME, GG_STOP_REQUESTED }; /* why a run is stopped */

gg_stopping_criteria gg_run_criteria_of(const gg_scene *scene, const gg_model *model);
/* The relative error requested of a quantity; INFINITY: none. */
double gg_run_criteria_error_of(const gg_scene *scene, const gg_model *model, gg_quantity q);

/* create them, or restore them from `resume`, with the scheduler of the callbacks, or else one of
 * `threads`. They are the caller's to clear if this succeeds. */
gg_status gg_run_replicas_create(gg_replicas *all, const gg_scene *scene, const gg_archive *resume, int threads,
                                 const gg_run_callbacks *callbacks, gg_error *err);
/* True if a run may be repeated with a longer contact time after a collapse: this was automatic, may still grow, and no
 * frames are stored. */
bool gg_run_replicas_can_raise(const gg_replicas *all);
/* All of them anew with a tenfold one, of the same run: its clock continues. On failure they are cleared. */
gg_status gg_run_replicas_raise(gg_replicas *all, int threads, gg_error *err);
void gg_run_replicas_clear(gg_replicas *all);
/* Every replica takes samples until it has `due` of them; 0: it is created. `pauses` (may be NULL) is called while they
 * work: once it is true they stop, GG_OK before that, as for a checkpoint where several processes work. */
gg_status gg_run_replicas_advance(gg_replicas *all, uint64_t due, bool adapt, bool (*pauses)(gg_replicas *all),
                                  gg_error *err);

/* averaging.c: warm-up and averaging, until the stopping criteria are met or the time limit. */
gg_status gg_run_replicas_run(gg_replicas *all, gg_error *err);
/* A checkpoint to the caller's callback, if there is one. */
gg_status gg_run_replicas_store(gg_replicas *all, gg_error *err);
/* progress.c: report to the caller's callback, if there is one; `over`: the run is. */
void gg_run_replicas_report_progress(gg_replicas *all, bool over);
bool gg_run_replicas_checkpoint_is_due(const gg_replicas *all);
/* True if every replica has all->state.due samples; after a stop some may not. */
bool gg_run_replicas_are_level(const gg_replicas *all);
/* Samples that every replica has, of those that it is to have. */
uint64_t gg_run_replicas_least(const gg_replicas *all);
/* After the run: drop samples that not every replica has, so that the rest can be reported. */
void gg_run_replicas_level(gg_replicas *all);

/* convergence.c: how exact the means over the window are, and whether it is steady. */
gg_status gg_run_replicas_convergence(gg_replicas *all, gg_convergence *convergence, gg_error *err);
/* correlations.c: of the quantities in result->correlations, whose errors are known. */
gg_status gg_run_replicas_correlations(const gg_replicas *all, gg_result *result, gg_error *err);

/* series_means.c: what moves slowly across the gap between walls, over the window (measure/slow_modes.h). */
gg_status gg_run_replicas_slow_modes(const gg_replicas *all, gg_slow_modes *slow, gg_error *err);
gg_status gg_run_replicas_error_by_square(const gg_replicas *all, int mode, double decay, gg_quantity q, double *error,
                                          gg_error *err);

/* Everything needed to continue bit for bit. */
gg_status gg_run_replicas_save(const gg_replicas *all, gg_archive *archive, gg_error *err);

/* replicas_report.c: make a result of the present state of the replicas; it is whole if the status is GG_OK. */
gg_status gg_run_replicas_report(gg_replicas *all, gg_result *result, gg_error *err);
/* termination_status.c: GG_FAILED if the errors are larger than requested. */
gg_status gg_run_replicas_check_end(const gg_replicas *all, gg_error *err);
/* steady_state.c: is the mean over the window one of a steady state, and from what that is known. */
void gg_run_replicas_report_steadiness(const gg_replicas *all, const gg_convergence *convergence, gg_result *result);

#endif
