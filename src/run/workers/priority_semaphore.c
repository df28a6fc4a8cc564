#include "run/workers/priority_semaphore.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct gg_waiting {
  double urgency;
  bool may_go;
  pthread_cond_t go;
  struct gg_waiting *next;
} waiting;

void gg_run_gate_init(gg_gate *g, int processors)
{
  *g = (gg_gate){.free = processors};
  pthread_mutex_init(&g->lock, NULL);
}

void gg_run_gate_clear(gg_gate *g)
{
  pthread_mutex_destroy(&g->lock);
}

/* Behind all that are as urgent. */
static void queue_up(gg_gate *g, waiting *w)
{
  waiting **at = &g->first;
  while (*at && (*at)->urgency >= w->urgency) at = &(*at)->next;
  w->next = *at, *at = w;
}

void gg_run_gate_enter(gg_gate *g, double urgency)
{
  pthread_mutex_lock(&g->lock);
  if (g->free > 0) {
    g->free--;
  } else {
    waiting w = {.urgency = urgency, .go = PTHREAD_COND_INITIALIZER};
    queue_up(g, &w);
    while (!w.may_go) pthread_cond_wait(&w.go, &g->lock);
    pthread_cond_destroy(&w.go);
  }
  pthread_mutex_unlock(&g->lock);
}

/* The processor passes to the next. */
void gg_run_gate_leave(gg_gate *g)
{
  pthread_mutex_lock(&g->lock);
  waiting *next = g->first;
  if (next) {
    g->first = next->next;
    next->may_go = true;
    pthread_cond_signal(&next->go);
  } else {
    g->free++;
  }
  pthread_mutex_unlock(&g->lock);
}
