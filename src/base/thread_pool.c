/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/thread_pool.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"

#ifdef __APPLE__
#include <mach/mach.h>
#endif

enum { MOST_THREADS = GG_MOST_PARTS - 1 }; /* beside the caller: more would never have a part */
/* Number of polls for work before a thread sleeps, one or two hundred microseconds in all: longer than others need to
 * finish their part, or the caller between two jobs. With fewer processors than threads a thread polls once, since the
 * thread that it waits for may need this processor. */
enum { MOST_POLLS = 10000 };

typedef struct worker {
  gg_thread_pool *pool;
  int self;
  pthread_t thread;
} worker;

struct gg_thread_pool {
  /* Number of the job in the upper half; in the lower half a bit for each part that is not taken. A thread that clears
   * a bit may read the job, which remains until all its parts are done. */
  _Alignas(64) _Atomic uint64_t open;
  _Alignas(64) _Atomic int undone;
  _Atomic uint32_t finished; /* a bit for each part */
  _Alignas(64) gg_part *part;
  void *context;
  _Atomic int rounds, columns, asleep, quit;
  _Atomic uint32_t need[GG_MOST_PARTS]; /* what has to be done before each part */
  _Atomic int waiting;                  /* the caller sleeps until all is done */
  pthread_mutex_t mutex;
  pthread_cond_t work, done;
  int n, most_polls;
  unsigned jobs;
  gg_contention contention;
  worker workers[MOST_THREADS];
};

static void relax(void)
{
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ volatile("yield");
#endif
}

/* True: poll again. False: it is time to sleep. */
static bool keep_polling(const gg_thread_pool *pool, int polls)
{
  relax();
  return polls < pool->most_polls;
}

int gg_base_processors(void)
{
#ifdef __linux__
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
#else
  return (int)sysconf(_SC_NPROCESSORS_ONLN);
#endif
}

/* Affinity: the parts that thread `self` takes first, the same as in the job before, whose data its caches hold. */
static uint32_t preferred(const gg_thread_pool *pool, int self)
{
  const int columns = atomic_load_explicit(&pool->columns, memory_order_relaxed), n = pool->n + 1;
  const int rounds = atomic_load_explicit(&pool->rounds, memory_order_relaxed);
  const uint64_t one = (UINT64_C(1) << (self + 1) * columns / n) - (UINT64_C(1) << self * columns / n);
  uint64_t all = 0;
  for (int r = 0; r < rounds; r++) all |= one << r * columns;
  return (uint32_t)all;
}

/* The parts among these that need not wait for others. */
static uint32_t ready(const gg_thread_pool *pool, uint32_t parts)
{
  const uint32_t finished = atomic_load(&pool->finished);
  uint32_t those = 0;
  for (uint32_t left = parts; left; left &= left - 1) {
    const int k = __builtin_ctz(left);
    if (!(atomic_load_explicit(&pool->need[k], memory_order_relaxed) & ~finished)) those |= UINT32_C(1) << k;
  }
  return those;
}

/* A part to take, or -1: all that is left waits for somebody who is at it; or one of thread `self`'s own parts does,
 * and waiting for that is better than exchanging columns, and caches, with others: not for long, since they may be
 * asleep. */
static int choose(const gg_thread_pool *pool, int self, uint32_t open, int polls)
{
  const uint32_t mine = preferred(pool, self), can = ready(pool, open), own = can & mine;
  if (own) return __builtin_ctz(own);
  if (!can || (open & mine && polls < pool->most_polls / 4)) return -1;
  return 31 - __builtin_clz(can);
}

/* Before a bit is cleared, the job that is read may be the next one: then clearing the bit fails. */
static bool take_part(gg_thread_pool *pool, int self, int *part)
{
  uint64_t open = atomic_load(&pool->open);
  for (int polls = 0; (uint32_t)open;) {
    *part = choose(pool, self, (uint32_t)open, polls);
    if (*part >= 0) {
      if (atomic_compare_exchange_weak(&pool->open, &open, open & ~(UINT64_C(1) << *part))) return true;
      continue;
    }
    if (!keep_polling(pool, polls++)) sched_yield();
    open = atomic_load(&pool->open);
  }
  return false;
}

static void work_off(gg_thread_pool *pool, int self)
{
  for (int part; take_part(pool, self, &part);) {
    pool->part(pool->context, part);
    atomic_fetch_or(&pool->finished, UINT32_C(1) << part);
    if (atomic_fetch_sub(&pool->undone, 1) > 1 || !atomic_load(&pool->waiting)) continue;
    pthread_mutex_lock(&pool->mutex);
    pthread_cond_signal(&pool->done);
    pthread_mutex_unlock(&pool->mutex);
  }
}

static bool idle(gg_thread_pool *pool)
{
  return !(uint32_t)atomic_load(&pool->open) && !atomic_load(&pool->quit);
}

static void *run_worker(void *argument)
{
  const worker *me = argument;
  gg_thread_pool *pool = me->pool;
  while (!atomic_load(&pool->quit)) {
    work_off(pool, me->self);
    for (int polls = 0; idle(pool); polls++) {
      if (keep_polling(pool, polls)) continue;
      pthread_mutex_lock(&pool->mutex);
      atomic_fetch_add(&pool->asleep, 1);
      while (idle(pool)) pthread_cond_wait(&pool->work, &pool->mutex);
      atomic_fetch_sub(&pool->asleep, 1);
      pthread_mutex_unlock(&pool->mutex);
    }
  }
  return NULL;
}

gg_thread_pool *gg_base_thread_pool_new(int threads)
{
  if (threads < 2) return NULL;
  gg_thread_pool *pool = aligned_alloc(64, (sizeof *pool + 63) / 64 * 64);
  if (!pool) return NULL;
  *pool = (gg_thread_pool){.most_polls = gg_base_processors() < threads ? 0 : MOST_POLLS};
  pthread_mutex_init(&pool->mutex, NULL);
  pthread_cond_init(&pool->work, NULL);
  pthread_cond_init(&pool->done, NULL);
  int made = 0;
  pool->n = threads - 1 < MOST_THREADS ? threads - 1 : MOST_THREADS;
  for (; made < pool->n; made++) {
    worker *m = &pool->workers[made];
    *m = (worker){.pool = pool, .self = made + 1};
    if (pthread_create(&m->thread, NULL, run_worker, m) != 0) break;
  }
  if (made == pool->n) return pool;
  pool->n = made;
  gg_base_thread_pool_free(pool);
  return NULL;
}

static void wake(gg_thread_pool *pool)
{
  pthread_mutex_lock(&pool->mutex);
  pthread_cond_broadcast(&pool->work);
  pthread_mutex_unlock(&pool->mutex);
}

void gg_base_thread_pool_free(gg_thread_pool *pool)
{
  if (!pool) return;
  atomic_store(&pool->quit, 1);
  wake(pool);
  for (int i = 0; i < pool->n; i++) pthread_join(pool->workers[i].thread, NULL);
  pthread_mutex_destroy(&pool->mutex);
  pthread_cond_destroy(&pool->work);
  pthread_cond_destroy(&pool->done);
  free(pool);
}

static void wait_for_all(gg_thread_pool *pool)
{
  for (int polls = 0; atomic_load(&pool->undone) > 0; polls++) {
    if (keep_polling(pool, polls)) continue;
    pthread_mutex_lock(&pool->mutex);
    atomic_store(&pool->waiting, 1);
    while (atomic_load(&pool->undone) > 0) pthread_cond_wait(&pool->done, &pool->mutex);
    atomic_store(&pool->waiting, 0);
    pthread_mutex_unlock(&pool->mutex);
  }
}

/* Shared jobs of SPAN seconds decide. A caller that had less than ENOUGH of their wall time was displaced, or slept
 * since another thread was. Between two attempts that find contention, the pause doubles. */
#define SPAN 0.02
#define ENOUGH 0.75
#define FIRST_PAUSE 0.1
#define LONGEST_PAUSE 2

bool gg_base_contention_shares(const gg_contention *c, double now)
{
  return now >= c->until;
}

void gg_base_contention_learn(gg_contention *c, double now, double wall, double cpu)
{
  c->wall += wall, c->cpu += cpu;
  if (c->wall < SPAN) return;
  if (c->cpu < ENOUGH * c->wall) {
    c->pause = c->pause > 0 ? 2 * c->pause : FIRST_PAUSE;
    if (c->pause > LONGEST_PAUSE) c->pause = LONGEST_PAUSE;
    c->until = now + c->pause;
  } else
    c->pause = 0;
  c->wall = c->cpu = 0;
}

bool gg_base_thread_pool_is_contended(const gg_thread_pool *pool)
{
  return pool->contention.pause > 0 && !gg_base_contention_shares(&pool->contention, gg_base_clock_wall());
}

static void share(gg_thread_pool *pool, int parts)
{
  atomic_store(&pool->finished, 0);
  atomic_store(&pool->undone, parts);
  uint64_t job = (atomic_load(&pool->open) >> 32) + 1;
  atomic_store(&pool->open, job << 32 | ((UINT64_C(1) << parts) - 1));
  if (atomic_load(&pool->asleep)) wake(pool);
  work_off(pool, 0);
  wait_for_all(pool);
}

/* One job in so many is measured: reading the clock of CPU time takes a third of a microsecond. */
enum { JOBS_PER_MEASUREMENT = 4 };

void gg_base_thread_pool_rounds(gg_thread_pool *pool, int rounds, int columns, const uint32_t *need, gg_part *part,
                                void *context)
{
  const int parts = rounds * columns;
  const double began = pool ? gg_base_clock_wall() : 0;
  if (!pool || parts < 2 || parts > GG_MOST_PARTS || !gg_base_contention_shares(&pool->contention, began)) {
    for (int i = 0; i < parts; i++) part(context, i);
    return;
  }
  pool->part = part;
  pool->context = context;
  for (int i = 0; i < parts; i++) atomic_store_explicit(&pool->need[i], need ? need[i] : 0, memory_order_relaxed);
  atomic_store_explicit(&pool->rounds, rounds, memory_order_relaxed);
  atomic_store_explicit(&pool->columns, columns, memory_order_relaxed);
  const bool measured = pool->jobs++ % JOBS_PER_MEASUREMENT == 0;
  const double cpu = measured ? gg_base_clock_cpu() : 0;
  share(pool, parts);
  if (!measured) return;
  const double now = gg_base_clock_wall();
  gg_base_contention_learn(&pool->contention, now, now - began, gg_base_clock_cpu() - cpu);
}

void gg_base_thread_pool_for(gg_thread_pool *pool, int parts, gg_part *part, void *context)
{
  gg_base_thread_pool_rounds(pool, 1, parts, NULL, part, context);
}

/* Seconds of processor time that a thread has had. */
static double thread_cpu(pthread_t thread)
{
#ifdef __APPLE__
  thread_basic_info_data_t used;
  mach_msg_type_number_t count = THREAD_BASIC_INFO_COUNT;
  if (thread_info(pthread_mach_thread_np(thread), THREAD_BASIC_INFO, (thread_info_t)&used, &count) != KERN_SUCCESS)
    return 0;
  return used.user_time.seconds + used.system_time.seconds +
         1e-6 * (used.user_time.microseconds + used.system_time.microseconds);
#elif defined(__EMSCRIPTEN__) /* where there are no threads */
  (void)thread;
  return 0;
#else
  clockid_t clock;
  struct timespec t;
  if (pthread_getcpuclockid(thread, &clock) != 0 || clock_gettime(clock, &t) != 0) return 0;
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
#endif
}

double gg_base_thread_pool_cpu(const gg_thread_pool *pool)
{
  double sum = 0;
  for (int i = 0; pool && i < pool->n; i++) sum += thread_cpu(pool->workers[i].thread);
  return sum;
}
