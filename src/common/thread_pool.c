#include "common/thread_pool.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#ifdef __APPLE__
#include <mach/mach.h>
#endif

enum { MOST_THREADS = 64 };
/* Looks at an empty list before a thread sleeps, a hundred microseconds or two in all: longer than others need to
 * finish what they are at, or than the caller needs between two jobs. Where processors are fewer than threads nobody
 * looks twice: whom he waits for may wait for his processor. */
enum { LOOKS = 10000 };

typedef struct gg_member {
  gg_thread_pool *pool;
  int self;
  pthread_t thread;
} gg_member;

struct gg_thread_pool {
  /* Number of the job in the upper half; in the lower one a bit for each part that nobody has taken. Whoever succeeds
   * in clearing a bit may read the job, which stays until all its parts are done. */
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
  int n, looks;
  gg_member member[MOST_THREADS];
};

static void relax(void)
{
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ volatile("yield");
#endif
}

/* Something may have come: look again. False: it is time to sleep. */
static bool patient(const gg_thread_pool *c, int looks)
{
  relax();
  return looks < c->looks;
}

static int processors(void)
{
#ifdef __linux__
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
#else
  return (int)sysconf(_SC_NPROCESSORS_ONLN);
#endif
}

/* The parts that thread `self` takes first, so that it has what it had in the job before: its caches know. */
static uint32_t home(const gg_thread_pool *c, int self)
{
  const int columns = atomic_load_explicit(&c->columns, memory_order_relaxed), n = c->n + 1;
  const int rounds = atomic_load_explicit(&c->rounds, memory_order_relaxed);
  const uint64_t one = (UINT64_C(1) << (self + 1) * columns / n) - (UINT64_C(1) << self * columns / n);
  uint64_t all = 0;
  for (int r = 0; r < rounds; r++) all |= one << r * columns;
  return (uint32_t)all;
}

/* Of these parts those that need not wait for others. */
static uint32_t ready(const gg_thread_pool *c, uint32_t parts)
{
  const uint32_t finished = atomic_load(&c->finished);
  uint32_t those = 0;
  for (uint32_t left = parts; left; left &= left - 1) {
    const int k = __builtin_ctz(left);
    if (!(atomic_load_explicit(&c->need[k], memory_order_relaxed) & ~finished)) those |= UINT32_C(1) << k;
  }
  return those;
}

/* A part to take, or -1: all that is left waits for somebody who is at it; or what thread `self` has at home does,
 * which is better waited for than to change columns, and caches, with others: not for long, since they may be asleep.
 */
static int choose(const gg_thread_pool *c, int self, uint32_t open, int looks)
{
  const uint32_t at_home = home(c, self), can = ready(c, open), own = can & at_home;
  if (own) return __builtin_ctz(own);
  if (!can || (open & at_home && looks < c->looks / 4)) return -1;
  return 31 - __builtin_clz(can);
}

/* What is read of the job before a bit has been cleared may be of the next: then the bit cannot be cleared. */
static bool take(gg_thread_pool *c, int self, int *part)
{
  uint64_t seen = atomic_load(&c->open);
  for (int looks = 0; (uint32_t)seen;) {
    *part = choose(c, self, (uint32_t)seen, looks);
    if (*part >= 0) {
      if (atomic_compare_exchange_weak(&c->open, &seen, seen & ~(UINT64_C(1) << *part))) return true;
      continue;
    }
    if (!patient(c, looks++)) sched_yield();
    seen = atomic_load(&c->open);
  }
  return false;
}

static void work_off(gg_thread_pool *c, int self)
{
  for (int part; take(c, self, &part);) {
    c->part(c->context, part);
    atomic_fetch_or(&c->finished, UINT32_C(1) << part);
    if (atomic_fetch_sub(&c->undone, 1) > 1 || !atomic_load(&c->waiting)) continue;
    pthread_mutex_lock(&c->mutex);
    pthread_cond_signal(&c->done);
    pthread_mutex_unlock(&c->mutex);
  }
}

static bool idle(gg_thread_pool *c)
{
  return !(uint32_t)atomic_load(&c->open) && !atomic_load(&c->quit);
}

static void *live(void *argument)
{
  const gg_member *me = argument;
  gg_thread_pool *c = me->pool;
  while (!atomic_load(&c->quit)) {
    work_off(c, me->self);
    for (int looks = 0; idle(c); looks++) {
      if (patient(c, looks)) continue;
      pthread_mutex_lock(&c->mutex);
      atomic_fetch_add(&c->asleep, 1);
      while (idle(c)) pthread_cond_wait(&c->work, &c->mutex);
      atomic_fetch_sub(&c->asleep, 1);
      pthread_mutex_unlock(&c->mutex);
    }
  }
  return NULL;
}

gg_thread_pool *gg_thread_pool_new(int threads)
{
  if (threads < 2) return NULL;
  gg_thread_pool *c = aligned_alloc(64, (sizeof *c + 63) / 64 * 64);
  if (!c) return NULL;
  *c = (gg_thread_pool){.looks = processors() < threads ? 0 : LOOKS};
  pthread_mutex_init(&c->mutex, NULL);
  pthread_cond_init(&c->work, NULL);
  pthread_cond_init(&c->done, NULL);
  int made = 0;
  c->n = threads - 1 < MOST_THREADS ? threads - 1 : MOST_THREADS;
  for (; made < c->n; made++) {
    gg_member *m = &c->member[made];
    *m = (gg_member){.pool = c, .self = made + 1};
    if (pthread_create(&m->thread, NULL, live, m) != 0) break;
  }
  if (made == c->n) return c;
  c->n = made;
  gg_thread_pool_free(c);
  return NULL;
}

static void wake(gg_thread_pool *c)
{
  pthread_mutex_lock(&c->mutex);
  pthread_cond_broadcast(&c->work);
  pthread_mutex_unlock(&c->mutex);
}

void gg_thread_pool_free(gg_thread_pool *c)
{
  if (!c) return;
  atomic_store(&c->quit, 1);
  wake(c);
  for (int i = 0; i < c->n; i++) pthread_join(c->member[i].thread, NULL);
  pthread_mutex_destroy(&c->mutex);
  pthread_cond_destroy(&c->work);
  pthread_cond_destroy(&c->done);
  free(c);
}

static void wait_for_all(gg_thread_pool *c)
{
  for (int looks = 0; atomic_load(&c->undone) > 0; looks++) {
    if (patient(c, looks)) continue;
    pthread_mutex_lock(&c->mutex);
    atomic_store(&c->waiting, 1);
    while (atomic_load(&c->undone) > 0) pthread_cond_wait(&c->done, &c->mutex);
    atomic_store(&c->waiting, 0);
    pthread_mutex_unlock(&c->mutex);
  }
}

void gg_thread_pool_rounds(gg_thread_pool *c, int rounds, int columns, const uint32_t *need, gg_part *part,
                           void *context)
{
  const int parts = rounds * columns;
  if (!c || parts < 2 || parts > GG_MOST_PARTS) {
    for (int i = 0; i < parts; i++) part(context, i);
    return;
  }
  c->part = part;
  c->context = context;
  for (int i = 0; i < parts; i++) atomic_store_explicit(&c->need[i], need ? need[i] : 0, memory_order_relaxed);
  atomic_store_explicit(&c->rounds, rounds, memory_order_relaxed);
  atomic_store_explicit(&c->columns, columns, memory_order_relaxed);
  atomic_store(&c->finished, 0);
  atomic_store(&c->undone, parts);
  uint64_t job = (atomic_load(&c->open) >> 32) + 1;
  atomic_store(&c->open, job << 32 | ((UINT64_C(1) << parts) - 1));
  if (atomic_load(&c->asleep)) wake(c);
  work_off(c, 0);
  wait_for_all(c);
}

void gg_thread_pool_for(gg_thread_pool *c, int parts, gg_part *part, void *context)
{
  gg_thread_pool_rounds(c, 1, parts, NULL, part, context);
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
#else
  clockid_t clock;
  struct timespec t;
  if (pthread_getcpuclockid(thread, &clock) != 0 || clock_gettime(clock, &t) != 0) return 0;
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
#endif
}

double gg_thread_pool_cpu(const gg_thread_pool *c)
{
  double sum = 0;
  for (int i = 0; c && i < c->n; i++) sum += thread_cpu(c->member[i].thread);
  return sum;
}
