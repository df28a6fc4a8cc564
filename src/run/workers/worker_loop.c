/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worker loop: a process other than rank 0 takes tasks from its messages, gives them to its own scheduler, and
 * answers. */
#include <stdlib.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "graingas.h"
#include "run/run.h"
#include "run/workers/message.h"
#include "scene/model_of_scene.h"
#include "theory/near_steady.h"

/* Seconds between reports of what is under way, and checks whether rank 0 lives. */
static const double status_every = 0.5;

typedef struct pending {  /* a replica of a run */
  gg_run_message message; /* its latest task */
  bool busy;              /* which is not answered */
} pending;

typedef struct remote_run { /* a run */
  int64_t run;
  gg_scene scene;
  gg_model model;
  gg_stop stop;
  gg_status status; /* of its model */
  gg_error err;
  gg_replica *replica; /* n of them, as of the others */
  pending *pending;
  int n;
  gg_run_tasks tasks;
  struct remote_run *next;
} remote_run;

typedef struct worker_process {
  const gg_messages *messages;
  gg_run_scheduler *scheduler;
  remote_run *runs;
  bool over;
  double reported;
} worker_process;

static bool is_stopped(void *context)
{
  remote_run *r = context;
  return atomic_load(&r->tasks.stopping);
}

static void send(worker_process *s, void *block, size_t size)
{
  if (block && s->messages->send(s->messages->context, 0, block, size) != 0) s->over = true;
}

static remote_run *find(const worker_process *s, int64_t run)
{
  remote_run *r = s->runs;
  while (r && r->run != run) r = r->next;
  return r;
}

static gg_status make_model(remote_run *r, const void *block, size_t size)
{
  GG_TRY(gg_run_message_scene(block, size, &r->scene, &r->err));
  GG_TRY(gg_scene_model_make(&r->scene, r->scene.engine, &r->model, &r->err));
  r->stop = (gg_stop){is_stopped, r};
  r->model.stop = &r->stop;
  return r->scene.start.temperature == GG_AUTO ? gg_theory_start_near_steady(&r->model, &r->err) : GG_OK;
}

static gg_status begin(worker_process *s, const gg_run_message *m, const void *block, size_t size, gg_error *err)
{
  if (!s->scheduler) GG_TRY(gg_run_scheduler_new((int)m->threads, true, &s->scheduler, err));
  remote_run *r = gg_base_array_new(1, sizeof *r, err);
  if (!r) return GG_FAILED;
  r->run = m->run;
  r->next = s->runs, s->runs = r;
  r->status = make_model(r, block, size);
  r->n = (int)r->scene.run.replicas;
  r->replica = gg_base_array_new((size_t)r->n, sizeof *r->replica, err);
  r->pending = gg_base_array_new((size_t)r->n, sizeof *r->pending, err);
  if (!r->replica || !r->pending) return GG_FAILED;
  r->tasks = (gg_run_tasks){.scene = &r->scene, .model = &r->model};
  return gg_run_tasks_open(&r->tasks, s->scheduler, r->replica, r->n, 0, err);
}

static void answer(worker_process *s, remote_run *r, int i, gg_status status, const gg_error *why)
{
  const gg_run_task *t = &r->tasks.task[i];
  gg_run_message m = r->pending[i].message;
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {0};
  size_t size;
  m.kind = GG_MESSAGE_DONE;
  m.error = *why;
  m.reached = gg_run_task_get_status(t);
  if ((status == GG_OK || status == GG_INTERRUPTED) && t->replica->engine) {
    gg_status saved = gg_run_replica_save(t->replica, &archive, &m.error);
    if (saved != GG_OK) status = saved;
  }
  m.status = status;
  r->pending[i].busy = false;
  void *block = gg_run_message_pack_archive(&m, &archive, &size);
  if (!block) s->over = true; /* it ends, so that nobody waits for the answer: others do the task again */
  send(s, block, size);
}

/* The replica with which the task begins. */
static gg_status get_ready(remote_run *r, const gg_run_message *m, const void *block, size_t size, gg_error *err)
{
  gg_replica *replica = &r->replica[m->replica];
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {0};
  if (m->origin == GG_ORIGIN_THERE) return GG_OK;
  gg_run_replica_clear(replica);
  if (m->origin == GG_ORIGIN_NEW) return GG_OK;
  GG_TRY(gg_run_message_archive(block, size, &archive, err));
  return gg_run_replica_restore(replica, &archive, &r->scene, &r->model, (int)m->replica, err);
}

static void start_task(worker_process *s, const gg_run_message *m, const void *block, size_t size)
{
  remote_run *r = find(s, m->run);
  if (!r || m->replica < 0 || m->replica >= r->n) return;
  const int i = (int)m->replica;
  gg_run_task *t = &r->tasks.task[i];
  gg_error err = r->err;
  r->pending[i] = (pending){*m, true};
  atomic_store(&r->tasks.stopping, false);
  gg_status status = r->status == GG_OK ? get_ready(r, m, block, size, &err) : r->status;
  if (status != GG_OK) {
    answer(s, r, i, status, &err);
    return;
  }
  t->threads = m->origin == GG_ORIGIN_THERE ? 0 : (int)m->threads;
  t->due = m->due, t->adapt = m->adapt, t->priority = m->priority;
  gg_run_task_update(t);
  gg_run_task_submit(t);
}

static void end(worker_process *s, remote_run *r)
{
  if (r->tasks.task) {
    gg_run_stop(&r->tasks);
    while (!gg_run_wait(&r->tasks)) {
    }
  }
  gg_run_tasks_close(&r->tasks);
  for (int i = 0; r->replica && i < r->n; i++) gg_run_replica_clear(&r->replica[i]);
  remote_run **at = &s->runs;
  while (*at != r) at = &(*at)->next;
  *at = r->next;
  free(r->replica), free(r->pending), free(r);
}

static gg_status take(worker_process *s, const void *block, size_t size, gg_error *err)
{
  gg_run_message m;
  if (!gg_run_message_read(block, size, &m))
    return gg_base_fail(err, GG_FAILED, "a message from rank 0 arrived broken");
  remote_run *r = find(s, m.run);
  switch (m.kind) {
  case GG_MESSAGE_SCENE: return begin(s, &m, block, size, err);
  case GG_MESSAGE_TASK: start_task(s, &m, block, size); break;
  case GG_MESSAGE_STOP:
    if (r) gg_run_stop(&r->tasks);
    break;
  case GG_MESSAGE_END:
    if (r) end(s, r);
    break;
  case GG_MESSAGE_SHUTDOWN: s->over = true; break;
  default: break;
  }
  return GG_OK;
}

static void report(worker_process *s, const remote_run *r, int i)
{
  gg_run_message m = r->pending[i].message;
  size_t size;
  m.kind = GG_MESSAGE_STATUS;
  m.reached = gg_run_task_get_status(&r->tasks.task[i]);
  void *block = gg_run_message_pack(&m, NULL, 0, &size);
  send(s, block, size);
}

/* Answers tasks that are over; reports the others now and then. True: one was over. */
static bool look_after(worker_process *s, bool reports)
{
  bool any = false;
  for (remote_run *r = s->runs; r; r = r->next)
    for (int i = 0; i < r->n; i++) {
      const gg_run_task *t = &r->tasks.task[i];
      if (r->pending[i].busy && atomic_load(&t->over))
        any = true, answer(s, r, i, t->status, &t->err);
      else if (r->pending[i].busy && reports)
        report(s, r, i);
    }
  return any;
}

/* *any: there was something to do. */
static gg_status once(worker_process *s, bool *any, gg_error *err)
{
  int from, got;
  void *block;
  size_t size;
  *any = false;
  while (!s->over && (got = s->messages->receive(s->messages->context, &from, &block, &size)) != 0) {
    *any = true;
    if (got < 0) return gg_base_fail(err, GG_FAILED, "rank 0 cannot be reached");
    gg_status status = take(s, block, size, err);
    free(block);
    GG_TRY(status);
  }
  const bool reports = gg_base_clock_wall() > s->reported + status_every;
  *any |= look_after(s, reports);
  if (!reports) return GG_OK;
  s->reported = gg_base_clock_wall();
  bool alone = s->messages->lost && s->messages->lost(s->messages->context, 0);
  return alone ? gg_base_fail(err, GG_FAILED, "rank 0 is gone") : GG_OK;
}

gg_status gg_worker_run(const gg_messages *messages, gg_error *err)
{
  if (!messages || !messages->send || !messages->receive || messages->rank < 1)
    return GG_REFUSE(err, "gg_worker_run: messages of a rank above 0, with send and receive, are needed");
  worker_process s = {.messages = messages, .reported = gg_base_clock_wall()};
  gg_status status = GG_OK;
  bool any = true;
  gg_run_message hello = {.kind = GG_MESSAGE_REGISTER};
  size_t size;
  gg_run_message_build(hello.error.message, sizeof hello.error.message);
  void *block = gg_run_message_pack(&hello, NULL, 0, &size);
  send(&s, block, size);
  for (int nap = 0; status == GG_OK && !s.over;) {
    status = once(&s, &any, err);
    nap = gg_run_message_nap(nap, any);
    if (!any) usleep((useconds_t)nap);
  }
  while (s.runs) end(&s, s.runs);
  gg_run_scheduler_free(s.scheduler);
  return status;
}
