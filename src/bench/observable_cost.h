/* What an observable costs: the processor time that it adds to a run. */
#ifndef GG_OBSERVABLE_COST_H
#define GG_OBSERVABLE_COST_H

#include "measure/observable.h"

typedef struct gg_observable_cost {
  double overhead, lowest, highest; /* over the time of the run without it: median, least and largest of the repeats */
  double ns;                        /* that a collision takes in the run with it; median */
  int repeats;
} gg_observable_cost;

/* Run the scene with `rheology` and this observable, and beside it with rheology alone (for rheology itself: the engine
 * alone, not sampled, its collision sums off), in turn, `repeats` stretches of at least `seconds` each after `warmup`
 * collisions a grain. The sampling interval is that of any run. */
gg_status gg_bench_observable_cost_measure(const gg_scene *scene, const gg_observable *observable, double warmup,
                                           int repeats, double seconds, gg_observable_cost *cost, gg_error *err);

#endif
