/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A simulation, step by step: an engine with its clock and units. */
#ifndef GG_API_SIMULATION_H
#define GG_API_SIMULATION_H

#include <stdatomic.h>

#include "api/api.h"
#include "base/busy.h"
#include "common/engine.h"
#include "measure/moments.h"
#include "scene/scene.h"

/* Free cooling extends over decades of T. So, as in runs, the engine's velocities are rescaled by exact powers of two;
 * results are in the units of the start. */
struct gg_simulation {
  gg_scene scene; /* completed and checked */
  gg_model model;
  gg_engine *engine;
  struct gg_simulation_clock { /* plain data: saved as bytes */
    double time;               /* since the start, in units of the start */
    int64_t power;             /* the engine's velocities are 2^power times those in units of the start */
    gg_simulation_sums sums;   /* collision sums up to the last rescaling; stress and energy not yet divided by time */
  } clock;
  struct {
    double strain, until; /* `until`: time of the last change of the shear rate; strain up to this time */
  } strained;
  gg_busy busy;
  gg_on_collision *callback; /* NULL: none */
  void *context;
  bool observed; /* the engine reports its collisions; updated between two stretches */
  struct {
    gg_collision_event *events; /* NULL: none */
    size_t capacity, *n;
  } record;
  int (*stop_callback)(void *context); /* NULL: none */
  void *stop_context;
  atomic_bool stopped; /* the callback has returned non-zero during the present call */
  gg_stop stop;        /* model.stop points to it */
  double stretch_from; /* the engine's time at clock.time, the start of the present stretch */
};

/* simulation_state.c: queries. */

/* Velocities in units of the start over those of the engine. */
double gg_api_simulation_unit(const gg_simulation *s);
/* Temperature in the engine's units. */
double gg_api_simulation_temperature(const gg_simulation *s);
double gg_api_simulation_strain(const gg_simulation *s);
/* Add the engine's collision sums to those of the clock, and reset them. */
void gg_api_simulation_collect(gg_simulation *s);

/* simulation.c: a simulation without an engine. `stop` (may be NULL) is polled from now on. */
gg_status gg_api_simulation_prepare(const gg_scene *scene, int (*stop)(void *context), void *context,
                                    gg_simulation **simulation, gg_error *err);
/* End of a start: `status` is that of making the engine. Sets *simulation, or frees s on failure. */
gg_status gg_api_simulation_hand_over(gg_simulation *s, gg_status status, gg_simulation **simulation, gg_error *err);

/* A simulation with scene, model and clock of another, without engine and callbacks; NULL: out of memory. */
gg_simulation *gg_api_simulation_like(const gg_simulation *other, gg_error *err);
/* Make a new engine report its collisions if the present engine does. */
gg_status gg_api_simulation_observe(gg_simulation *s, gg_engine *engine, gg_error *err);

/* Set temperatures, stress, periodicity and, from state->collisions, collisions per grain. `unit`: velocities of the
 * state over those of the moments. */
void gg_api_moments_state(const gg_moments *m, double unit, gg_simulation_state *state);
/* State of one species; GG_BAD_INPUT if there is no such species. */
gg_status gg_api_moments_species(const gg_moments *m, int species, double unit, gg_species_state *state, gg_error *err);

#endif
