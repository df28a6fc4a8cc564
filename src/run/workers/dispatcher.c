/* A run's replicas are handed out to the processes that take part, and come back. */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "run/workers/pool.h"

/* Seconds between two looks at whether to stop and at the progress hook; microseconds of sleep between looks at the
 * post. */
static const double look_every = 0.05;
enum { LEAST_NAP = 20, MOST_NAP = 1000 };

static void tell_ended(void *context)
{
  gg_share *s = context;
  pthread_mutex_lock(&s->workers->lock);
  pthread_cond_signal(&s->news);
  pthread_mutex_unlock(&s->workers->lock);
}

static gg_status locked_frame(void *context, const gg_frame *frame, gg_error *err)
{
  const gg_replicas *all = context;
  return all->hooks->frame(all->hooks->context, frame, err); /* only the first replica has any */
}

/* Frames are written by this process. */
static int owner_of(const gg_share *s, int i)
{
  return i == 0 && s->all->scene.output.trajectory_every > 0 ? 0 : gg_workers_least(s->workers);
}

static void own(gg_share *s, int i, int rank)
{
  s->piece[i].owner = rank;
  s->piece[i].still_there = false;
  s->workers->rank[rank].replicas++;
}

gg_status gg_run_share_open(gg_replicas *all, gg_share **share, gg_error *err)
{
  gg_workers *w = all->hooks ? all->hooks->workers : NULL;
  *share = NULL;
  if (!w || all->scene.extension) return GG_OK;
  gg_share *s = gg_base_array_new(1, sizeof *s, err);
  if (!s) return GG_FAILED;
  *s = (gg_share){.workers = w, .all = all, .hooks = {.context = all}};
  if (all->hooks->frame) s->hooks.frame = locked_frame;
  s->piece = gg_base_array_new((size_t)all->n, sizeof *s->piece, err);
  s->told = gg_base_array_new((size_t)w->messages.size, sizeof *s->told, err);
  if (!s->piece || !s->told) {
    free(s->piece), free(s->told), free(s);
    return GG_FAILED;
  }
  gg_base_condition_init(&s->news);
  pthread_mutex_lock(&w->lock);
  s->run = ++w->runs;
  for (int i = 0; i < all->n; i++) own(s, i, owner_of(s, i));
  s->next = w->shares, w->shares = s;
  pthread_mutex_unlock(&w->lock);
  *share = s;
  return GG_OK;
}

static void send_word(gg_share *s, int rank, gg_message_kind kind)
{
  size_t size;
  void *block = gg_run_message_pack(&(gg_message){.kind = kind, .run = s->run}, NULL, 0, &size);
  gg_workers_send(s->workers, rank, block, size);
}

void gg_run_share_close(gg_share *s)
{
  if (!s) return;
  gg_workers *w = s->workers;
  pthread_mutex_lock(&w->lock);
  for (int rank = 1; rank < w->messages.size; rank++)
    if (s->told[rank] && !w->rank[rank].lost) send_word(s, rank, GG_FORGET);
  for (int i = 0; i < s->all->n; i++) w->rank[s->piece[i].owner].replicas--;
  gg_share **at = &w->shares;
  while (*at != s) at = &(*at)->next;
  *at = s->next;
  pthread_mutex_unlock(&w->lock);
  pthread_cond_destroy(&s->news);
  free(s->piece), free(s->told), free(s);
}

void gg_run_share_lose(gg_share *s, int rank)
{
  for (int i = 0; i < s->all->n; i++) {
    gg_piece *p = &s->piece[i];
    if (p->owner != rank) continue;
    s->workers->rank[rank].replicas--;
    own(s, i, owner_of(s, i));
    if (p->state == GG_SENT) p->state = GG_LOST;
    pthread_cond_signal(&s->news);
  }
}

/* Threads within one replica, where a process has more of them than replicas. */
static int threads_each(const gg_share *s)
{
  int ranks = 0, threads = s->workers->threads;
  for (int i = 0; i < s->workers->messages.size; i++) ranks += s->workers->rank[i].there && !s->workers->rank[i].lost;
  int replicas = (s->all->n + ranks - 1) / ranks;
  return threads >= 2 * replicas ? threads / replicas : 1;
}

/* The run that is least exact goes first, before all one of which nothing is known. */
static double urgency_of(const gg_share *s)
{
  const double error = s->all->last.relative_error;
  return isnan(error) ? INFINITY : error;
}

static void start_here(gg_share *s, int i)
{
  gg_piece *p = &s->piece[i];
  p->state = GG_HERE;
  p->job = (gg_job){.replica = &s->all->replica[i],
                    .scene = &s->all->scene,
                    .model = &s->all->model,
                    .index = i,
                    .threads = p->still_there ? 0 : threads_each(s),
                    .due = s->due,
                    .adapt = s->adapt,
                    .hooks = &s->hooks,
                    .gate = &s->workers->gate,
                    .urgency = urgency_of(s),
                    .ended = tell_ended,
                    .context = s};
  gg_run_job_start(&p->job);
}

static void *pack(const gg_share *s, int i, gg_message *m, size_t *size, gg_error *err)
{
  const gg_replica *r = &s->all->replica[i];
  gg_archive archive = {0};
  void *block = NULL;
  m->origin = !r->engine ? GG_ANEW : s->piece[i].still_there ? GG_STILL_THERE : GG_BY_ARCHIVE;
  if (m->origin != GG_BY_ARCHIVE || gg_run_replica_save(r, &archive, err) == GG_OK)
    block = gg_run_message_pack_archive(m, &archive, size);
  gg_base_archive_clear(&archive);
  return block;
}

static void tell_scene(gg_share *s, int rank)
{
  size_t size;
  const gg_message m = {.kind = GG_SCENE, .run = s->run, .threads = s->workers->threads};
  void *block = gg_run_message_pack(&m, &s->all->scene, sizeof s->all->scene, &size);
  gg_workers_send(s->workers, rank, block, size);
  s->told[rank] = block != NULL;
}

static void start_there(gg_share *s, int i)
{
  gg_piece *p = &s->piece[i];
  gg_rank *rank = &s->workers->rank[p->owner];
  gg_message m = {.kind = GG_WORK,
                  .run = s->run,
                  .replica = i,
                  .piece = p->number = ++s->workers->pieces,
                  .due = s->due,
                  .adapt = s->adapt,
                  .threads = threads_each(s),
                  .urgency = urgency_of(s)};
  size_t size;
  if (!s->told[p->owner]) tell_scene(s, p->owner);
  void *block = s->told[p->owner] ? pack(s, i, &m, &size, &p->err) : NULL;
  if (!block) {
    p->state = GG_BACK;
    p->status = gg_base_out_of_memory_for(&p->err, "a message of replica %d", i);
    return;
  }
  p->state = GG_SENT;
  p->sent_to = p->owner;
  if (rank->pieces++ == 0) rank->heard = gg_base_clock_wall();
  gg_workers_send(s->workers, p->owner, block, size);
}

static void start(gg_share *s, int i)
{
  gg_piece *p = &s->piece[i];
  const gg_replica *r = &s->all->replica[i];
  p->status = GG_OK;
  p->news = (gg_replica_news){r->clock.samples, r->engine ? gg_run_replica_collisions_per_grain(r) : 0, r->clock.cpu};
  if (p->owner == 0)
    start_here(s, i);
  else
    start_there(s, i);
}

/* Of a process that is lost: by another, from where the replica stood when it was last here. */
static void start_lost(gg_share *s)
{
  for (int i = 0; i < s->all->n; i++) {
    gg_piece *p = &s->piece[i];
    if (p->state != GG_LOST) continue;
    if (!s->stopping) {
      start(s, i);
    } else {
      p->state = GG_BACK;
      p->status = gg_base_fail(&p->err, GG_INTERRUPTED, "interrupted");
    }
  }
}

static void stop(gg_share *s)
{
  s->stopping = true;
  atomic_store(&s->all->pausing, true);
  for (int i = 0; i < s->all->n; i++)
    if (s->piece[i].state == GG_SENT) send_word(s, s->piece[i].owner, GG_STOP);
}

/* The replica as it came back takes the place of the one that is here. */
static gg_status unpack(gg_share *s, int i)
{
  gg_piece *p = &s->piece[i];
  gg_replicas *all = s->all;
  gg_archive archive = {0};
  gg_status status = gg_run_message_archive(p->block, p->size, &archive, &p->err);
  if (status == GG_OK && archive.n_items) {
    gg_run_replica_clear(&all->replica[i]);
    status = gg_run_replica_restore(&all->replica[i], &archive, &all->scene, &all->model, i, &p->err);
    pthread_mutex_lock(&s->workers->lock);
    p->still_there = status == GG_OK && p->owner == p->sent_to;
    pthread_mutex_unlock(&s->workers->lock);
  }
  gg_base_archive_clear(&archive);
  return status;
}

static void collect(gg_share *s, int i)
{
  gg_piece *p = &s->piece[i];
  if (p->state == GG_HERE && atomic_load(&p->job.over)) {
    gg_run_job_finish(&p->job);
    p->status = p->job.status, p->err = p->job.err;
    p->still_there = true;
    p->state = GG_IDLE;
  } else if (p->state == GG_BACK) {
    gg_status unpacked = p->block ? unpack(s, i) : GG_OK;
    if (unpacked != GG_OK) p->status = unpacked;
    free(p->block), p->block = NULL;
    p->state = GG_IDLE;
  }
}

/* What all of it came to: what failed goes before what was stopped. */
static gg_status outcome(const gg_share *s, gg_error *err)
{
  const gg_piece *worst = NULL;
  for (int i = 0; i < s->all->n; i++) {
    const gg_piece *p = &s->piece[i];
    if (p->status == GG_OK || (worst && p->status == GG_INTERRUPTED)) continue;
    if (!worst || worst->status == GG_INTERRUPTED) worst = p;
  }
  if (!worst) return GG_OK;
  bool paused = worst->status == GG_INTERRUPTED && atomic_load(&s->all->stopped) == GG_GOES_ON;
  if (err && !paused) *err = worst->err;
  return paused ? GG_OK : worst->status;
}

static bool has_failed(const gg_share *s)
{
  for (int i = 0; i < s->all->n; i++)
    if (s->piece[i].status != GG_OK) return true;
  return false;
}

static bool is_back(const gg_share *s)
{
  for (int i = 0; i < s->all->n; i++) {
    const gg_piece *p = &s->piece[i];
    if (p->state == GG_BACK || p->state == GG_LOST || (p->state == GG_HERE && atomic_load(&p->job.over))) return true;
  }
  return false;
}

/* Another run's thread takes the post over. */
static void pass_the_post(gg_share *s)
{
  for (gg_share *other = s->workers->shares; other; other = other->next)
    if (other != s && other->waits) {
      pthread_cond_signal(&other->news);
      return;
    }
}

/* One thread at a time looks after the post, which nobody can wait for: with naps in between. */
static void read_post(gg_share *s, int *nap)
{
  gg_workers *w = s->workers;
  w->reading = true;
  bool any = gg_workers_attend(w);
  *nap = any ? LEAST_NAP : *nap < MOST_NAP ? *nap + *nap / 4 + 1 : MOST_NAP;
  if (!is_back(s)) {
    pthread_mutex_unlock(&w->lock);
    usleep((useconds_t)*nap);
    pthread_mutex_lock(&w->lock);
  }
  w->reading = false;
}

static void wait_for_news(gg_share *s)
{
  s->waits = true;
  gg_base_condition_wait(&s->news, &s->workers->lock, look_every);
  s->waits = false;
}

/* Until a piece of this run is back, or it is time to look around. */
static void await(gg_share *s, double until)
{
  int nap = LEAST_NAP;
  pthread_mutex_lock(&s->workers->lock);
  while (!is_back(s) && gg_base_clock_wall() < until)
    if (s->workers->reading)
      wait_for_news(s);
    else
      read_post(s, &nap);
  start_lost(s);
  if (!s->workers->reading) pass_the_post(s);
  pthread_mutex_unlock(&s->workers->lock);
}

/* While others work. */
static void attend(gg_share *s, double *looked)
{
  await(s, *looked + look_every);
  for (int i = 0; i < s->all->n; i++) collect(s, i);
  double now = gg_base_clock_wall();
  if (now < *looked + look_every) return;
  *looked = now;
  /* Before all replicas are there, there is nothing that a checkpoint could hold. */
  bool pauses = s->due > 0 && gg_run_replicas_checkpoint_is_due(s->all);
  bool ends = pauses || gg_stop_asked(&s->all->stop);
  pthread_mutex_lock(&s->workers->lock);
  ends = ends || has_failed(s); /* another run's thread may just be taking in an answer */
  if (ends && !s->stopping) stop(s);
  pthread_mutex_unlock(&s->workers->lock);
  if (s->due > 0 && !ends) gg_run_replicas_report_progress(s->all, false);
}

static gg_status work_off(gg_share *s, uint64_t due, bool adapt, gg_error *err)
{
  gg_replicas *all = s->all;
  double looked = gg_base_clock_wall();
  s->due = due, s->adapt = adapt, s->stopping = false;
  atomic_store(&all->pausing, false);
  pthread_mutex_lock(&s->workers->lock);
  for (int i = 0; i < all->n; i++) {
    s->piece[i].status = GG_OK;
    if (!all->replica[i].engine || all->replica[i].clock.samples < due) start(s, i);
  }
  pthread_mutex_unlock(&s->workers->lock);
  while (gg_run_share_is_busy(s)) attend(s, &looked);
  atomic_store(&all->pausing, false);
  return outcome(s, err);
}

gg_status gg_run_share_create(gg_share *s, gg_error *err)
{
  return work_off(s, 0, false, err);
}

gg_status gg_run_share_advance(gg_share *s, uint64_t due, bool adapt, gg_error *err)
{
  return work_off(s, due, adapt, err);
}

void gg_run_share_changed(gg_share *s)
{
  for (int i = 0; i < s->all->n; i++)
    if (s->piece[i].owner != 0) s->piece[i].still_there = false;
}

gg_replica_news gg_run_share_news(const gg_share *s, int i)
{
  const gg_piece *p = &s->piece[i];
  if (p->state == GG_HERE) return gg_run_job_news(&p->job);
  pthread_mutex_lock(&s->workers->lock);
  gg_replica_news news = p->news;
  pthread_mutex_unlock(&s->workers->lock);
  return news;
}

bool gg_run_share_is_busy(const gg_share *s)
{
  for (int i = 0; i < s->all->n; i++)
    if (s->piece[i].state != GG_IDLE) return true;
  return false;
}
