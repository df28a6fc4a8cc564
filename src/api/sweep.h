/* How a point of a sweep is done: by the public run, comparison or theories, into a file with the point's name. */
#ifndef GG_API_SWEEP_H
#define GG_API_SWEEP_H

#include "run/scheduler.h"
#include "sweep/sweep.h"

/* What a point needs to know of the sweep's call. The callbacks come from the thread that does the point. */
typedef struct gg_point_task {
  const gg_sweep *sweep;
  const char *folder;
  size_t i;
  gg_run_scheduler *scheduler; /* which the caller has entered; NULL: one of its own, or the workers' */
  gg_run_options options;      /* threads, command, input, and the callbacks progress, stop, warn with their context */
} gg_point_task;

/* Do point i, whose place the caller has claimed, from its checkpoint if there is one. GG_OK and GG_FAILED with
 * *fell_short: its file is in place; *err has why it fell short or failed. */
gg_status gg_api_point_run(const gg_point_task *task, bool *fell_short, gg_error *err);

#endif
