/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replicas of runs distributed over several processes, as rank 0 sees them. Each replica belongs to one rank, rank 0
 * included, for as long as that lives. A task that is done elsewhere comes back with the replica's whole state, an
 * archive, so that any rank can do the next one, or the same one again. */
#ifndef GG_RUN_WORKERS_H
#define GG_RUN_WORKERS_H

#include "run/scheduler.h"

/* The scheduler of rank 0's own threads, for runs with these workers. */
gg_run_scheduler *gg_run_workers_scheduler(gg_workers *workers);

/* From now on the tasks of this run go to all ranks. */
gg_status gg_run_distribution_open(gg_workers *workers, gg_run_tasks *tasks, gg_error *err);
/* Does nothing for a run that was not distributed. */
void gg_run_distribution_close(gg_run_tasks *tasks);
/* The replicas here were changed since they came back: other ranks need them again. */
void gg_run_distribution_changed(gg_run_tasks *tasks);

#endif
