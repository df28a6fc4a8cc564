/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/scheduler.h"

#include <stdlib.h>

#include "base/clock.h"
#include "base/memory.h"

/* Seconds after which the controller of a distributed run looks at its callbacks. */
static const double poll_every = 0.05;

typedef struct worker {
  pthread_t thread;
  struct worker *next;
} worker;

struct gg_run_scheduler {
  pthread_mutex_t lock; /* for all below */
  pthread_cond_t work;  /* a task waits, or all is over */
  pthread_cond_t entry; /* a controller may enter */
  int threads, busy;    /* at most; tasks and controllers */
  int entering;         /* controllers that wait to enter */
  int idle, started;    /* threads that wait for a task, and all */
  bool distributed, over;
  worker *workers;
  gg_run_task *queue; /* by priority; equal ones in the order of their coming */
};

gg_run_task_status gg_run_task_get_status(const gg_run_task *t)
{
  return (gg_run_task_status){atomic_load(&t->samples), atomic_load(&t->collisions_per_grain), atomic_load(&t->cpu)};
}

void gg_run_task_set_status(gg_run_task *t, const gg_run_task_status *status)
{
  atomic_store(&t->samples, status->samples);
  atomic_store(&t->collisions_per_grain, status->collisions_per_grain);
  atomic_store(&t->cpu, status->cpu);
}

void gg_run_task_update(gg_run_task *t)
{
  const gg_replica *r = t->replica;
  if (!r->engine) return;
  gg_run_task_set_status(t,
                         &(gg_run_task_status){r->clock.samples, gg_run_replica_collisions_per_grain(r), r->clock.cpu});
}

static gg_status create_replica(gg_run_task *t)
{
  gg_replica *r = t->replica;
  if (!r->engine) GG_TRY(gg_run_replica_create(r, t->run->scene, t->run->model, t->index, &t->err));
  if (t->threads > 1 && r->engine->ops->threads) r->engine->ops->threads(r->engine, t->threads);
  t->threads = 0;
  gg_run_task_update(t);
  return GG_OK;
}

/* In steps of some tens of milliseconds, after each of which the status is up to date. */
static gg_status advance(gg_run_task *t)
{
  gg_replica *r = t->replica;
  const uint64_t step = 1 + (uint64_t)(2e5 / (1000 + (double)r->model.n));
  while (r->clock.samples < t->due) {
    const uint64_t to = r->clock.samples + step;
    gg_status status = gg_run_replica_advance(r, to < t->due ? to : t->due, t->adapt, t->run->callbacks, &t->err);
    gg_run_task_update(t);
    if (status != GG_OK) return status;
  }
  return GG_OK;
}

static void *serve(void *scheduler);

static void start_worker(gg_run_scheduler *s)
{
  worker *w = malloc(sizeof *w);
  if (w && pthread_create(&w->thread, NULL, serve, s) == 0) {
    s->started++;
    w->next = s->workers, s->workers = w;
  } else {
    free(w);
  }
}

/* Let one controller or task begin, if a processor is free; each that begins calls this again. Controllers go first:
 * they have little to do, and tasks depend on them. */
static void wake(gg_run_scheduler *s)
{
  if (s->busy >= s->threads) return;
  if (s->entering)
    pthread_cond_signal(&s->entry);
  else if (s->queue && s->queue->run->waits)
    pthread_cond_signal(&s->queue->run->changed);
  else if (s->queue && s->idle)
    pthread_cond_signal(&s->work);
  else if (s->queue && s->started < s->threads)
    start_worker(s);
}

/* The task to begin with now, or NULL. */
static gg_run_task *next_task(const gg_run_scheduler *s)
{
  return s->busy < s->threads && !s->entering ? s->queue : NULL;
}

/* Finish a task. The processor of a run's last task is passed to the run's controller. */
static void finish(gg_run_scheduler *s, gg_run_task *t)
{
  gg_run_tasks *run = t->run;
  if (t->status != GG_OK && t->status != GG_INTERRUPTED) atomic_store(&run->stopping, true);
  atomic_store(&t->over, true);
  run->arrived = run->remote != NULL;
  if (--run->left == 0 && !s->distributed) s->busy++;
  if (run->left == 0 || run->arrived) pthread_cond_signal(&run->changed);
}

/* Do the first task of the queue. The lock is released meanwhile. */
static void work(gg_run_scheduler *s)
{
  gg_run_task *t = s->queue;
  s->queue = t->next;
  s->busy++;
  wake(s);
  pthread_mutex_unlock(&s->lock);
  const unsigned before = gg_base_memory_failures();
  gg_status status = create_replica(t);
  if (status == GG_OK) status = advance(t);
  t->status = gg_base_memory_check(before, status, &t->err);
  pthread_mutex_lock(&s->lock);
  s->busy--;
  finish(s, t);
  wake(s);
}

static void *serve(void *scheduler)
{
  gg_run_scheduler *s = scheduler;
  pthread_mutex_lock(&s->lock);
  while (!s->over)
    if (next_task(s)) {
      work(s);
    } else {
      s->idle++;
      pthread_cond_wait(&s->work, &s->lock);
      s->idle--;
    }
  pthread_mutex_unlock(&s->lock);
  return NULL;
}

gg_status gg_run_scheduler_new(int threads, bool distributed, gg_run_scheduler **scheduler, gg_error *err)
{
  gg_run_scheduler *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return GG_FAILED;
  s->threads = threads > 1 ? threads : 1;
  s->distributed = distributed;
  pthread_mutex_init(&s->lock, NULL);
  pthread_cond_init(&s->work, NULL);
  pthread_cond_init(&s->entry, NULL);
  if (distributed) start_worker(s);
  if (distributed && !s->started) {
    gg_run_scheduler_free(s);
    return gg_base_fail(err, GG_FAILED, "no thread could be started");
  }
  *scheduler = s;
  return GG_OK;
}

void gg_run_scheduler_free(gg_run_scheduler *s)
{
  if (!s) return;
  pthread_mutex_lock(&s->lock);
  s->over = true;
  pthread_cond_broadcast(&s->work);
  pthread_mutex_unlock(&s->lock);
  for (worker *w; (w = s->workers);) {
    s->workers = w->next;
    pthread_join(w->thread, NULL);
    free(w);
  }
  pthread_mutex_destroy(&s->lock);
  pthread_cond_destroy(&s->work);
  pthread_cond_destroy(&s->entry);
  free(s);
}

void gg_run_scheduler_enter(gg_run_scheduler *s)
{
  if (!s) return;
  GG_LOCKED(&s->lock);
  s->entering++;
  while (s->busy >= s->threads) pthread_cond_wait(&s->entry, &s->lock);
  s->entering--;
  s->busy++;
  wake(s);
}

void gg_run_scheduler_leave(gg_run_scheduler *s)
{
  if (!s) return;
  GG_LOCKED(&s->lock);
  s->busy--;
  wake(s);
}

static void *run_controller(void *controller)
{
  gg_run_controller *c = controller;
  c->body(c->context);
  return NULL;
}

bool gg_run_controller_start(gg_run_controller *c, void (*body)(void *context), void *context)
{
  c->body = body;
  c->context = context;
  c->started = pthread_create(&c->thread, NULL, run_controller, c) == 0;
  return c->started;
}

void gg_run_controller_join(gg_run_controller *c)
{
  if (c->started) pthread_join(c->thread, NULL);
  c->started = false;
}

gg_status gg_run_tasks_open(gg_run_tasks *run, gg_run_scheduler *s, gg_replica *replica, int n, int threads,
                            gg_error *err)
{
  run->scheduler = s;
  run->task = gg_base_array_new((size_t)n, sizeof *run->task, err);
  if (!run->task) return GG_FAILED;
  run->n = n;
  atomic_init(&run->stopping, false);
  gg_base_condition_init(&run->changed);
  for (int i = 0; i < n; i++)
    run->task[i] = (gg_run_task){.run = run, .replica = &replica[i], .index = i, .threads = threads, .over = true};
  return GG_OK;
}

void gg_run_tasks_close(gg_run_tasks *run)
{
  if (!run->task) return;
  pthread_cond_destroy(&run->changed);
  free(run->task);
  run->task = NULL;
}

/* Queue a task. In one process the controller starts the work when it waits for its tasks (work_and_wait). */
void gg_run_task_queue(gg_run_task *t)
{
  gg_run_scheduler *s = t->run->scheduler;
  GG_LOCKED(&s->lock);
  gg_run_task **at = &s->queue; /* after all of the same priority */
  while (*at && (*at)->priority >= t->priority) at = &(*at)->next;
  t->next = *at, *at = t;
  if (s->distributed) wake(s);
}

static void begin(gg_run_task *t)
{
  pthread_mutex_lock(&t->run->scheduler->lock);
  t->run->left++;
  pthread_mutex_unlock(&t->run->scheduler->lock);
  t->status = GG_OK;
  atomic_store(&t->over, false);
}

void gg_run_task_submit(gg_run_task *t)
{
  begin(t);
  gg_run_task_queue(t);
}

void gg_run_submit(gg_run_tasks *run, uint64_t due, bool adapt, double priority)
{
  atomic_store(&run->stopping, false);
  for (int i = 0; i < run->n; i++) {
    gg_run_task *t = &run->task[i];
    t->status = GG_OK;
    if (t->replica->engine && t->replica->clock.samples >= due) continue;
    t->due = due, t->adapt = adapt, t->priority = priority;
    begin(t);
  }
  for (int i = 0; i < run->n; i++) {
    gg_run_task *t = &run->task[i];
    if (!atomic_load(&t->over)) run->remote ? run->remote->send(t) : gg_run_task_queue(t);
  }
}

void gg_run_stop(gg_run_tasks *run)
{
  atomic_store(&run->stopping, true);
  if (run->remote) run->remote->stop(run);
}

void gg_run_task_finish(gg_run_task *t)
{
  GG_LOCKED(&t->run->scheduler->lock);
  finish(t->run->scheduler, t);
}

/* Wait for all tasks of the run, and do some of them. The controller gives up its processor until the last task passes
 * one back. */
static void work_and_wait(gg_run_scheduler *s, gg_run_tasks *run)
{
  if (run->left) s->busy--;
  while (run->left) {
    gg_run_task *t = next_task(s);
    if (t && t->run == run) {
      work(s);
    } else {
      wake(s);
      run->waits = true;
      pthread_cond_wait(&run->changed, &s->lock);
      run->waits = false;
    }
  }
}

static bool collect_and_wait(gg_run_scheduler *s, gg_run_tasks *run)
{
  const double until = gg_base_clock_wall() + poll_every;
  while (run->left || run->arrived)
    if (run->arrived) {
      run->arrived = false;
      pthread_mutex_unlock(&s->lock);
      run->remote->collect(run);
      pthread_mutex_lock(&s->lock);
    } else if (gg_base_clock_wall() < until) {
      gg_base_condition_wait(&run->changed, &s->lock, poll_every);
    } else {
      return false;
    }
  return true;
}

bool gg_run_wait(gg_run_tasks *run)
{
  gg_run_scheduler *s = run->scheduler;
  GG_LOCKED(&s->lock);
  if (s->distributed) return collect_and_wait(s, run);
  return work_and_wait(s, run), true;
}
