/* A simulation step by step: an engine, and what its clock and units need outside of it. */
#ifndef GG_API_SIMULATION_H
#define GG_API_SIMULATION_H

#include "api/api.h"
#include "common/engine.h"

/* Free cooling goes on over decades: as runs do, the engine's velocities are brought back by exact powers of two, and
 * what is handed out is in the units of the start. */
struct gg_simulation {
  gg_scene scene; /* finished */
  gg_model model;
  gg_engine *engine;
  struct gg_simulation_clock { /* plain data: saved as bytes */
    double time;               /* since the start, in units of the start */
    int64_t power;             /* the engine's velocities are 2^power times those of the start */
    gg_simulation_sums sums;   /* what was taken from the engine before its last rescaling; stress and energy as sums */
  } clock;
  gg_on_collision *callback;
  void *context;
  int (*asks)(void *context); /* whether to stop; NULL: nobody does */
  void *asks_context;
  gg_stop stop;        /* what the model's points to */
  double stretch_from; /* the engine's time at the start of the stretch that clock.time is the start of */
};

/* Asked of it (simulation_state.c). Velocities of the start over those of the engine. */
double gg_api_simulation_unit(const gg_simulation *s);
/* T of the engine's grains, in the engine's units. */
double gg_api_simulation_temperature(const gg_simulation *s);
/* Take the engine's sums over collisions into the clock's. */
void gg_api_simulation_collect(gg_simulation *s);

/* An empty one for a finished scene, without an engine yet. */
gg_status gg_api_simulation_prepare(const gg_scene *scene, gg_simulation **simulation, gg_error *err);

#endif
