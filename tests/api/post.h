/* Messages between threads that stand for processes: what MPI is to the command. Any of them can be lost, as a process
 * that is killed: nobody hears of it any more. */
#ifndef POST_H
#define POST_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

#include "door_test.h"

enum { MOST_RANKS = 70 };

typedef struct letter {
  int from;
  void *block;
  size_t size;
  struct letter *next;
} letter;

typedef struct post {
  pthread_mutex_t lock;
  letter *first[MOST_RANKS]; /* what waits for each */
  bool lost[MOST_RANKS];
  int sent[MOST_RANKS];
  int die_at;  /* rank 1 is lost when it sends its so-many-th message; 0: it is not */
  bool silent; /* and nobody can see that it is gone */
  bool forges; /* rank 1 says hello from another build */
  _Atomic int warned;
  char warning[300];
  gg_messages end[MOST_RANKS];
  struct desk {
    struct post *post;
    int rank;
  } desk[MOST_RANKS];
  pthread_t thread[MOST_RANKS];
  gg_status ended[MOST_RANKS];
} post;

static inline void put(post *p, int to, letter *new)
{
  letter **at = &p->first[to];
  while (*at) at = &(*at)->next;
  *at = new;
}

static inline int post_send(void *context, int to, void *block, size_t size)
{
  struct desk *d = context;
  post *p = d->post;
  letter *new = calloc(1, sizeof *new);
  *new = (letter){d->rank, block, size, NULL};
  pthread_mutex_lock(&p->lock);
  p->sent[d->rank]++;
  if (p->forges && d->rank == 1 && p->sent[1] == 1)
    for (size_t i = 0; i + strlen(gg_version()) <= size; i++)
      if (memcmp((char *)block + i, gg_version(), strlen(gg_version())) == 0) ((char *)block)[i] = '?';
  if (d->rank == 1 && p->die_at && p->sent[1] >= p->die_at) p->lost[1] = true;
  bool gone = p->lost[to] || p->lost[d->rank];
  if (!gone) put(p, to, new);
  pthread_mutex_unlock(&p->lock);
  if (gone) free(block), free(new);
  return 0; /* as MPI: the sender does not know */
}

static inline int post_receive(void *context, int *from, void **block, size_t *size)
{
  struct desk *d = context;
  post *p = d->post;
  pthread_mutex_lock(&p->lock);
  bool lost = p->lost[d->rank];
  letter *l = p->first[d->rank];
  if (l && !lost) p->first[d->rank] = l->next;
  pthread_mutex_unlock(&p->lock);
  if (lost) return -1;
  if (!l) return 0;
  *from = l->from, *block = l->block, *size = l->size;
  free(l);
  return 1;
}

static inline int post_lost(void *context, int rank)
{
  struct desk *d = context;
  pthread_mutex_lock(&d->post->lock);
  bool lost = d->post->lost[rank] && !d->post->silent;
  pthread_mutex_unlock(&d->post->lock);
  return lost;
}

static inline void post_warn(void *context, const char *message)
{
  struct desk *d = context;
  snprintf(d->post->warning, sizeof d->post->warning, "%s", message);
  atomic_fetch_add(&d->post->warned, 1);
}

static inline void *post_work(void *argument)
{
  struct desk *d = argument;
  gg_error err;
  d->post->ended[d->rank] = gg_worker_run(&d->post->end[d->rank], &err);
  return NULL;
}

/* So many processes, of which this thread is rank 0. */
static inline void post_open(post *p, int ranks)
{
  pthread_mutex_init(&p->lock, NULL);
  for (int i = 0; i < ranks; i++) {
    p->desk[i] = (struct desk){p, i};
    p->end[i] = (gg_messages){i, ranks, &p->desk[i], post_send, post_receive, post_lost, post_warn};
  }
  for (int i = 1; i < ranks; i++) assert_int_equal(pthread_create(&p->thread[i], NULL, post_work, &p->desk[i]), 0);
}

/* After the workers were freed: everybody has gone home. */
static inline void post_close(post *p, int ranks)
{
  for (int i = 1; i < ranks; i++) {
    assert_int_equal(pthread_join(p->thread[i], NULL), 0);
    assert_int_equal(p->ended[i], p->lost[i] ? GG_FAILED : GG_OK);
  }
  for (int i = 0; i < ranks; i++)
    for (letter *l; (l = p->first[i]);) {
      p->first[i] = l->next;
      free(l->block), free(l);
    }
  pthread_mutex_destroy(&p->lock);
}

#endif
