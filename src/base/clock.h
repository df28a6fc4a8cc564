/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clocks, in seconds: monotonic wall-clock time, and CPU time of the calling thread. */
#ifndef GG_CLOCK_H
#define GG_CLOCK_H

#include <pthread.h>

double gg_base_clock_wall(void);
double gg_base_clock_cpu(void);

/* A condition on the first of these clocks; a thread waits for it for `seconds` at most, less than one. */
void gg_base_condition_init(pthread_cond_t *news);
void gg_base_condition_wait(pthread_cond_t *news, pthread_mutex_t *lock, double seconds);

/* Declaration: to the end of the block the mutex is locked. */
#define GG_LOCKED(mutex)                                                                                               \
  __attribute__((cleanup(gg_base_unlocked), unused)) pthread_mutex_t *const locked = gg_base_locked(mutex)
pthread_mutex_t *gg_base_locked(pthread_mutex_t *mutex);
void gg_base_unlocked(pthread_mutex_t *const *mutex);

#endif
