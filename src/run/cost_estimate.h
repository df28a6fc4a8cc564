/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cost estimate of a run, before it begins: memory, processor time, and the shares of its observables. Times are
 * those of one processor of 2020 or so, right within a factor of two (three where an error is requested); memory within
 * a fifth. */
#ifndef GG_COST_ESTIMATE_H
#define GG_COST_ESTIMATE_H

#include "common/engine.h"
#include "common/observables.h"
#include "scene/scene.h"

typedef struct gg_cost_estimate {
  double engine, observables, series; /* bytes of one replica */
  double writing;                     /* bytes for the grains at the end, and the file made of them */
  double bytes;                       /* at most at a time, all replicas and the program included */
  double frames, file;                /* how many are stored, and bytes of the result file with them */
  double collisions;                  /* a grain, warm-up included */
  double ns;                          /* of processor time a collision, observables apart */
  double seconds;                     /* of processor time in all */
  double limit;                       /* run.time_limit, seconds; 0: none */
  bool to_an_error;                   /* it ends at a requested error */
  int n_costs;
  struct {
    const char *name;
    double percent; /* of the run without it */
  } cost[GG_N_OBSERVABLES];
} gg_cost_estimate;

gg_cost_estimate gg_run_cost_estimate(const gg_scene *scene, const gg_model *model, gg_engine_kind engine);

/* Time of a collision in md over that in Monte Carlo, for scenes so dilute that Monte Carlo is exact, and of which it
 * measures every requested observable; else 0. */
double gg_run_cost_dilute(const gg_scene *scene, const gg_model *md);

/* GG_FAILED, with what is needed and what is there, if this machine has not the memory. */
gg_status gg_run_cost_check_memory(const gg_cost_estimate *cost, const char *engine, int64_t replicas, gg_error *err);

/* In words, a line a call. */
void gg_run_cost_report(const gg_cost_estimate *cost, int64_t replicas, void (*line)(void *context, const char *text),
                        void *context);

#endif
