/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between threads that stand for processes: what MPI is to the command. Any of them can be lost, as a process
 * that is killed: nobody hears of it any more. */
#ifndef MAILBOX_H
#define MAILBOX_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <time.h>

#include "api_test.h"

enum { MOST_RANKS = 70 };

typedef struct letter {
  int from;
  void *block;
  size_t size;
  struct letter *next;
} letter;

typedef struct mailbox {
  pthread_mutex_t lock;
  letter *first[MOST_RANKS]; /* what waits for each */
  bool lost[MOST_RANKS];
  int sent[MOST_RANKS];
  int die_at;      /* rank 1 is lost when it sends its so-many-th message; 0: it is not */
  double die_when; /* ... its first message from this time on */
  bool silent;     /* and nobody can see that it is gone */
  bool forges;     /* rank 1 says hello from another build */
  _Atomic int warned;
  char warning[300];
  gg_messages end[MOST_RANKS];
  struct desk {
    struct mailbox *mailbox;
    int rank;
  } desk[MOST_RANKS];
  pthread_t thread[MOST_RANKS];
  gg_status ended[MOST_RANKS];
} mailbox;

static inline double mailbox_seconds(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline void put(mailbox *p, int to, letter *new)
{
  letter **at = &p->first[to];
  while (*at) at = &(*at)->next;
  *at = new;
}

static inline int mailbox_send(void *context, int to, void *block, size_t size)
{
  struct desk *d = context;
  mailbox *p = d->mailbox;
  letter *new = calloc(1, sizeof *new);
  *new = (letter){d->rank, block, size, NULL};
  pthread_mutex_lock(&p->lock);
  p->sent[d->rank]++;
  if (p->forges && d->rank == 1 && p->sent[1] == 1)
    for (size_t i = 0; i + strlen(gg_version()) <= size; i++)
      if (memcmp((char *)block + i, gg_version(), strlen(gg_version())) == 0) ((char *)block)[i] = '?';
  if (d->rank == 1 && p->die_at && p->sent[1] >= p->die_at) p->lost[1] = true;
  if (d->rank == 1 && p->die_when > 0 && mailbox_seconds() >= p->die_when) p->lost[1] = true;
  bool gone = p->lost[to] || p->lost[d->rank];
  if (!gone) put(p, to, new);
  pthread_mutex_unlock(&p->lock);
  if (gone) free(block), free(new);
  return 0; /* as MPI: the sender does not know */
}

static inline int mailbox_receive(void *context, int *from, void **block, size_t *size)
{
  struct desk *d = context;
  mailbox *p = d->mailbox;
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

static inline int mailbox_lost(void *context, int rank)
{
  struct desk *d = context;
  pthread_mutex_lock(&d->mailbox->lock);
  bool lost = d->mailbox->lost[rank] && !d->mailbox->silent;
  pthread_mutex_unlock(&d->mailbox->lock);
  return lost;
}

static inline void mailbox_warn(void *context, const char *message)
{
  struct desk *d = context;
  snprintf(d->mailbox->warning, sizeof d->mailbox->warning, "%s", message);
  atomic_fetch_add(&d->mailbox->warned, 1);
}

static inline void *mailbox_work(void *argument)
{
  struct desk *d = argument;
  gg_error err;
  d->mailbox->ended[d->rank] = gg_worker_run(&d->mailbox->end[d->rank], &err);
  return NULL;
}

/* So many processes, of which this thread is rank 0. */
static inline void mailbox_open(mailbox *p, int ranks)
{
  pthread_mutex_init(&p->lock, NULL);
  for (int i = 0; i < ranks; i++) {
    p->desk[i] = (struct desk){p, i};
    p->end[i] = (gg_messages){i, ranks, &p->desk[i], mailbox_send, mailbox_receive, mailbox_lost, mailbox_warn};
  }
  for (int i = 1; i < ranks; i++) assert_int_equal(pthread_create(&p->thread[i], NULL, mailbox_work, &p->desk[i]), 0);
}

/* After the workers were freed: everybody has gone home. */
static inline void mailbox_close(mailbox *p, int ranks)
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
