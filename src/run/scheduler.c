#include "run/scheduler.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "base/memory.h"

/* One replica's part of what a course waits for. */
typedef struct piece {
  struct errand *errand;
  gg_replica *replica;
  gg_status status;
  gg_error err;
  struct piece *next; /* that waits, too */
} piece;

typedef struct errand { /* what a course waits for */
  uint64_t due;
  bool adapt;
  const gg_hooks *hooks;
  double urgency;
  int left;
  pthread_cond_t done;
} errand;

struct gg_crew {
  pthread_mutex_t lock;
  pthread_cond_t work, slot; /* a piece waits or all is over; a course may go on */
  int free, waiting;         /* threads that are not busy; courses that want to be */
  piece *pieces;             /* in the order of their coming */
  bool over;
  int n;
  pthread_t *thread;
};

/* The one of the largest error; among equals the first. */
static piece *take(gg_crew *c)
{
  piece **best = &c->pieces;
  for (piece **p = &c->pieces; *p; p = &(*p)->next)
    if ((*p)->errand->urgency > (*best)->errand->urgency) best = p;
  piece *taken = *best;
  *best = taken->next;
  return taken;
}

/* A thread is free again: for a course, which has little to do and others wait for, else for the next piece. */
static void release(gg_crew *c)
{
  c->free++;
  pthread_cond_signal(c->waiting ? &c->slot : &c->work);
}

static void seize(gg_crew *c)
{
  c->waiting++;
  while (c->free == 0) pthread_cond_wait(&c->slot, &c->lock);
  c->waiting--;
  c->free--;
  if (c->free) pthread_cond_signal(c->waiting ? &c->slot : &c->work);
}

static void work_on(gg_crew *c, piece *p)
{
  errand *e = p->errand;
  c->free--;
  if (c->free && c->pieces) pthread_cond_signal(&c->work);
  pthread_mutex_unlock(&c->lock);
  p->status = gg_run_replica_advance(p->replica, e->due, e->adapt, e->hooks, &p->err);
  pthread_mutex_lock(&c->lock);
  if (--e->left == 0) pthread_cond_signal(&e->done);
  release(c);
}

static void *serve(void *crew)
{
  gg_crew *c = crew;
  pthread_mutex_lock(&c->lock);
  while (!c->over)
    if (c->pieces && c->free && !c->waiting)
      work_on(c, take(c));
    else
      pthread_cond_wait(&c->work, &c->lock);
  pthread_mutex_unlock(&c->lock);
  return NULL;
}

gg_status gg_run_crew_new(int threads, gg_crew **crew, gg_error *err)
{
  gg_crew *c = gg_base_array_new(1, sizeof *c, err);
  if (!c) return GG_FAILED;
  pthread_mutex_init(&c->lock, NULL);
  pthread_cond_init(&c->work, NULL);
  pthread_cond_init(&c->slot, NULL);
  c->free = threads;
  c->thread = gg_base_array_new((size_t)threads, sizeof *c->thread, err);
  while (c->thread && c->n < threads && pthread_create(&c->thread[c->n], NULL, serve, c) == 0) c->n++;
  if (c->n == 0) {
    if (c->thread) gg_base_fail(err, GG_FAILED, "no thread could be started");
    gg_run_crew_free(c);
    return GG_FAILED;
  }
  *crew = c;
  return GG_OK;
}

void gg_run_crew_free(gg_crew *c)
{
  if (!c) return;
  pthread_mutex_lock(&c->lock);
  c->over = true;
  pthread_cond_broadcast(&c->work);
  pthread_mutex_unlock(&c->lock);
  for (int i = 0; i < c->n; i++) pthread_join(c->thread[i], NULL);
  pthread_mutex_destroy(&c->lock);
  pthread_cond_destroy(&c->work);
  pthread_cond_destroy(&c->slot);
  free(c->thread);
  free(c);
}

void gg_run_crew_enter(gg_crew *c)
{
  pthread_mutex_lock(&c->lock);
  seize(c);
  pthread_mutex_unlock(&c->lock);
}

void gg_run_crew_leave(gg_crew *c)
{
  pthread_mutex_lock(&c->lock);
  release(c);
  pthread_mutex_unlock(&c->lock);
}

void gg_run_crew_pause(gg_crew *c)
{
  if (c) gg_run_crew_leave(c);
}

void gg_run_crew_go_on(gg_crew *c)
{
  if (c) gg_run_crew_enter(c);
}

static void hand_over(gg_crew *c, errand *e, piece *pieces)
{
  pthread_mutex_lock(&c->lock);
  piece **end = &c->pieces;
  while (*end) end = &(*end)->next;
  for (int i = 0; i < e->left; i++) {
    *end = &pieces[i];
    end = &pieces[i].next;
  }
  release(c);
  pthread_cond_signal(&c->work);
  while (e->left) pthread_cond_wait(&e->done, &c->lock);
  seize(c);
  pthread_mutex_unlock(&c->lock);
}

gg_status gg_run_crew_advance(gg_crew *c, gg_replicas *all, uint64_t due, bool adapt, const gg_hooks *hooks,
                              gg_error *err)
{
  const double error = all->last.relative_error;
  piece *pieces = gg_base_array_new((size_t)all->n, sizeof *pieces, err);
  if (!pieces) return GG_FAILED;
  errand e = {due, adapt, hooks, isnan(error) ? INFINITY : error, all->n, PTHREAD_COND_INITIALIZER};
  for (int i = 0; i < all->n; i++) pieces[i] = (piece){.errand = &e, .replica = &all->replica[i]};
  hand_over(c, &e, pieces);
  pthread_cond_destroy(&e.done);
  gg_status status = GG_OK;
  for (int i = 0; i < all->n && status == GG_OK; i++)
    if ((status = pieces[i].status) != GG_OK && err) *err = pieces[i].err;
  free(pieces);
  return status;
}
