/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one scheduler of runs. A task lets one replica of a run take samples until it has as many as are due. Tasks wait
 * in one queue, largest priority first. Threads of this process serve it; with several processes (run/workers) a task
 * goes to the rank that has its replica, and waits in the queue of that rank's scheduler. A run's controller is the
 * thread that decides what is next: it submits the tasks of its run, waits for them, and may stop them. Results do not
 * depend on who does a task, nor on when. */
#ifndef GG_RUN_SCHEDULER_H
#define GG_RUN_SCHEDULER_H

#include <pthread.h>
#include <stdatomic.h>

#include "run/replica.h"

typedef struct gg_run_tasks gg_run_tasks;

typedef struct gg_run_task_status { /* how far a replica is */
  uint64_t samples;
  double collisions_per_grain, cpu;
} gg_run_task_status;

typedef struct gg_run_task {
  gg_run_tasks *run;
  gg_replica *replica; /* created by the task if it has no engine */
  int index;           /* of the replica */
  int threads;         /* of its own, for its engine; 0: the engine keeps those that it has */
  uint64_t due;        /* samples */
  bool adapt;
  double priority; /* the relative error of its run; INFINITY: not known yet */
  atomic_bool over;
  gg_status status; /* once it is over, with the reason */
  gg_error err;
  _Atomic uint64_t samples; /* its status, readable by any thread at any time */
  _Atomic double collisions_per_grain, cpu;
  struct gg_run_task *next; /* in the queue */
} gg_run_task;

/* How tasks reach other processes; see run/workers/workers.h. */
typedef struct gg_run_remote {
  void (*send)(gg_run_task *task);    /* to the rank that has the replica, or to the queue here */
  void (*stop)(gg_run_tasks *run);    /* those that were sent */
  void (*collect)(gg_run_tasks *run); /* put replicas that came back in their place; by the controller */
} gg_run_remote;

struct gg_run_tasks { /* the tasks of one run, one a replica */
  gg_run_scheduler *scheduler;
  const gg_scene *scene;
  const gg_model *model; /* its `stop` ends the tasks, and polls `stopping` */
  const gg_run_callbacks *callbacks;
  int n;
  gg_run_task *task;
  atomic_bool stopping;        /* from a stop, or a failure, to the next submission */
  const gg_run_remote *remote; /* NULL: threads of this process do all */
  void *distribution;          /* of `remote` */
  /* The scheduler's, under its lock: */
  int left;               /* tasks that are not over */
  bool waits, arrived;    /* the controller waits, and could work; something is to be collected */
  pthread_cond_t changed; /* the controller has something to do */
};

/* `threads`: so many tasks and controllers are busy at a time, however many there are. Threads are started as they are
 * needed; a controller that waits works on tasks of its own run, so that with one thread none is started.
 * `distributed`: controllers have messages to attend to instead; they neither work nor count as busy, and the first
 * thread is started at once. */
gg_status gg_run_scheduler_new(int threads, bool distributed, gg_run_scheduler **scheduler, gg_error *err);
/* After its last use; NULL: nothing. */
void gg_run_scheduler_free(gg_run_scheduler *scheduler);

/* A controller counts as busy from enter to leave, except while it waits for its tasks. It enters before its first
 * submission, goes before all tasks, and leaves as well while it writes to a disk. NULL: nothing. */
void gg_run_scheduler_enter(gg_run_scheduler *scheduler);
void gg_run_scheduler_leave(gg_run_scheduler *scheduler);

/* A thread for a controller. False: there is none to be had. */
typedef struct gg_run_controller {
  pthread_t thread;
  void (*body)(void *context);
  void *context;
  bool started;
} gg_run_controller;
bool gg_run_controller_start(gg_run_controller *controller, void (*body)(void *context), void *context);
/* Wait for its end, if it was started. */
void gg_run_controller_join(gg_run_controller *controller);

/* Tasks for `n` replicas, none of them submitted. They borrow all that they are given, `threads` each for the engine.
 * On failure too, followed by gg_run_tasks_close, once all are over. */
gg_status gg_run_tasks_open(gg_run_tasks *run, gg_run_scheduler *scheduler, gg_replica *replica, int n, int threads,
                            gg_error *err);
void gg_run_tasks_close(gg_run_tasks *run);

/* Submit a task for each replica that does not exist or has not the samples that are due. */
void gg_run_submit(gg_run_tasks *run, uint64_t due, bool adapt, double priority);
/* Wait until all are over: true. A distributed scheduler also returns false at intervals. */
bool gg_run_wait(gg_run_tasks *run);
/* Tasks end where they are, with GG_INTERRUPTED; they still have to be waited for. */
void gg_run_stop(gg_run_tasks *run);

/* For run/workers. Submit one task, as it is. */
void gg_run_task_submit(gg_run_task *task);
/* State of a submitted task: queued for local threads; finished; finished by another rank. */
void gg_run_task_queue(gg_run_task *task);
void gg_run_task_finish(gg_run_task *task);

gg_run_task_status gg_run_task_get_status(const gg_run_task *task);
void gg_run_task_set_status(gg_run_task *task, const gg_run_task_status *status);
/* From its replica, which no thread is working on. */
void gg_run_task_update(gg_run_task *task);

#endif
