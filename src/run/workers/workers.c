/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/workers/workers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "graingas.h"
#include "run/workers/message.h"

/* Seconds: the longest silence of a rank that works, which sends its status twice a second; until all have registered;
 * between two checks which ranks are lost. */
static const double longest_silence = 60, longest_wait = 30, check_every = 0.5;

typedef struct rank {
  bool there, lost; /* it has registered; it is gone */
  int replicas;     /* that belong to it, of all runs */
  int tasks;        /* that it has to do */
  bool cut_off;     /* something could not be sent to it, which it will never answer */
  double heard;     /* when; or when it was sent the first of its tasks */
} rank;

typedef struct placed { /* a replica of a run */
  int owner;            /* rank */
  bool there;           /* the owner has the replica as it is here */
  bool sent;            /* its task was sent to the owner, who has not answered */
  int64_t number;       /* of that task, which the answer has to name */
  void *block;          /* an answer that the run's controller has not unpacked ... */
  size_t size;
  int from; /* ... and its rank */
} placed;

typedef struct distribution { /* of a run */
  gg_workers *workers;
  gg_run_tasks *tasks;
  int64_t run;
  placed *placed;    /* one a replica */
  bool *knows_scene; /* rank by rank */
  struct distribution *next;
} distribution;

struct gg_workers {
  gg_messages messages;
  int threads; /* of each rank */
  gg_run_scheduler *scheduler;
  gg_run_controller mailbox;
  pthread_mutex_t lock; /* for all below, and for the messages; taken before the scheduler's */
  bool over;
  rank *rank;
  _Atomic int working; /* ranks; to be read without the lock */
  distribution *runs;
  int64_t n_runs, n_tasks; /* numbers given out */
  double checked;          /* when it was last checked which ranks are lost */
};

gg_run_scheduler *gg_run_workers_scheduler(gg_workers *w)
{
  return w->scheduler;
}

static void send_block(gg_workers *w, int to, void *block, size_t size)
{
  if (block && w->messages.send(w->messages.context, to, block, size) != 0) w->rank[to].cut_off = true;
}

static void send_word(gg_workers *w, int to, gg_run_message_kind kind, int64_t run)
{
  size_t size;
  void *block = gg_run_message_pack(&(gg_run_message){.kind = kind, .run = run}, NULL, 0, &size);
  send_block(w, to, block, size);
}

/* To the rank with the fewest replicas; but frames and the log are written by this process. */
static void assign(distribution *d, int i)
{
  gg_workers *w = d->workers;
  int owner = 0;
  const gg_scene *scene = d->tasks->scene;
  bool stays = i == 0 && (scene->output.trajectory_every > 0 || *scene->output.log);
  for (int k = 1; k < w->messages.size && !stays; k++)
    if (w->rank[k].there && !w->rank[k].lost && w->rank[k].replicas < w->rank[owner].replicas) owner = k;
  d->placed[i].owner = owner;
  d->placed[i].there = false;
  w->rank[owner].replicas++;
}

/* Threads for the engine of one replica, where a rank has more of them than replicas. */
static int threads_each(const distribution *d)
{
  const int ranks = atomic_load(&d->workers->working), replicas = (d->tasks->n + ranks - 1) / ranks,
            n = d->workers->threads;
  return n >= 2 * replicas ? n / replicas : 1;
}

static void *pack(const gg_run_task *t, gg_run_message *m, bool there, size_t *size)
{
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {0};
  m->origin = !t->replica->engine ? GG_ORIGIN_NEW : there ? GG_ORIGIN_THERE : GG_ORIGIN_ARCHIVE;
  if (m->origin == GG_ORIGIN_ARCHIVE && gg_run_replica_save(t->replica, &archive, NULL) != GG_OK) return NULL;
  return gg_run_message_pack_archive(m, &archive, size);
}

static bool send_scene(distribution *d, int to)
{
  size_t size;
  const gg_run_message m = {.kind = GG_MESSAGE_SCENE, .run = d->run, .threads = d->workers->threads};
  void *block = gg_run_message_pack(&m, d->tasks->scene, sizeof *d->tasks->scene, &size);
  send_block(d->workers, to, block, size);
  return d->knows_scene[to] = block != NULL;
}

static void send_task(distribution *d, gg_run_task *t)
{
  placed *p = &d->placed[t->index];
  rank *to = &d->workers->rank[p->owner];
  gg_run_message m = {.kind = GG_MESSAGE_TASK,
                      .run = d->run,
                      .replica = t->index,
                      .task = p->number = ++d->workers->n_tasks,
                      .due = t->due,
                      .adapt = t->adapt,
                      .threads = threads_each(d),
                      .priority = t->priority};
  size_t size;
  bool known = d->knows_scene[p->owner] || send_scene(d, p->owner);
  void *block = known ? pack(t, &m, p->there, &size) : NULL;
  if (!block) {
    t->status = gg_base_out_of_memory_for(&t->err, "a message of replica %d", t->index);
    gg_run_task_finish(t);
    return;
  }
  p->sent = true;
  if (to->tasks++ == 0) to->heard = gg_base_clock_wall();
  send_block(d->workers, p->owner, block, size);
}

static void place_task(distribution *d, gg_run_task *t)
{
  placed *p = &d->placed[t->index];
  if (p->owner != 0) {
    send_task(d, t);
  } else {
    t->threads = p->there ? 0 : threads_each(d);
    p->there = true;
    gg_run_task_queue(t);
  }
}

static void send(gg_run_task *t)
{
  distribution *d = t->run->distribution;
  GG_LOCKED(&d->workers->lock);
  place_task(d, t);
}

static void stop(gg_run_tasks *tasks)
{
  distribution *d = tasks->distribution;
  GG_LOCKED(&d->workers->lock);
  for (int i = 0; i < tasks->n; i++)
    if (d->placed[i].sent) send_word(d->workers, d->placed[i].owner, GG_MESSAGE_STOP, d->run);
}

/* The replica as it came back takes the place of the one that is here. */
static gg_status unpack(gg_run_task *t, const void *block, size_t size, bool *restored)
{
  GG_CLEARED(gg_base_archive_clear) gg_archive archive = {0};
  *restored = false;
  GG_TRY(gg_run_message_archive(block, size, &archive, &t->err));
  if (!archive.n_items) return GG_OK;
  *restored = true;
  gg_run_replica_clear(t->replica);
  return gg_run_replica_restore(t->replica, &archive, t->run->scene, t->run->model, t->index, &t->err);
}

static void collect(gg_run_tasks *tasks)
{
  distribution *d = tasks->distribution;
  GG_LOCKED(&d->workers->lock);
  for (int i = 0; i < tasks->n; i++) {
    placed *p = &d->placed[i];
    void *block = p->block;
    bool restored;
    if (!block) continue;
    p->block = NULL;
    pthread_mutex_unlock(&d->workers->lock);
    gg_status status = unpack(&tasks->task[i], block, p->size, &restored);
    if (status != GG_OK) tasks->task[i].status = status;
    free(block);
    pthread_mutex_lock(&d->workers->lock);
    if (restored) p->there = status == GG_OK && p->owner == p->from;
  }
}

static const gg_run_remote over_ranks = {send, stop, collect};

gg_status gg_run_distribution_open(gg_workers *w, gg_run_tasks *tasks, gg_error *err)
{
  distribution *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return GG_FAILED;
  *d = (distribution){.workers = w, .tasks = tasks};
  d->placed = gg_base_array_new((size_t)tasks->n, sizeof *d->placed, err);
  d->knows_scene = gg_base_array_new((size_t)w->messages.size, sizeof *d->knows_scene, err);
  if (!d->placed || !d->knows_scene) {
    free(d->placed), free(d->knows_scene), free(d);
    return GG_FAILED;
  }
  pthread_mutex_lock(&w->lock);
  d->run = ++w->n_runs;
  for (int i = 0; i < tasks->n; i++) assign(d, i);
  d->next = w->runs, w->runs = d;
  pthread_mutex_unlock(&w->lock);
  tasks->distribution = d;
  tasks->remote = &over_ranks;
  return GG_OK;
}

void gg_run_distribution_close(gg_run_tasks *tasks)
{
  distribution *d = tasks->distribution, **at;
  if (!d) return;
  gg_workers *w = d->workers;
  pthread_mutex_lock(&w->lock);
  for (int k = 1; k < w->messages.size; k++)
    if (d->knows_scene[k] && !w->rank[k].lost) send_word(w, k, GG_MESSAGE_END, d->run);
  for (int i = 0; i < tasks->n; i++) w->rank[d->placed[i].owner].replicas--;
  for (at = &w->runs; *at != d;) at = &(*at)->next;
  *at = d->next;
  pthread_mutex_unlock(&w->lock);
  free(d->placed), free(d->knows_scene), free(d);
  tasks->distribution = NULL;
}

void gg_run_distribution_changed(gg_run_tasks *tasks)
{
  distribution *d = tasks->distribution;
  if (!d) return;
  GG_LOCKED(&d->workers->lock);
  for (int i = 0; i < tasks->n; i++)
    if (d->placed[i].owner != 0) d->placed[i].there = false;
}

/* Give the tasks of a lost rank to others, from the last state of each replica that arrived here. */
static void replace(distribution *d, int lost)
{
  for (int i = 0; i < d->tasks->n; i++) {
    placed *p = &d->placed[i];
    gg_run_task *t = &d->tasks->task[i];
    if (p->owner != lost) continue;
    d->workers->rank[lost].replicas--;
    assign(d, i);
    if (!p->sent) continue;
    p->sent = false;
    gg_run_task_update(t); /* samples that the lost rank alone had do not count */
    if (!atomic_load(&d->tasks->stopping)) {
      place_task(d, t);
    } else {
      t->status = gg_base_fail(&t->err, GG_INTERRUPTED, "interrupted");
      gg_run_task_finish(t);
    }
  }
}

static void lose(gg_workers *w, int i, const char *why)
{
  char text[200];
  if (w->rank[i].lost) return;
  if (w->rank[i].there) atomic_fetch_sub(&w->working, 1);
  w->rank[i].lost = true;
  snprintf(text, sizeof text, "process %d of %d %s; what it had is done again by the others", i, w->messages.size, why);
  if (w->messages.warn) w->messages.warn(w->messages.context, text);
  for (distribution *d = w->runs; d; d = d->next) replace(d, i);
}

static void enter_rank(gg_workers *w, int from, const gg_run_message *m)
{
  char build[sizeof m->error.message];
  gg_run_message_build(build, sizeof build);
  if (strcmp(build, m->error.message) != 0) {
    lose(w, from, "is another build of graingas");
  } else if (!w->rank[from].there) {
    w->rank[from].there = true;
    atomic_fetch_add(&w->working, 1);
  }
}

/* The run whose task this rank has; NULL: the message is late, of a run that is over or of a task done elsewhere. */
static distribution *find_run(gg_workers *w, const gg_run_message *m, int from)
{
  distribution *d = w->runs;
  while (d && d->run != m->run) d = d->next;
  if (!d || m->replica < 0 || m->replica >= d->tasks->n) return NULL;
  const placed *p = &d->placed[m->replica];
  return p->sent && p->owner == from && p->number == m->task ? d : NULL;
}

/* Keeps the block of a task that is done. */
static void *take(gg_workers *w, int from, void *block, size_t size)
{
  gg_run_message m;
  if (!gg_run_message_read(block, size, &m)) return block;
  w->rank[from].heard = gg_base_clock_wall();
  if (m.kind == GG_MESSAGE_REGISTER) enter_rank(w, from, &m);
  distribution *d = m.kind == GG_MESSAGE_STATUS || m.kind == GG_MESSAGE_DONE ? find_run(w, &m, from) : NULL;
  if (!d) return block;
  gg_run_task *t = &d->tasks->task[m.replica];
  placed *p = &d->placed[m.replica];
  gg_run_task_set_status(t, &m.reached);
  if (m.kind == GG_MESSAGE_STATUS) return block;
  w->rank[from].tasks--;
  p->sent = false;
  p->block = block, p->size = size, p->from = from;
  t->status = (gg_status)m.status, t->err = m.error;
  gg_run_task_finish(t);
  return NULL;
}

static void check_lost(gg_workers *w)
{
  double now = gg_base_clock_wall();
  if (now < w->checked + check_every) return;
  w->checked = now;
  for (int i = 1; i < w->messages.size; i++) {
    const rank *r = &w->rank[i];
    if (r->lost) continue;
    if (w->messages.lost && w->messages.lost(w->messages.context, i))
      lose(w, i, "is gone");
    else if (r->cut_off || (r->tasks && now > r->heard + longest_silence))
      lose(w, i, "does not answer");
  }
}

/* True: a message has come. */
static bool receive(gg_workers *w)
{
  bool any = false;
  int from;
  void *block;
  size_t size;
  while (w->messages.receive(w->messages.context, &from, &block, &size) > 0) {
    any = true;
    if (from > 0 && from < w->messages.size && !w->rank[from].lost) block = take(w, from, block, size);
    free(block);
  }
  check_lost(w);
  return any;
}

static void read_mailbox(void *context)
{
  gg_workers *w = context;
  GG_LOCKED(&w->lock);
  for (int nap = 0; !w->over;) {
    nap = gg_run_message_nap(nap, receive(w));
    pthread_mutex_unlock(&w->lock);
    usleep((useconds_t)nap);
    pthread_mutex_lock(&w->lock);
  }
}

/* All register at about the same time; one that is late is given work when there is more. */
static void wait_for_all(gg_workers *w)
{
  double until = gg_base_clock_wall() + longest_wait;
  for (int missing = 1; missing && gg_base_clock_wall() < until;) {
    receive(w);
    missing = 0;
    for (int i = 1; i < w->messages.size; i++) missing += !w->rank[i].there && !w->rank[i].lost;
    if (missing) usleep(200);
  }
}

int gg_workers_threads(const gg_workers *w)
{
  return w ? atomic_load(&w->working) * w->threads : 0;
}

gg_status gg_workers_new(const gg_messages *messages, int threads, gg_workers **workers, gg_error *err)
{
  if (!messages || !workers || !messages->send || !messages->receive || messages->rank != 0 || messages->size < 1)
    return GG_REFUSE(err, "gg_workers_new: messages of rank 0, with send and receive, are needed");
  gg_workers *w = gg_base_array_new(1, sizeof *w, err);
  if (!w) return GG_FAILED;
  w->messages = *messages;
  w->threads = threads > 1 ? threads : 1;
  pthread_mutex_init(&w->lock, NULL);
  w->rank = gg_base_array_new((size_t)messages->size, sizeof *w->rank, err);
  gg_status status = w->rank ? gg_run_scheduler_new(w->threads, true, &w->scheduler, err) : GG_FAILED;
  if (status == GG_OK) {
    w->rank[0].there = true;
    atomic_init(&w->working, 1);
    wait_for_all(w);
    if (!gg_run_controller_start(&w->mailbox, read_mailbox, w))
      status = gg_base_fail(err, GG_FAILED, "no thread could be started");
  }
  if (status == GG_OK)
    *workers = w;
  else
    gg_workers_free(w);
  return status;
}

void gg_workers_free(gg_workers *w)
{
  if (!w) return;
  pthread_mutex_lock(&w->lock);
  w->over = true;
  pthread_mutex_unlock(&w->lock);
  gg_run_controller_join(&w->mailbox);
  for (int i = 1; w->rank && i < w->messages.size; i++) send_word(w, i, GG_MESSAGE_SHUTDOWN, 0);
  gg_run_scheduler_free(w->scheduler);
  pthread_mutex_destroy(&w->lock);
  free(w->rank);
  free(w);
}
