/* A piece of work, done by a thread of this process: one replica takes samples. The same at rank 0 and elsewhere. */
#ifndef GG_JOB_H
#define GG_JOB_H

#include <pthread.h>
#include <stdatomic.h>

#include "run/replica.h"
#include "run/workers/message.h"
#include "run/workers/priority_semaphore.h"

typedef struct gg_job {
  /* Set before it starts; all of it outlives the job. */
  gg_replica *replica; /* made if it has no engine yet; else gone on with */
  const gg_scene *scene;
  const gg_model *model; /* its `stop` ends the job */
  int index;             /* of the replica */
  int threads;           /* for its engine, which has none yet; 0: it is as it should be */
  uint64_t due;
  bool adapt;
  const gg_hooks *hooks;
  gg_gate *gate; /* not more jobs at once than it lets pass, the most urgent first */
  double urgency;
  void (*ended)(void *context); /* called last, by the job's thread; NULL: nobody is told */
  void *context;
  /* While it works, to be read by anyone; and then what came of it. */
  atomic_bool over;
  _Atomic uint64_t samples;
  _Atomic double collisions_per_grain, cpu;
  gg_status status;
  gg_error err;
  pthread_t thread;
  bool has_thread;
} gg_job;

/* Where there is no thread to be had, it is done when this returns. */
void gg_run_job_start(gg_job *job);
/* When it is over: wait for its thread to be gone. */
void gg_run_job_finish(gg_job *job);
gg_replica_news gg_run_job_news(const gg_job *job);

#endif
