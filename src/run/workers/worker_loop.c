/* The other end: a process that works for rank 0. It answers messages; pieces of work are done by threads. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "run/start_model.h"
#include "run/workers/task.h"

/* Seconds between news of what is at work, and looks at whether rank 0 lives; microseconds of sleep between looks at
 * the post. */
static const double news_every = 0.5;
enum { LEAST_NAP = 20, MOST_NAP = 1000 };

typedef struct task { /* one replica of a run */
  gg_replica replica;
  gg_job job;
  gg_message work; /* what was asked */
  bool busy;
} task;

typedef struct served { /* a run */
  int64_t run;
  gg_scene scene;
  gg_model model;
  gg_stop stop;
  atomic_bool stopped;
  gg_status status; /* of its model */
  gg_error err;
  task *task; /* one a replica */
  struct served *next;
} served;

typedef struct server {
  const gg_messages *messages;
  served *runs;
  gg_gate gate;
  bool has_gate, left;
  double told;
} server;

static bool asked(void *context)
{
  served *r = context;
  return atomic_load(&r->stopped);
}

static void send(server *s, void *block, size_t size)
{
  if (block && s->messages->send(s->messages->context, 0, block, size) != 0) s->left = true;
}

static served *find(const server *s, int64_t run)
{
  served *r = s->runs;
  while (r && r->run != run) r = r->next;
  return r;
}

/* A process has as many processors as rank 0 says. */
static void note_processors(server *s, int64_t threads)
{
  if (!s->has_gate) gg_run_gate_init(&s->gate, threads > 1 ? (int)threads : 1);
  s->has_gate = true;
}

static gg_status begin(server *s, const gg_message *m, const void *block, size_t size, gg_error *err)
{
  served *r = gg_base_array_new(1, sizeof *r, err);
  if (!r) return GG_FAILED;
  note_processors(s, m->threads);
  r->run = m->run;
  r->next = s->runs, s->runs = r;
  atomic_init(&r->stopped, false);
  r->status = gg_run_message_scene(block, size, &r->scene, &r->err);
  if (r->status == GG_OK) r->status = gg_common_model_make(&r->scene, r->scene.engine, &r->model, &r->err);
  if (r->status == GG_OK && r->scene.temperature == GG_AUTO) r->status = gg_run_start_near_steady(&r->model, &r->err);
  r->stop = (gg_stop){asked, r};
  r->model.stop = &r->stop;
  r->task = gg_base_array_new((size_t)r->scene.run.replicas, sizeof *r->task, err);
  return r->task ? GG_OK : GG_FAILED;
}

static void answer(server *s, task *t, gg_status status, const gg_error *why)
{
  gg_message m = t->work;
  gg_archive archive = {0};
  size_t size;
  m.kind = GG_DONE;
  m.error = *why;
  bool whole = status == GG_OK || status == GG_INTERRUPTED;
  if (whole && t->replica.engine) {
    gg_status saved = gg_run_replica_save(&t->replica, &archive, &m.error);
    if (saved != GG_OK) status = saved;
    m.news = gg_run_job_news(&t->job);
  }
  m.status = status;
  void *block = gg_run_message_pack_archive(&m, &archive, &size);
  gg_base_archive_clear(&archive);
  if (!block) s->left = true; /* who cannot answer goes, so that nobody waits for it: others do it again */
  send(s, block, size);
}

/* The replica as rank 0 wants it gone on with. */
static gg_status get_ready(served *r, task *t, const void *block, size_t size, gg_error *err)
{
  if (t->work.origin == GG_STILL_THERE) return GG_OK;
  gg_archive archive = {0};
  gg_run_replica_clear(&t->replica);
  if (t->work.origin == GG_ANEW) return GG_OK;
  gg_status status = gg_run_message_archive(block, size, &archive, err);
  if (status == GG_OK)
    status = gg_run_replica_restore(&t->replica, &archive, &r->scene, &r->model, (int)t->work.replica, err);
  gg_base_archive_clear(&archive);
  return status;
}

static void work(server *s, const gg_message *m, const void *block, size_t size)
{
  served *r = find(s, m->run);
  if (!r || !r->task || m->replica < 0 || m->replica >= r->scene.run.replicas) return;
  task *t = &r->task[m->replica];
  gg_error err = {0};
  t->work = *m;
  atomic_store(&r->stopped, false);
  gg_status status = r->status;
  if (status == GG_OK)
    status = get_ready(r, t, block, size, &err);
  else
    err = r->err;
  if (status != GG_OK) {
    answer(s, t, status, &err);
    return;
  }
  t->job = (gg_job){.replica = &t->replica,
                    .scene = &r->scene,
                    .model = &r->model,
                    .index = (int)m->replica,
                    .threads = m->origin == GG_STILL_THERE ? 0 : (int)m->threads,
                    .due = m->due,
                    .adapt = m->adapt,
                    .gate = &s->gate,
                    .urgency = m->urgency};
  t->busy = true;
  gg_run_job_start(&t->job);
}

static void end(server *s, served *r)
{
  atomic_store(&r->stopped, true);
  for (int64_t i = 0; r->task && i < r->scene.run.replicas; i++) {
    if (r->task[i].busy) gg_run_job_finish(&r->task[i].job);
    gg_run_replica_clear(&r->task[i].replica);
  }
  served **at = &s->runs;
  while (*at != r) at = &(*at)->next;
  *at = r->next;
  free(r->task), free(r);
}

static gg_status take(server *s, const void *block, size_t size, gg_error *err)
{
  gg_message m;
  if (!gg_run_message_read(block, size, &m))
    return gg_base_fail(err, GG_FAILED, "a message from rank 0 arrived broken");
  served *r = find(s, m.run);
  if (m.kind == GG_SCENE) return begin(s, &m, block, size, err);
  if (m.kind == GG_WORK) work(s, &m, block, size);
  if (m.kind == GG_STOP && r) atomic_store(&r->stopped, true);
  if (m.kind == GG_FORGET && r) end(s, r);
  if (m.kind == GG_LEAVE) s->left = true;
  return GG_OK;
}

static void tell_news(server *s, const task *t)
{
  gg_message m = t->work;
  size_t size;
  m.kind = GG_NEWS;
  m.news = gg_run_job_news(&t->job);
  void *block = gg_run_message_pack(&m, NULL, 0, &size);
  send(s, block, size);
}

/* What is over is answered; of the rest, news now and then. True if something was over. */
static bool look_after(server *s)
{
  double now = gg_base_clock_wall();
  bool tells = now > s->told + news_every, any = false;
  for (served *r = s->runs; r; r = r->next)
    for (int64_t i = 0; i < r->scene.run.replicas; i++) {
      task *t = &r->task[i];
      if (t->busy && atomic_load(&t->job.over)) {
        gg_run_job_finish(&t->job);
        t->busy = false, any = true;
        answer(s, t, t->job.status, &t->job.err);
      } else if (t->busy && tells) {
        tell_news(s, t);
      }
    }
  if (tells) s->told = now;
  return any;
}

/* True: there was something to do. */
static gg_status once(server *s, bool *any, gg_error *err)
{
  int from, got;
  void *block;
  size_t size;
  *any = false;
  while (!s->left && (got = s->messages->receive(s->messages->context, &from, &block, &size)) != 0) {
    *any = true;
    if (got < 0) return gg_base_fail(err, GG_FAILED, "rank 0 cannot be reached");
    gg_status status = take(s, block, size, err);
    free(block);
    GG_TRY(status);
  }
  double told = s->told;
  *any |= look_after(s);
  bool alone = s->told != told && s->messages->lost && s->messages->lost(s->messages->context, 0);
  return alone ? gg_base_fail(err, GG_FAILED, "rank 0 is gone") : GG_OK;
}

static void say_hello(server *s)
{
  gg_message hello = {.kind = GG_HELLO};
  size_t size;
  gg_run_message_build(hello.error.message, sizeof hello.error.message);
  void *block = gg_run_message_pack(&hello, NULL, 0, &size);
  send(s, block, size);
}

gg_status gg_work(const gg_messages *messages, gg_error *err)
{
  if (!messages || !messages->send || !messages->receive || messages->rank < 1)
    return gg_base_fail(err, GG_BAD_INPUT, "gg_work: messages of a rank above 0, with send and receive, are needed");
  server s = {.messages = messages, .told = gg_base_clock_wall()};
  gg_status status = GG_OK;
  int nap = LEAST_NAP;
  say_hello(&s);
  while (status == GG_OK && !s.left) {
    bool any;
    status = once(&s, &any, err);
    nap = any ? LEAST_NAP : nap < MOST_NAP ? nap + nap / 4 + 1 : MOST_NAP;
    if (!any) usleep((useconds_t)nap);
  }
  while (s.runs) end(&s, s.runs);
  if (s.has_gate) gg_run_gate_clear(&s.gate);
  return status;
}
