/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of an engine on a scene: collisions per second. */
#ifndef GG_THROUGHPUT_H
#define GG_THROUGHPUT_H

#include "bench/bench.h"
#include "common/engine.h"

typedef struct gg_timing {
  gg_bench_value rate;  /* collisions per CPU-second (or second) */
  gg_bench_value ratio; /* rate over that of the scene it is compared with, of each repeat */
  double processors;    /* mean number of busy processors: CPU time of all threads over wall time */
  double neighbour;     /* the same of the busy neighbour; 0: none */
} gg_timing;

/* Start the scene near its steady state, advance `warmup` collisions per grain, then time `repeats` stretches of at
 * least `seconds` of CPU time each. */
gg_status gg_bench_throughput_measure(const gg_scene *scene, double warmup, int repeats, double seconds, gg_timing *out,
                                      gg_error *err);

/* Median, least and largest of n numbers, which are sorted. */
gg_bench_value gg_bench_spread(const char *unit, double *values, int n);
extern const char gg_bench_wall_unit[]; /* unit of rows in wall time */
/* Value of a row: the rate, or nanoseconds per collision. */
gg_bench_value gg_bench_rate(const gg_timing *measured, const char *unit);
gg_bench_value gg_bench_time(const gg_timing *measured, const char *unit);
gg_bench_value gg_bench_inverse(gg_bench_value value, double numerator);

/* Several scenes, timed in turn: each repeat times one stretch of each scene, so that other load of the machine affects
 * all alike. Ratios within a repeat are more accurate than rates. */
enum { GG_MOST_TIMED = 16 };
typedef struct gg_timed_scene {
  gg_scene scene;
  int against;                        /* index of the scene that it is compared with */
  int threads;                        /* threads of the engine; 0: one */
  bool wall_time;                     /* measure wall time, not processor time */
  bool neighbour;                     /* threads share as many processors with a thread that spins */
  void (*prepare)(gg_engine *engine); /* called with the new engine; may be NULL */
} gg_timed_scene;
gg_status gg_bench_throughput_compare(const gg_timed_scene *scenes, int n, double warmup, int repeats, double seconds,
                                      gg_timing *out, gg_error *err);

#endif
