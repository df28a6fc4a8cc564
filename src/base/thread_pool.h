/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A thread pool: threads that share the parts of a job. Made once, asleep while there is nothing to do; a job costs
 * about a microsecond as long as they come one after another. Each thread takes a run of parts first, the same in each
 * job of as many, and then what others have left: who does what is not known, and parts must not depend on it. */
#ifndef GG_THREAD_POOL_H
#define GG_THREAD_POOL_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

typedef struct gg_thread_pool gg_thread_pool;

/* More parts than these are not shared. */
enum { GG_MOST_PARTS = 32 };

/* Part number `part` of a job. */
typedef void gg_part(void *context, int part);

/* Number of processors that this process may use. */
int gg_base_processors(void);

/* A pool of so many threads, the caller's included, at most GG_MOST_PARTS. NULL for one thread, or if none can be
 * started: the caller then does the jobs itself. */
gg_thread_pool *gg_base_thread_pool_new(int threads);
void gg_base_thread_pool_free(gg_thread_pool *pool);

/* Do parts 0 to parts - 1, and return when all are done. One caller at a time. */
void gg_base_thread_pool_for(gg_thread_pool *pool, int parts, gg_part *part, void *context);

/* The same for rounds of `columns` parts each: part k is not begun before those in need[k] (a bit each, of earlier
 * rounds) are done. There is no barrier between rounds. Each thread begins with a range of columns. */
void gg_base_thread_pool_rounds(gg_thread_pool *pool, int rounds, int columns, const uint32_t *need, gg_part *part,
                                void *context);

/* Contention: other processes take so much of the processors that threads wait for each other, and two are slower than
 * one. The caller then does all parts itself and shares again from time to time. */
typedef struct gg_contention {
  double wall, cpu; /* wall time of shared jobs since the last decision, and CPU time that the caller had in them */
  double until;     /* wall time up to which nothing is shared */
  double pause;     /* seconds to the next attempt */
} gg_contention;

/* True if the job that begins at wall time `now` is to be shared. */
bool gg_base_contention_shares(const gg_contention *c, double now);
/* Take in a shared job that ended at wall time `now`. */
void gg_base_contention_learn(gg_contention *c, double now, double wall, double cpu);

/* True while the pool shares nothing for this reason. */
bool gg_base_thread_pool_is_contended(const gg_thread_pool *pool);

/* CPU time of the others so far, in seconds. */
double gg_base_thread_pool_cpu(const gg_thread_pool *pool);

#endif
