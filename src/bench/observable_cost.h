/* What an observable costs: its share of the processor time of a run. */
#ifndef GG_OBSERVABLE_COST_H
#define GG_OBSERVABLE_COST_H

#include "measure/observable.h"

typedef struct gg_cost {
  double share, lowest, highest; /* of the time of a run that measures it: median, least and largest of the repeats */
  double ns;                     /* that a collision takes in such a run; median */
  int repeats;
} gg_cost;

/* Run the scene with `rheology` and this observable, and beside it with rheology alone (for rheology itself: an engine
 * that nobody looks at, its tap closed), in turn, `repeats` stretches of at least `seconds` each after `warmup`
 * collisions a grain; looks as often as in any run. */
gg_status gg_measure_observable_cost(const gg_scene *scene, const gg_observable *observable, double warmup, int repeats,
                                     double seconds, gg_cost *cost, gg_error *err);

#endif
