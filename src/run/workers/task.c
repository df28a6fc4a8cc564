#include "run/workers/task.h"

static void tell(gg_job *job)
{
  const gg_replica *r = job->replica;
  atomic_store(&job->samples, r->clock.samples);
  atomic_store(&job->collisions_per_grain, gg_run_replica_collisions_per_grain(r));
  atomic_store(&job->cpu, r->clock.cpu);
}

/* In pieces of some tens of milliseconds, after each of which it can be told how far it is. */
static gg_status advance(gg_job *job)
{
  gg_replica *r = job->replica;
  uint64_t step = 1 + (uint64_t)(2e5 / (1000 + (double)job->model->n));
  gg_status status = GG_OK;
  while (status == GG_OK && r->clock.samples < job->due) {
    uint64_t to = r->clock.samples + step;
    status = gg_run_replica_advance(r, to < job->due ? to : job->due, job->adapt, job->hooks, &job->err);
    tell(job);
  }
  return status;
}

static gg_status make(gg_job *job)
{
  if (job->replica->engine) return GG_OK;
  return gg_run_replica_create(job->replica, job->scene, job->model, job->index, &job->err);
}

static void *work(void *argument)
{
  gg_job *job = argument;
  gg_run_gate_enter(job->gate, job->urgency);
  job->status = make(job);
  if (job->status == GG_OK) {
    const gg_engine_ops *ops = job->replica->engine->ops;
    if (job->threads > 1 && ops->threads) ops->threads(job->replica->engine, job->threads);
    tell(job);
    job->status = advance(job);
  }
  gg_run_gate_leave(job->gate);
  atomic_store(&job->over, true);
  if (job->ended) job->ended(job->context);
  return NULL;
}

void gg_run_job_start(gg_job *job)
{
  atomic_init(&job->over, false);
  if (job->replica->engine) tell(job); /* before its turn comes */
  job->has_thread = pthread_create(&job->thread, NULL, work, job) == 0;
  if (job->has_thread) return;
  job->ended = NULL; /* who waits for that is the caller */
  work(job);
}

void gg_run_job_finish(gg_job *job)
{
  if (job->has_thread) pthread_join(job->thread, NULL);
  job->has_thread = false;
}

gg_replica_news gg_run_job_news(const gg_job *job)
{
  return (gg_replica_news){atomic_load(&job->samples), atomic_load(&job->collisions_per_grain), atomic_load(&job->cpu)};
}
