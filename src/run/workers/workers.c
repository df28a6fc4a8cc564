#include "run/workers/workers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "run/workers/pool.h"

/* Seconds: the longest silence of one that works, which sends news twice a second; until all have said hello. */
static const double longest_silence = 60, longest_wait = 30, look_every = 0.5;

static void warn(const gg_workers *w, const char *text)
{
  if (w->messages.warn) w->messages.warn(w->messages.context, text);
}

void gg_workers_send(gg_workers *w, int to, void *block, size_t size)
{
  if (block && w->messages.send(w->messages.context, to, block, size) != 0) w->rank[to].cut_off = true;
}

static void lose(gg_workers *w, int rank, const char *why)
{
  char text[200];
  if (w->rank[rank].lost) return;
  w->rank[rank].lost = true;
  snprintf(text, sizeof text, "process %d of %d %s; what it had is done again by the others", rank, w->messages.size,
           why);
  warn(w, text);
  for (gg_share *s = w->shares; s; s = s->next) gg_run_share_lose(s, rank);
}

static void greet(gg_workers *w, int from, const gg_message *hello)
{
  char mine[sizeof hello->error.message];
  gg_run_message_build(mine, sizeof mine);
  if (strcmp(mine, hello->error.message) != 0) {
    lose(w, from, "is another build of graingas");
    return;
  }
  w->rank[from].there = true;
}

static gg_share *find(gg_workers *w, const gg_message *m, int from)
{
  for (gg_share *s = w->shares; s; s = s->next) {
    if (s->run != m->run || m->replica < 0 || m->replica >= s->all->n) continue;
    gg_piece *p = &s->piece[m->replica];
    return p->state == GG_SENT && p->owner == from && p->number == m->piece ? s : NULL;
  }
  return NULL; /* late news of a run that is over */
}

/* Keeps the block where it is a piece of work that came back. */
static void *take(gg_workers *w, int from, void *block, size_t size)
{
  gg_message m;
  if (!gg_run_message_read(block, size, &m)) return block;
  w->rank[from].heard = gg_base_clock_wall();
  if (m.kind == GG_HELLO) greet(w, from, &m);
  gg_share *s = find(w, &m, from);
  if (!s || (m.kind != GG_NEWS && m.kind != GG_DONE)) return block;
  gg_piece *p = &s->piece[m.replica];
  p->news = m.news;
  if (m.kind == GG_NEWS) return block;
  w->rank[from].pieces--;
  p->status = (gg_status)m.status, p->err = m.error;
  p->block = block, p->size = size;
  p->state = GG_BACK; /* from here on it is the run's own thread's */
  pthread_cond_signal(&s->news);
  return NULL;
}

static void look_who_is_lost(gg_workers *w)
{
  double now = gg_base_clock_wall();
  if (now < w->looked + look_every) return;
  w->looked = now;
  for (int i = 1; i < w->messages.size; i++) {
    gg_rank *r = &w->rank[i];
    if (r->lost) continue;
    if (w->messages.lost && w->messages.lost(w->messages.context, i))
      lose(w, i, "is gone");
    else if (r->cut_off || (r->pieces && now > r->heard + longest_silence))
      lose(w, i, "does not answer");
  }
}

bool gg_workers_attend(gg_workers *w)
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
  look_who_is_lost(w);
  return any;
}

int gg_workers_least(const gg_workers *w)
{
  int least = 0;
  for (int i = 1; i < w->messages.size; i++) {
    const gg_rank *r = &w->rank[i];
    if (r->there && !r->lost && r->replicas < w->rank[least].replicas) least = i;
  }
  return least;
}

/* Everybody comes at about the same time; who is late is given work when there is more. */
static void wait_for_all(gg_workers *w)
{
  double until = gg_base_clock_wall() + longest_wait;
  for (int missing = 1; missing && gg_base_clock_wall() < until;) {
    gg_workers_attend(w);
    missing = 0;
    for (int i = 1; i < w->messages.size; i++) missing += !w->rank[i].there && !w->rank[i].lost;
    if (missing) usleep(200);
  }
}

int gg_workers_threads(const gg_workers *w)
{
  int threads = 0;
  for (int i = 0; w && i < w->messages.size; i++) threads += w->rank[i].there && !w->rank[i].lost ? w->threads : 0;
  return threads;
}

gg_status gg_workers_new(const gg_messages *messages, int threads, gg_workers **workers, gg_error *err)
{
  if (!messages || !workers || !messages->send || !messages->receive || messages->rank != 0 || messages->size < 1)
    return gg_base_fail(err, GG_BAD_INPUT, "gg_workers_new: messages of rank 0, with send and receive, are needed");
  gg_workers *w = gg_base_array_new(1, sizeof *w, err);
  if (!w) return GG_FAILED;
  w->messages = *messages;
  w->threads = threads > 1 ? threads : 1;
  w->rank = gg_base_array_new((size_t)messages->size, sizeof *w->rank, err);
  if (!w->rank) {
    free(w);
    return GG_FAILED;
  }
  w->rank[0].there = true;
  pthread_mutex_init(&w->lock, NULL);
  gg_run_gate_init(&w->gate, w->threads);
  wait_for_all(w);
  *workers = w;
  return GG_OK;
}

void gg_workers_free(gg_workers *w)
{
  if (!w) return;
  for (int i = 1; i < w->messages.size; i++) {
    size_t size;
    void *block = gg_run_message_pack(&(gg_message){.kind = GG_LEAVE}, NULL, 0, &size);
    if (block) w->messages.send(w->messages.context, i, block, size);
  }
  gg_run_gate_clear(&w->gate);
  pthread_mutex_destroy(&w->lock);
  free(w->rank);
  free(w);
}
