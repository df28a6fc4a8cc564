/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How fast an engine is on a scene: collisions per second, engine alone or with its collision sums. */
#ifndef GG_THROUGHPUT_H
#define GG_THROUGHPUT_H

#include "bench/bench.h"
#include "common/engine.h"

typedef struct gg_throughput {
  double rate;             /* collisions per CPU-second (or second): median of the repeats */
  double slowest, fastest; /* of the repeats */
  int repeats;
  double processors;   /* that were busy, on average: CPU time of all threads over time */
  uint64_t collisions; /* timed, in all */
} gg_throughput;

/* Start the scene near its steady state, let it forget the start for `warmup` collisions per grain, then time `repeats`
 * stretches of at least `seconds` CPU each. */
gg_status gg_bench_throughput_measure(const gg_scene *scene, bool sums, double warmup, int repeats, double seconds,
                                      gg_throughput *out, gg_error *err);

extern const char gg_bench_by_the_clock[]; /* unit of what threads are timed in */
/* As a row has it: the rate, or nanoseconds a collision. */
gg_bench_value gg_bench_throughput_value(const gg_throughput *measured, bool time, const char *unit);

/* Several scenes side by side. A repeat times a stretch of each in turn, so that what else the machine does meets all
 * alike: the ratios within a repeat mean more than the rates. */
enum { GG_MOST_TIMED = 16 };
typedef struct gg_timed_scene {
  gg_scene scene;
  bool sums;
  int against;                        /* index of the scene that it is compared with */
  int threads;                        /* of the engine's; 0: one */
  bool by_the_clock;                  /* time is that of the clock on the wall, not processor time */
  void (*prepare)(gg_engine *engine); /* done to it when new; NULL: nothing */
} gg_timed_scene;
typedef struct gg_timing {
  gg_throughput own;
  double ratio, lowest, highest; /* own rate over that of `against`: median, least and largest of the repeats */
} gg_timing;

gg_status gg_bench_throughput_compare(const gg_timed_scene *scenes, int n, double warmup, int repeats, double seconds,
                                      gg_timing *out, gg_error *err);

#endif
