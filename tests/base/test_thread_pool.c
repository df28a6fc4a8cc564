/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A thread pool does every part of a job once and returns when all are done: many short jobs in a row, jobs after a
 * pause (the others sleep), more threads than processors, and jobs that one part holds up. Parts that have to wait for
 * others do.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdatomic.h>
#include <time.h>

#include "base/thread_pool.h"

enum { PARTS = GG_MOST_PARTS + 4 }; /* the last few are not shared */

typedef struct job {
  int done[PARTS];      /* by each part; no atomics: the end of a job is what makes it seen */
  _Atomic int together; /* parts being done at once */
  long pause;           /* nanoseconds */
} job;

static void part(void *context, int part)
{
  job *j = context;
  if (j->pause) nanosleep(&(struct timespec){0, j->pause}, NULL);
  j->done[part]++;
}

static void share(gg_thread_pool *pool, job *j, int parts, int times)
{
  *j = (job){.pause = j->pause};
  for (int i = 0; i < times; i++) {
    gg_base_thread_pool_for(pool, parts, part, j);
    for (int p = 0; p < PARTS; p++) assert_int_equal(j->done[p], p < parts ? i + 1 : 0);
  }
}

static void every_part_once(void **state)
{
  (void)state;
  const int threads[] = {1, 2, 3, 8};
  for (int t = 0; t < 4; t++) {
    gg_thread_pool *pool = gg_base_thread_pool_new(threads[t]);
    assert_true((pool != NULL) == (threads[t] > 1));
    job j = {.pause = 0};
    for (int parts = 0; parts <= PARTS; parts++) share(pool, &j, parts, 1000);
    for (int i = 0; i < 5; i++) {
      nanosleep(&(struct timespec){0, 5000000}, NULL);
      share(pool, &j, 12, 20);
    }
    j.pause = 1000000; /* longer than the caller's patience */
    share(pool, &j, 12, 3);
    gg_base_thread_pool_free(pool);
  }
}

/* Two parts that wait for each other end only if they are done at once. */
static void meet(void *context, int part)
{
  job *j = context;
  (void)part;
  atomic_fetch_add(&j->together, 1);
  while (atomic_load(&j->together) < 2) nanosleep(&(struct timespec){0, 100000}, NULL);
}

static void at_once(void **state)
{
  (void)state;
  gg_thread_pool *pool = gg_base_thread_pool_new(2);
  job j = {.pause = 0};
  gg_base_thread_pool_for(pool, 2, meet, &j);
  assert_int_equal(j.together, 2);
  double before = gg_base_thread_pool_cpu(pool);
  for (int i = 0; i < 20000; i++) gg_base_thread_pool_for(pool, 2, part, &j);
  assert_true(gg_base_thread_pool_cpu(pool) >= before);
  assert_true(gg_base_thread_pool_cpu(NULL) == 0);
  gg_base_thread_pool_free(pool);
  gg_base_thread_pool_free(NULL);
}

/* Rounds of columns, in which each part needs its own column and the next of the round before. */
typedef struct tour {
  uint32_t need[GG_MOST_PARTS];
  _Atomic uint32_t done;
  _Atomic int early; /* parts that did not wait */
  int slow;          /* column that takes its time; -1: none */
  int columns;
} tour;

static void part_of_tour(void *context, int part)
{
  tour *t = context;
  if (t->need[part] & ~atomic_load(&t->done)) atomic_fetch_add(&t->early, 1);
  if (part % t->columns == t->slow) nanosleep(&(struct timespec){0, 200000}, NULL);
  if (atomic_fetch_or(&t->done, UINT32_C(1) << part) >> part & 1) atomic_fetch_add(&t->early, 1);
}

static void play_tour(gg_thread_pool *pool, int rounds, int columns, int slow)
{
  tour t = {.slow = slow, .columns = columns};
  for (int p = columns; p < rounds * columns; p++) {
    const int before = (p / columns - 1) * columns, column = p % columns;
    t.need[p] = UINT32_C(1) << (before + column) | UINT32_C(1) << (before + (column + 1) % columns);
  }
  gg_base_thread_pool_rounds(pool, rounds, columns, t.need, part_of_tour, &t);
  assert_int_equal(t.done, (UINT64_C(1) << rounds * columns) - 1);
  assert_int_equal(t.early, 0);
}

static void rounds_in_order(void **state)
{
  (void)state;
  const int threads[] = {1, 2, 3, 8};
  for (int t = 0; t < 4; t++) {
    gg_thread_pool *pool = gg_base_thread_pool_new(threads[t]);
    for (int columns = 1; columns <= 8; columns++)
      for (int k = 0; k < 500; k++) play_tour(pool, 1 + k % (GG_MOST_PARTS / columns), columns, -1);
    for (int slow = 0; slow < 4; slow++) play_tour(pool, 8, 4, slow);
    gg_base_thread_pool_free(pool);
  }
}

/* Shared jobs of 10 ms each, in which the caller has this fraction of the time, up to wall time `end`. Returns the
 * number of jobs that were shared. */
static int jobs_until(gg_contention *c, double *now, double end, double fraction)
{
  int shared = 0;
  for (; *now < end; *now += 0.01) {
    if (!gg_base_contention_shares(c, *now)) continue;
    shared++;
    gg_base_contention_learn(c, *now + 0.01, 0.01, 0.01 * fraction);
  }
  return shared;
}

/* Under contention two jobs of 10 ms decide, and the pauses are 0.1, 0.2, 0.4, 0.8, 1.6, 2, 2 ... seconds. */
static void a_pool_under_contention_seldom_shares(void **state)
{
  (void)state;
  gg_contention c = {0};
  double now = 0;
  assert_int_equal(jobs_until(&c, &now, 0.995, 1), 100);
  assert_int_equal(jobs_until(&c, &now, 101, 0.6), 2 * (5 + 48));
  /* The processors are free again: after the pause everything is shared, and the next pause is short. */
  assert_in_range(jobs_until(&c, &now, 111, 0.9), 790, 1000);
  assert_int_equal(jobs_until(&c, &now, 111.1, 0.6), 2);
  assert_true(c.pause < 0.11);
}

/* One slow job among many fast ones stops nothing. */
static void a_single_slow_job_does_not_count(void **state)
{
  (void)state;
  gg_contention c = {0};
  for (int k = 0; k < 1000; k++) gg_base_contention_learn(&c, k * 1e-3, 1e-3, k % 10 ? 1e-3 : 0);
  assert_true(gg_base_contention_shares(&c, 1));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_part_once), cmocka_unit_test(at_once), cmocka_unit_test(rounds_in_order),
      cmocka_unit_test(a_pool_under_contention_seldom_shares), cmocka_unit_test(a_single_slow_job_does_not_count)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
