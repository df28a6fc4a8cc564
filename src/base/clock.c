/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/clock.h"

#include <time.h>

static double read_clock(clockid_t id)
{
  struct timespec t;
  clock_gettime(id, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double gg_base_clock_wall(void)
{
  return read_clock(CLOCK_MONOTONIC);
}

#ifdef __APPLE__ /* has no conditions of another clock */
static const clockid_t waited_by = CLOCK_REALTIME;
#else
static const clockid_t waited_by = CLOCK_MONOTONIC;
#endif

void gg_base_condition_init(pthread_cond_t *news)
{
  pthread_condattr_t kind;
  pthread_condattr_init(&kind);
#ifndef __APPLE__
  pthread_condattr_setclock(&kind, waited_by);
#endif
  pthread_cond_init(news, &kind);
  pthread_condattr_destroy(&kind);
}

void gg_base_condition_wait(pthread_cond_t *news, pthread_mutex_t *lock, double seconds)
{
  struct timespec until;
  clock_gettime(waited_by, &until);
  until.tv_nsec += (long)(1e9 * seconds);
  if (until.tv_nsec >= 1000000000) until.tv_sec++, until.tv_nsec -= 1000000000;
  pthread_cond_timedwait(news, lock, &until);
}

pthread_mutex_t *gg_base_locked(pthread_mutex_t *mutex)
{
  return pthread_mutex_lock(mutex), mutex;
}

void gg_base_unlocked(pthread_mutex_t *const *mutex)
{
  pthread_mutex_unlock(*mutex);
}

double gg_base_clock_cpu(void)
{
  return read_clock(CLOCK_THREAD_CPUTIME_ID);
}
